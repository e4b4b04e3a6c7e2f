// SPDX-License-Identifier: GPL-3.0-or-later
#include "multires/mesh_levels.h"

#include "mesh/quantization.h"

#include <numeric>

namespace wavemesh {
namespace {

/// Lattice on which the coarsening is chosen: as fine as the codec's finest but for overflow.
constexpr int kSearchBits = 20;

Status checkMesh(const MeshData& mesh, const MultiresolutionOptions& options)
{
	if (options.lifting < kLiftingOff || options.lifting > 2)
		return {StatusCode::InvalidArgument, "lifting must be off or the k of a k-disc, 0 to 2"};
	if (mesh.triangles.empty())
		return {StatusCode::Unsupported, "the mesh has no faces"};
	return checkCounts(mesh.positions.size(), mesh.triangles.size());
}

} // namespace

Result<Replay> replayLevels(const MeshData& mesh, const MultiresolutionOptions& options)
{
	if (Status s = checkMesh(mesh, options); !s.ok())
		return s;
	const auto lattice = makeLattice(mesh.positions, kSearchBits, 0);
	if (!lattice.ok())
		return lattice.status();
	auto table = buildCornerTable(mesh.triangles, Index(mesh.positions.size()));
	if (!table.ok())
		return table.status();
	const GeometricalCriterion criterion {
	    options.wgc != Wgc::Off, options.wgcSharpness, options.wgcDeviation};
	bool running = true;
	auto coarsenings =
	    coarsenAll(*table, quantise(mesh.positions, *lattice), criterion, {}, [&](double fraction) {
		    running = !options.progress || options.progress(0.8 * fraction);
		    return running;
	    });
	if (!running)
		return Status(StatusCode::Cancelled, "cancelled");
	CornerTable base = coarsenings.empty() ? std::move(*table) : coarsenings.back().coarse;
	std::vector<Index> source(base.vertexCount);
	std::iota(source.begin(), source.end(), 0);
	return replay(std::move(coarsenings), std::move(base), std::move(source));
}

} // namespace wavemesh
