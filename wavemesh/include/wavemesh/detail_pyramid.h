// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Multiresolution editing: an equaliser for the shape of a mesh whose connectivity and order of
/// vertices stay.
#pragma once

#include <wavemesh/multiresolution.h>

#include <memory>
#include <vector>

namespace wavemesh {

/// What becomes of the details of a mesh.
struct Equaliser
{
	/// By level, gains[0] unused: 0 removes the details of the level, 1 keeps them, 2 doubles them.
	/// Levels that are missing have gain 1.
	std::vector<double> gains;
	/// Soft threshold t, before the gains, model units: the normal component d of every detail
	/// becomes d - t^2 / d, or 0 if it was below t (the non-negative garrote). Noise goes; large
	/// details hardly change, as they would by t if all became shorter by the same.
	double threshold = 0;
	/// The finest so many levels feel the threshold: most of the noise is there, and coarser
	/// details are as long as it where the surface is merely curved.
	int thresholdLevels = 1000;
	/// Gains act on the component of a detail that is normal to the coarser surface.
	bool normalOnly = false;
};

/// The levels of a mesh as a pyramid of smooth surfaces and the details between them.
///
/// The wavelets of the file predict a vertex on the straight edge of its parents: right for few
/// bits, but what is left without the details is faceted, and more of them is rough. Here a level's
/// own vertices are smoothed on the way to the coarser one, children are predicted by relaxation
/// that carries their parents' curvature on, and every vertex of a level has a detail: more numbers
/// than vertices, which does not matter where nothing is stored. After Guskov, Sweldens & Schröder
/// (1999), with the mean value weights of Floater (2003), which leave a flat surface as it is
/// however its vertices are spread.
class DetailPyramid
{
public:
	/// @return as Multiresolution::of(); options.lifting does not matter. Linear.
	static Result<DetailPyramid>
	of(const MeshData& mesh, const MultiresolutionOptions& options = {});

	int finestLevel() const;

	/// Positions of the mesh with the details changed. What changes nothing gives the positions
	/// back bit for bit, since the *changes* of the details are what is synthesised, and added.
	/// Linear; takes a fraction of the time of of().
	std::vector<Vec3> equalise(const Equaliser& equaliser) const;

private:
	struct Levels;
	explicit DetailPyramid(std::shared_ptr<const Levels> levels) : levels_(std::move(levels)) {}
	std::shared_ptr<const Levels> levels_;
};

} // namespace wavemesh
