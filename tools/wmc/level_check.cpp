// SPDX-License-Identifier: GPL-3.0-or-later
#include "level_check.h"

#include "vcg_mesh.h"

#include <wavemesh/vcg_wmc.h>

#include <vcg/complex/algorithms/clean.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace wavemesh::tool {

namespace {

using Clean = vcg::tri::Clean<VcgMesh>;

/// A face and its reverse are a closed surface, and none of both.
bool hasDegenerateOrDuplicateFaces(const MeshData& mesh)
{
	auto faces = mesh.triangles;
	for (auto& t : faces) {
		std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
		if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
			return true;
	}
	std::sort(faces.begin(), faces.end());
	return std::adjacent_find(faces.begin(), faces.end()) != faces.end();
}

/// On a manifold every boundary vertex is followed by one other.
int countBoundaryLoops(const VcgMesh& m, int& boundaryEdges)
{
	constexpr std::size_t kInside = ~std::size_t {0};
	std::vector<std::size_t> next(m.vert.size(), kInside);
	for (const VcgFace& f : m.face)
		for (int k = 0; k < 3; ++k)
			if (vcg::face::IsBorder(f, k)) {
				next[vcg::tri::Index(m, f.cV0(k))] = vcg::tri::Index(m, f.cV1(k));
				++boundaryEdges;
			}
	int loops = 0;
	for (std::size_t start = 0; start < next.size(); ++start) {
		loops += next[start] != kInside;
		for (std::size_t v = start; next[v] != kInside;)
			v = std::exchange(next[v], kInside);
	}
	return loops;
}

} // namespace

std::string whatVcgFindsWrong(const MeshData& mesh, Topology& topology)
{
	for (const auto& t : mesh.triangles)
		for (std::uint32_t v : t)
			if (v >= mesh.positions.size())
				return "a face refers to a vertex that does not exist";
	if (hasDegenerateOrDuplicateFaces(mesh))
		return "degenerate or duplicate faces";
	VcgMesh m;
	fromMeshData(mesh, m);
	vcg::tri::UpdateTopology<VcgMesh>::FaceFace(m);
	// Clean::CountNonManifoldEdgeFF takes three of the faces' flags for good with every call.
	for (const VcgFace& f : m.face)
		for (int k = 0; k < 3; ++k)
			if (!vcg::face::IsManifold(f, k))
				return "an edge of face " + std::to_string(vcg::tri::Index(m, f)) +
				       " is not manifold";
	if (const int n = Clean::CountNonManifoldVertexFF(m))
		return std::to_string(n) + " vertices are not manifold";
	if (!Clean::IsCoherentlyOrientedMesh(m))
		return "the faces are not oriented alike";
	if (const int n = Clean::CountUnreferencedVertex(m))
		return std::to_string(n) + " vertices are in no face";
	int boundaryEdges      = 0;
	topology.components    = Clean::CountConnectedComponents(m);
	topology.boundaryLoops = countBoundaryLoops(m, boundaryEdges);
	topology.euler         = m.vn - (3 * m.fn + boundaryEdges) / 2 + m.fn;
	return {};
}

} // namespace wavemesh::tool
