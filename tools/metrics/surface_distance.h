// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Symmetric distance of two surfaces, by sampling.
#pragma once

#include <wavemesh/mesh_data.h>

#include <cstddef>
#include <functional>
#include <memory>

namespace wavemesh::metrics {

struct SurfaceDistance
{
	double rms = 0; ///< the larger of the two one-sided root mean squares, model units
	double max = 0; ///< the larger of the two one-sided maxima, model units
};

/// Measures meshes against one original. Distances are from points of one surface to the nearest
/// point of the other. The points are spread evenly over the area, the same ones every time; the
/// maximum looks at the vertices too.
class DistanceMeter
{
public:
	/// @param samples  points on each of the two surfaces, > 0
	DistanceMeter(const MeshData& original, std::size_t samples);
	~DistanceMeter();

	/// Of the original's bounding box, model units; never 0.
	double diagonal() const { return diagonal_; }
	/// On each of the two surfaces.
	std::size_t samples() const { return samples_; }

	SurfaceDistance
	measure(const MeshData& mesh, const std::function<void(double)>& progress = {}) const;

private:
	struct Surface;
	std::unique_ptr<Surface> original_;
	std::size_t samples_;
	double diagonal_;
};

} // namespace wavemesh::metrics
