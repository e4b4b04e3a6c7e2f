// SPDX-License-Identifier: GPL-3.0-or-later
#include "guard.h"
#include "mesh/vec3.h"
#include "multires/mesh_levels.h"
#include "wavelet/lifting.h"

#include <wavemesh/multiresolution.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace wavemesh {

/// One subdivision step, in the numbering of the mesh.
struct Multiresolution::Levels
{
	struct Step
	{
		std::vector<Index> children;
		/// Entry e adds alpha[e] times the detail of the child to vertex[e], as in UpdateWeights.
		std::vector<Index> begin, vertex;
		std::vector<double> alpha;
	};

	std::vector<Step> steps;         ///< coarsest first: steps[j - 1] leads to level j
	std::vector<std::size_t> counts; ///< vertices, by level
	std::vector<int> birth;
	std::vector<std::array<std::uint32_t, 3>> parents;
	std::vector<Vec3> normals;

	Vec3 prediction(Index child, const std::vector<Vec3>& values) const;
	void analyse(const Step& step, std::vector<Vec3>& values) const;
	void synthesise(const Step& step, std::vector<Vec3>& values) const;
};

namespace {

/// Normals of a level, weighted by area, at the mesh's vertices that it has; others stay.
void addNormals(
    const CornerTable& table,
    const std::vector<Index>& source,
    const std::vector<Vec3>& positions,
    std::vector<Vec3>& normals)
{
	for (Index v = 0; v < table.vertexCount; ++v)
		normals[source[v]] = {0, 0, 0};
	for (Index c = 0; c < table.cornerCount(); c += 3) {
		const Index t[3] = {
		    source[table.vertex[c]], source[table.vertex[c + 1]], source[table.vertex[c + 2]]};
		const Vec3 n = cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
		for (const Index v : t)
			normals[v] = normals[v] + n;
	}
	for (Index v = 0; v < table.vertexCount; ++v)
		normals[source[v]] = unit(normals[source[v]]);
}

} // namespace

Vec3 Multiresolution::Levels::prediction(Index child, const std::vector<Vec3>& values) const
{
	const auto& p  = parents[child];
	const Vec3 sum = values[p[0]] + values[p[1]];
	return p[2] == kNoParent ? 0.5 * sum : (1.0 / 3) * (sum + values[p[2]]);
}

void Multiresolution::Levels::analyse(const Step& step, std::vector<Vec3>& values) const
{
	for (const Index child : step.children)
		values[child] = values[child] - prediction(child, values);
	for (std::size_t i = 0; i + 1 < step.begin.size(); ++i)
		for (Index e = step.begin[i]; e < step.begin[i + 1]; ++e)
			values[step.vertex[e]] =
			    values[step.vertex[e]] + step.alpha[e] * values[step.children[i]];
}

void Multiresolution::Levels::synthesise(const Step& step, std::vector<Vec3>& values) const
{
	for (std::size_t i = 0; i + 1 < step.begin.size(); ++i)
		for (Index e = step.begin[i]; e < step.begin[i + 1]; ++e)
			values[step.vertex[e]] =
			    values[step.vertex[e]] - step.alpha[e] * values[step.children[i]];
	for (const Index child : step.children)
		values[child] = values[child] + prediction(child, values);
}

Result<Multiresolution>
Multiresolution::of(const MeshData& mesh, const MultiresolutionOptions& options)
{
	const auto work = [&]() -> Result<Multiresolution> {
		auto replayed = replayLevels(mesh, options);
		if (!replayed.ok())
			return replayed.status();
		const std::vector<Index>& source = replayed->source;
		auto levels                      = std::make_shared<Levels>();
		levels->birth.assign(mesh.positions.size(), 0);
		levels->parents.assign(mesh.positions.size(), {kNoParent, kNoParent, kNoParent});
		levels->normals.assign(mesh.positions.size(), {0, 0, 0});
		levels->steps.resize(replayed->levels.size());
		levels->counts.push_back(
		    replayed->levels.empty() ? source.size() : replayed->levels[0].parent.vertexCount);
		for (const ReplayedLevel& level : replayed->levels)
			levels->counts.push_back(level.refinement.childVertices);

		// From the finest down: each step needs the positions of the level below it, lifted.
		std::vector<Vec3> positions = mesh.positions;
		if (levels->steps.empty())
			addNormals(replayed->finest, source, positions, levels->normals);
		for (std::size_t j = levels->steps.size(); j-- > 0;) {
			ReplayedLevel level   = std::move(replayed->levels[j]);
			Levels::Step& step    = levels->steps[j];
			const Parents parents = parentsOf(level.parent, level.refinement);
			const UpdateWeights weights =
			    updateWeights(level.parent, level.refinement, parents, options.lifting);
			for (std::size_t i = 0; i < parents.size(); ++i) {
				const Index child = source[level.refinement.parentVertices + i];
				step.children.push_back(child);
				levels->birth[child] = int(j) + 1;
				for (std::size_t k = 0; k < 3; ++k)
					levels->parents[child][k] =
					    parents[i][k] == kNone ? kNoParent : source[parents[i][k]];
			}
			step.begin = weights.begin;
			for (std::size_t e = 0; e < weights.vertex.size(); ++e) {
				step.vertex.push_back(source[weights.vertex[e]]);
				step.alpha.push_back(weights.alpha[e] / 65536.0);
			}
			levels->analyse(step, positions);
			// The vertices of the level below get normals that are theirs only until its own turn.
			addNormals(level.parent, source, positions, levels->normals);
			for (const Index child : step.children)
				levels->normals[child] = unit(levels->prediction(child, levels->normals));
			const double done = 1 - double(level.parent.vertexCount) / double(source.size());
			if (options.progress && !options.progress(0.8 + 0.2 * done))
				return Status(StatusCode::Cancelled, "cancelled");
		}
		return Multiresolution(std::move(levels));
	};
	return guarded(work, [] { return "for the levels of this mesh"; });
}

int Multiresolution::finestLevel() const
{
	return int(levels_->steps.size());
}

std::size_t Multiresolution::vertexCount() const
{
	return levels_->birth.size();
}

std::size_t Multiresolution::vertexCount(int level) const
{
	return levels_->counts[std::size_t(level)];
}

const std::vector<int>& Multiresolution::birth() const
{
	return levels_->birth;
}

const std::vector<std::array<std::uint32_t, 3>>& Multiresolution::parents() const
{
	return levels_->parents;
}

const std::vector<Vec3>& Multiresolution::normals() const
{
	return levels_->normals;
}

void Multiresolution::analyse(std::vector<Vec3>& values) const
{
	for (auto step = levels_->steps.rbegin(); step != levels_->steps.rend(); ++step)
		levels_->analyse(*step, values);
}

void Multiresolution::synthesise(std::vector<Vec3>& values) const
{
	for (const auto& step : levels_->steps)
		levels_->synthesise(step, values);
}

std::vector<double> measureDetails(
    const Multiresolution& levels, const std::vector<Vec3>& positions, DetailMeasure measure)
{
	std::vector<double> out(positions.size(), 0);
	if (measure == DetailMeasure::Birth) {
		std::copy(levels.birth().begin(), levels.birth().end(), out.begin());
		return out;
	}
	std::vector<Vec3> details = positions;
	levels.analyse(details);
	for (std::size_t v = 0; v < out.size(); ++v)
		if (levels.birth()[v] > 0)
			out[v] = measure == DetailMeasure::Normal ? dot(details[v], levels.normals()[v])
			                                          : std::sqrt(dot(details[v], details[v]));
	return out;
}

} // namespace wavemesh
