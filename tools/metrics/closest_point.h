// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The nearest point of a triangle mesh.
///
/// VCGLib's uniform grid would do, but takes several times as long where the meshes are far apart,
/// as coarse levels are, and does not end for some points in the middle of a sphere.
#pragma once

#include <wavemesh/mesh_data.h>

#include <array>
#include <cstdint>
#include <vector>

namespace wavemesh::metrics {

using Vec3 = std::array<double, 3>;

/// Distance of `p` to the triangle a b c, which may be without area.
double squaredDistance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// A tree of bounding boxes over the faces of a mesh.
class ClosestPoint
{
public:
	/// @param mesh  at least one face; must stay as long as this. Cost O(#F log #F).
	explicit ClosestPoint(const MeshData& mesh);

	/// Distance of `p` to the mesh. Points near the one asked for before are found fastest.
	double distance(const Vec3& p) const;

private:
	struct Node
	{
		Vec3 low, high;
		std::uint32_t first = 0; ///< of faces_, or the left child; the right one follows it
		std::uint32_t count = 0; ///< faces of a leaf, 0 for an inner node
	};

	void split(std::uint32_t node, std::vector<Vec3>& middles);
	void bound(Node& node) const;
	double toFace(const Vec3& p, std::uint32_t f) const;

	const MeshData& mesh_;
	std::vector<Node> nodes_;
	std::vector<std::uint32_t> faces_;
	mutable std::uint32_t last_ = 0; ///< nearest face of the point asked for last
};

} // namespace wavemesh::metrics
