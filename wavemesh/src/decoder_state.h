// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What a decoder has of a mesh, and how it reads on. The steps through the file are in
/// decoder.cpp, the levels in decoder_levels.cpp.
#pragma once

#include "attributes/attribute_reader.h"
#include "container/container.h"
#include "multires/refine.h"
#include "syntax/connectivity_syntax.h"
#include "syntax/detail_syntax.h"
#include "syntax/position_syntax.h"

#include <wavemesh/codec.h>

#include <memory>
#include <optional>
#include <string>

namespace wavemesh {

inline std::string levelName(int level)
{
	return "level " + std::to_string(level);
}

struct Decoder::State
{
	const std::uint8_t* data = nullptr;
	std::size_t size         = 0;
	Head head;
	StreamInfo info;

	int level = -1;
	CornerTable table;
	std::vector<LatticePoint> positions; ///< cells of the level's precision
	Parents lastParents; ///< compact, below the finest split: of the last split's new vertices
	Glue glue;           ///< of the base mesh
	std::unique_ptr<AttributeReader> attributes; ///< if the file has any
	std::optional<MeshData> finished; ///< level J with what follows it, as far as it came
	Status stopped;                   ///< not ok: no further level can come
	Progress progress;                ///< of the level being read
	double levelShare = 1;            ///< of the level in that; behind it the mesh is finished
	bool cancelled    = false;

	std::size_t offset = 0; ///< of the next chunk
	Chunk chunk;            ///< the one being read
	RangeDecoder coder;
	// Megabytes: made for the first refinement that needs them.
	std::unique_ptr<ConnectivityModels> connectivityModels;
	std::unique_ptr<DetailModels> detailModels;
	std::unique_ptr<CompactModels> compactModels;

	const LevelRow& row(int l) const { return head.rows[std::size_t(l)]; }

	Status nextChunk(const std::string& what, std::uint8_t type);
	Status openChunk();
	Status openFeature(Feature feature);
	Status readBase();
	Status readSplit();
	Status readDetails(const Refinement& refinement);
	Status readChildren(const Refinement& refinement, const CornerTable& child);
	Status readPrecise();
	double shareOfNextLevel() const;
	Status finish();
	Status advance();
	bool goesOn(double fraction);
	Progress watched(double from, double to);
	double attributesBegin() const;
	Status ended(const char* where) const;
	Status corrupt(const std::string& what) const;
	Status wrongSize(std::uint32_t found, const char* elements, std::uint32_t declared) const;
};

} // namespace wavemesh
