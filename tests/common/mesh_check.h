// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a mesh is, found out from its index arrays alone: independent of the codec and of VCGLib.
#pragma once

#include <wavemesh/mesh_data.h>

#include <cstdint>
#include <string>

namespace wavemesh::test {

/// Counts of an oriented 2-manifold.
struct Topology
{
	std::uint32_t components    = 0;
	std::uint32_t boundaryEdges = 0;
	std::uint32_t boundaryLoops = 0;
	std::int64_t euler          = 0; ///< V - E + F
	std::int64_t genus          = 0; ///< summed over the components
};

/// Empty if `mesh` is an oriented 2-manifold with or without boundary, without isolated vertices,
/// degenerate or duplicate faces; otherwise the first thing that is wrong. If it is one and
/// `topology` is given, fills it.
std::string whatIsNotManifold(const MeshData& mesh, Topology* topology = nullptr);

} // namespace wavemesh::test
