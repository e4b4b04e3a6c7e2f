// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// All levels of a mesh. The encoder coarsens from the finest down in a numbering of its own; the
/// file counts from the base mesh up. replay() refines from the base as the decoder will and
/// thereby turns the first numbering into the second, and proves that the decoder gets there.
#pragma once

#include "multires/coarsen.h"
#include "multires/seams.h"

#include <functional>
#include <limits>

namespace wavemesh {

/// Is connectivity regular, nearly all faces split 1:4? Fewer coarse vertices there cannot be, a
/// quarter and those of the boundaries; of irregular connectivity a third or more are left.
inline bool isRegularSplit(Index coarse, Index fine)
{
	return 16 * std::uint64_t {coarse} <= 5 * std::uint64_t {fine};
}

/// Which steps are steered by the error they make, and how strictly. Regular ones never are, from
/// the finest to the first that is not: they take next to no bits, and predict so well that no
/// other choice of vertices is worth it.
struct Steering
{
	static constexpr int kNever = std::numeric_limits<int>::max();
	/// So many of the finest steps are left to connectivity and the geometrical criterion, unless
	/// the error is much larger then.
	int freeSteps = kNever;
	/// ErrorCriterion::share of the finest step where it is steered, and of coarser ones: where the
	/// finest is steered, and where it was left free. That of the finest is for all behind regular
	/// ones.
	double finestShare = 0.99, share = 0.9, shareAfterFree = 0.96;
};

/// @param criterion  steers the steps that `steering` does not
/// @param kept  #V: 1 for vertices that stay in every level; empty if any may go
/// @param seams stay as long as enough else can go
/// @param step  called after each level with the fraction of vertices gone, 0..1; false stops
/// @return the coarsenings, finest first; empty if nothing can be merged
/// Linear: each level costs as much as it has faces, and has at most 15/16 of the vertices of the
/// next finer one.
std::vector<Coarsening> coarsenAll(
    const CornerTable& table,
    const std::vector<LatticePoint>& positions,
    const GeometricalCriterion& criterion,
    const Steering& steering,
    const std::function<bool(double)>& step,
    const std::vector<std::uint8_t>& kept = {},
    Seams seams                           = {});

struct ReplayedLevel
{
	CornerTable parent; ///< level j-1 as the decoder has it
	Refinement refinement;
};

struct Replay
{
	std::vector<ReplayedLevel> levels; ///< coarsest first; the last one's child is `finest`
	CornerTable finest;
	std::vector<Index> source; ///< #V: vertex of the original behind each of the decoder's
};

/// @param base    connectivity of the base mesh in the decoder's order
/// @param source  #V_0: vertex of the coarsest mesh in the encoder's numbering behind each of
///                base's
/// @param coarsenings  from coarsenAll(), finest first; each is freed as soon as it was replayed
Replay replay(std::vector<Coarsening> coarsenings, CornerTable base, std::vector<Index> source);

} // namespace wavemesh
