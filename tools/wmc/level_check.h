// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// VCGLib's opinion about a mesh.
#pragma once

#include <wavemesh/mesh_data.h>

#include <string>

namespace wavemesh::tool {

/// What the levels of one file have in common.
struct Topology
{
	int components    = 0;
	int boundaryLoops = 0;
	int euler         = 0; ///< V - E + F

	bool operator==(const Topology& o) const
	{
		return components == o.components && boundaryLoops == o.boundaryLoops && euler == o.euler;
	}
};

/// Empty if VCGLib finds `mesh` to be an oriented 2-manifold without degenerate or duplicate faces
/// and without unreferenced vertices; otherwise what it found. Fills `topology`.
std::string whatVcgFindsWrong(const MeshData& mesh, Topology& topology);

} // namespace wavemesh::tool
