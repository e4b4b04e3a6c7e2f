// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What decoding must give, found out without the codec's own stages.
#pragma once

#include "mesh_check.h"

#include <wavemesh/codec.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace wavemesh {

/// For GoogleTest's messages.
inline void PrintTo(StatusCode code, std::ostream* out)
{
	*out << "StatusCode " << static_cast<int>(code);
}

} // namespace wavemesh

namespace wavemesh::test {

/// A mesh as the codec's users see it at one level.
struct Level
{
	MeshData mesh;
	Status status; ///< of the advance() that led here
};

/// Every level of a file, as far as it goes; the last has the status of the failure, if any.
std::vector<Level> levelsOf(const std::vector<std::uint8_t>& file);

/// Lattice coordinates of `mesh` on the lattice of `info`: nearest points, ties away from zero.
std::vector<std::array<std::int64_t, 3>> latticeOf(const MeshData& mesh, const StreamInfo& info);

/// Empty if `decoded` is isomorphic to `original` with the same lattice integers and stands exactly
/// on the lattice; else the first difference.
std::string whatIsLost(const MeshData& original, const MeshData& decoded, const StreamInfo& info);

/// Empty if every level of `file` is an oriented simplicial manifold of the topology of `original`,
/// has the counts that the head declares, and keeps the vertices of the one before in place.
std::string whatIsWrongWithLevels(const MeshData& original, const std::vector<std::uint8_t>& file);

/// Bits, lifting and WGC as a name for messages.
std::string nameOf(const EncodeOptions& options);

/// Checksum of a mesh, by positions' bit patterns and indices (FNV-1a).
std::uint64_t fingerprint(const MeshData& mesh);
std::uint64_t fingerprint(const std::vector<std::uint8_t>& bytes);

} // namespace wavemesh::test
