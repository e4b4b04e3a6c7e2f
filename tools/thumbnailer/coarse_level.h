// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A level that is good enough for a small picture, from the first bytes of a file.
#pragma once

#include <wavemesh/codec.h>

#include <string>

namespace wavemesh {

/// What a small picture may cost.
struct CoarseLimits
{
	std::uint64_t bytes = 256 * 1024; ///< read from the file
	std::uint32_t faces = 40000;
};

struct CoarseLevel
{
	MeshData mesh;
	int level               = 0;
	std::uint64_t bytesRead = 0;
};

/// Reads the head, and then no more of the file than the finest level within the limits needs; the
/// base mesh, if that is beyond them already.
/// @return the mesh of that level, or what is left of it if the file ends early; NotWmc for a file
///         that cannot be read; else as Decoder
Result<CoarseLevel> readCoarseLevel(const std::string& file, const CoarseLimits& limits = {});

} // namespace wavemesh
