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
	std::uint64_t bytes   = 256 * 1024; ///< read from the file
	std::uint32_t faces   = 40000;
	std::uint64_t numbers = 4'000'000; ///< in the attributes, which are read along
	/// Faces of all levels up to the one drawn, in multiples of `faces`: levels of the encoder's
	/// grow, and some only get more precise.
	std::uint32_t levelShare = 64;
	/// A base mesh may take so many times as much: there is nothing coarser.
	std::uint32_t baseShare = 32;
};

struct CoarseLevel
{
	MeshData mesh;
	int level               = 0;
	std::uint64_t bytesRead = 0;
};

/// Reads the head, and then no more of the file than the finest level within the limits needs; the
/// base mesh, if that is beyond them already. Whatever a file declares, the memory taken is for
/// bytes that are there and for a level within the limits.
/// @return the mesh of that level, or what is left of it if the file ends early; NotWmc for a file
///         that cannot be read; LimitExceeded if not even the base mesh is small; else as Decoder
Result<CoarseLevel> readCoarseLevel(const std::string& file, const CoarseLimits& limits = {});

} // namespace wavemesh
