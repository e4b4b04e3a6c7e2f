// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The border between any VCG mesh type (MeshLab's CMeshO, a mesh of one's own) and the codec.
/// Header only; needs VCGLib on the include path and nothing of the mesh but coordinates and
/// face-vertex references.
#pragma once

#include <wavemesh/mesh_data.h>

#include <vcg/complex/complex.h>

#include <cstdint>
#include <vector>

namespace wavemesh {

/// Copies the vertices and faces of `m` that are not deleted, in their order. `m` is not modified.
template <class MeshType>
MeshData toMeshData(const MeshType& m)
{
	MeshData out;
	out.positions.reserve(static_cast<std::size_t>(m.vn));
	out.triangles.reserve(static_cast<std::size_t>(m.fn));
	std::vector<std::uint32_t> rowOf(m.vert.size());
	for (std::size_t i = 0; i < m.vert.size(); ++i) {
		if (m.vert[i].IsD())
			continue;
		rowOf[i]      = static_cast<std::uint32_t>(out.positions.size());
		const auto& p = m.vert[i].cP();
		out.positions.push_back({double(p[0]), double(p[1]), double(p[2])});
	}
	for (const auto& f : m.face) {
		if (f.IsD())
			continue;
		std::array<std::uint32_t, 3> t;
		for (int k = 0; k < 3; ++k)
			t[std::size_t(k)] = rowOf[vcg::tri::Index(m, f.cV(k))];
		out.triangles.push_back(t);
	}
	return out;
}

/// Replaces the contents of `m` by `data`. Normals and bounding box are updated where `m` has them;
/// adjacency is left to the caller.
template <class MeshType>
void fromMeshData(const MeshData& data, MeshType& m)
{
	using Scalar = typename MeshType::ScalarType;
	m.Clear();
	vcg::tri::Allocator<MeshType>::AddVertices(m, data.positions.size());
	for (std::size_t i = 0; i < data.positions.size(); ++i) {
		const auto& p = data.positions[i];
		m.vert[i].P() = typename MeshType::CoordType(Scalar(p[0]), Scalar(p[1]), Scalar(p[2]));
	}
	vcg::tri::Allocator<MeshType>::AddFaces(m, data.triangles.size());
	for (std::size_t i = 0; i < data.triangles.size(); ++i)
		for (int k = 0; k < 3; ++k)
			m.face[i].V(k) = &m.vert[data.triangles[i][std::size_t(k)]];
	if (vcg::tri::HasPerVertexNormal(m) && vcg::tri::HasPerFaceNormal(m))
		vcg::tri::UpdateNormal<MeshType>::PerVertexNormalizedPerFaceNormalized(m);
	vcg::tri::UpdateBounding<MeshType>::Box(m);
}

} // namespace wavemesh
