// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What follows the levels: the chunks that lead from the finest level to the original in all that
/// was promised (docs/wmc_format.md, section 12). One chunk a promise, each with a digest of what
/// it leads to.
#pragma once

#include "attributes/attribute_levels.h"
#include "attributes/attribute_reader.h"
#include "container/container.h"
#include "entropy/range_coder.h"
#include "finish/restoration.h"
#include "stage.h"

namespace wavemesh {

/// The encoder's knowledge once the levels are done.
struct FinishSource
{
	const MeshData& original;
	const ManifoldCut& cut;
	const CornerTable& finest;                  ///< as the decoder has it
	const std::vector<LatticePoint>& positions; ///< #V_J, lattice units
	const std::vector<Index>& source;           ///< #V_J: the cut's vertex behind each
	const Glue& glue;
	AttributeWriter* attributes; ///< that wrote those of the levels; or nullptr
};

/// Features of the head that options and mesh ask for, before anything is coded.
std::uint8_t
featuresFor(const EncodeOptions& options, const MeshData& original, const ManifoldCut& cut);

/// Appends a chunk for each of head.features and fills in what the head says of them.
/// @return false: the user wants to stop
bool writeFinish(
    const FinishSource& from, Head& head, std::vector<std::uint8_t>& chunks, const Stage& stage);

/// The decoder's side: takes the chunks one after the other.
class Finish
{
public:
	/// The finest level, whole. All references must stay.
	/// @param attributes  that were read along with the levels, or nullptr
	Finish(
	    const Head& head,
	    const CornerTable& finest,
	    const std::vector<LatticePoint>& positions,
	    const Glue& glue,
	    AttributeReader* attributes);

	/// Applies the chunk of a feature; features come in their order.
	/// @return Corrupt, ChecksumMismatch (of the digest), Cancelled; then the mesh is not to be
	///         used
	Status
	apply(Feature feature, const std::uint8_t* payload, std::size_t size, const Stage& stage);

	/// The mesh with all that was applied.
	MeshData mesh() const;

private:
	Status restoration(RangeDecoder& coder, std::uint32_t digest);
	Status order(RangeDecoder& coder, std::uint32_t digest, Watch& watch);
	Status exact(RangeDecoder& coder, std::uint32_t digest, Watch& watch);

	const Head& head_;
	const CornerTable& finest_;
	const std::vector<LatticePoint>& positions_;
	RestoredNumbers numbers_;
	RestoredMesh restored_;
	AttributeReader* attributes_;
	ElementOrder order_;                       ///< or empty
	std::vector<std::array<double, 3>> exact_; ///< #V, or empty
};

} // namespace wavemesh
