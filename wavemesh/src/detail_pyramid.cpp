// SPDX-License-Identifier: GPL-3.0-or-later
#include "guard.h"
#include "mesh/vec3.h"
#include "multires/mesh_levels.h"
#include "wavelet/lifting.h"

#include <wavemesh/detail_pyramid.h>

#include <algorithm>

namespace wavemesh {
namespace {

/// Sweeps of relaxation that put the children of a level where their neighbours want them.
constexpr int kSweeps = 4;
/// Rounds in which they take on curvature.
constexpr int kRounds = 4;
/// How strongly a level is smoothed on the way to the coarser one; below 1.
constexpr double kSmoothing = 0.5;

/// What the threshold takes off a detail.
double partCut(double detail, double threshold)
{
	return std::fabs(detail) <= threshold ? detail : threshold * threshold / detail;
}

/// For each vertex a mean of its neighbours, as lists: entries begin[v] .. begin[v + 1].
struct Means
{
	std::vector<Index> begin, vertex;
	std::vector<float> weight;      ///< sums to 1 for each vertex
	std::vector<float> spread;      ///< mean square distance of the neighbours; never 0
	std::vector<std::uint8_t> edge; ///< 1 on the boundary

	Vec3 at(Index v, const std::vector<Vec3>& values) const
	{
		Vec3 sum {0, 0, 0};
		for (Index e = begin[v]; e < begin[v + 1]; ++e)
			sum = sum + double(weight[e]) * values[vertex[e]];
		return sum;
	}
};

/// Tangent of half the angle at `at` between two other points; large where they are opposite.
double halfTangent(const Vec3& at, const Vec3& a, const Vec3& b)
{
	constexpr double kMost = 4; // an obtuse angle is not to outweigh all others
	const Vec3 u = a - at, v = b - at;
	const double sine = length(cross(u, v)), cosine = dot(u, v);
	const double product = length(u) * length(v);
	// tan(x/2) = sin x / (1 + cos x)
	return product + cosine > 0 ? std::min(sine / (product + cosine), kMost) : kMost;
}

/// Mean value weights of the neighbours of every vertex. On a boundary only the two neighbours
/// along it count, so that it stays where it is.
Means meanValues(const CornerTable& table, const std::vector<Vec3>& positions)
{
	const std::vector<Index> first = firstCorners(table);
	Means means;
	means.begin.reserve(table.vertexCount + 1);
	std::vector<double> weights;
	for (Index v = 0; v < table.vertexCount; ++v) {
		means.begin.push_back(Index(means.vertex.size()));
		weights.clear();
		const Vec3& p    = positions[v];
		Index c          = first[v];
		bool boundary    = false;
		double previous  = 0; // half tangent of the face before
		const Index from = Index(means.vertex.size());
		do {
			// The face of corner c has the neighbours next(c) and, in the next face, prev(c).
			means.vertex.push_back(table.vertex[nextCorner(c)]);
			const double tangent = halfTangent(
			    p, positions[table.vertex[nextCorner(c)]], positions[table.vertex[prevCorner(c)]]);
			weights.push_back(previous + tangent);
			previous         = tangent;
			const Index last = c;
			c                = table.swingLeft(c);
			if (c == kNone) {
				boundary = true;
				means.vertex.push_back(table.vertex[prevCorner(last)]);
				weights.push_back(tangent);
			}
		} while (c != kNone && c != first[v]);
		if (boundary)
			std::fill(weights.begin() + 1, weights.end() - 1, 0.);
		else
			weights[0] += previous;
		if (boundary)
			weights.front() = weights.back() = 1;
		double sum = 0, spread = 0;
		for (std::size_t i = 0; i < weights.size(); ++i) {
			const double far = length(positions[means.vertex[from + i]] - p);
			spread += weights[i] * far;
			weights[i] = far > 0 ? weights[i] / far : 0;
			sum += weights[i];
		}
		for (const double w : weights)
			means.weight.push_back(float(sum > 0 ? w / sum : 1 / double(weights.size())));
		spread = sum > 0 ? spread / sum : 0;
		means.spread.push_back(spread > 1e-30 && spread < 1e30 ? float(spread) : 1);
		means.edge.push_back(boundary);
	}
	means.begin.push_back(Index(means.vertex.size()));
	return means;
}

std::vector<Vec3> normalsOf(const CornerTable& table, const std::vector<Vec3>& positions)
{
	std::vector<Vec3> normals(positions.size(), Vec3 {0, 0, 0});
	for (Index c = 0; c < table.cornerCount(); c += 3) {
		const Index* t = &table.vertex[c];
		const Vec3 n = cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
		for (int i = 0; i < 3; ++i)
			normals[t[i]] = normals[t[i]] + n;
	}
	for (Vec3& n : normals)
		n = unit(n);
	return normals;
}

/// One step of the pyramid, in the numbering of the replay: parents first.
struct PyramidStep
{
	Parents parents;           ///< of the children
	Means means;               ///< of all vertices of the level
	std::vector<Vec3> details; ///< of all vertices of the level
	std::vector<Vec3> normals; ///< of the predicted surface

	/// Level j from level j - 1. Children begin in the middle of their parents and relax until they
	/// are as far from the mean of their neighbours as their parents are, relative to how far those
	/// neighbours lie: curvature goes on, where a mean alone would sag.
	void predict(std::vector<Vec3>& values) const
	{
		const Index coarse = Index(values.size());
		for (const auto& p : parents) {
			const Vec3 sum = values[p[0]] + values[p[1]];
			values.push_back(p[2] == kNone ? 0.5 * sum : (1.0 / 3) * (sum + values[p[2]]));
		}
		// Without curvature first: a mean of means, which cannot run away.
		for (int sweep = 0; sweep < kSweeps; ++sweep)
			for (Index v = coarse; v < values.size(); ++v)
				values[v] = means.at(v, values);
		std::vector<Vec3> bends(values.size());
		for (int round = 0; round < kRounds; ++round) {
			for (Index v = 0; v < values.size(); ++v)
				bends[v] = values[v] - means.at(v, values);
			std::vector<Vec3> shifts(values.size(), Vec3 {0, 0, 0});
			for (int sweep = 0; sweep < kSweeps / 2; ++sweep)
				for (Index v = coarse; v < values.size(); ++v)
					shifts[v] =
					    means.at(v, shifts) + 0.5 * (parentsBend(v, coarse, bends) - bends[v]);
			for (Index v = coarse; v < values.size(); ++v)
				values[v] = values[v] + shifts[v];
		}
	}

	/// Mean over the parents that are like the vertex, on the boundary or not. Where a parent's
	/// neighbours lie farther off its bend counts as much less.
	Vec3 parentsBend(Index v, Index coarse, const std::vector<Vec3>& bends) const
	{
		Vec3 sum {0, 0, 0};
		int count = 0;
		for (const Index p : parents[v - coarse])
			if (p != kNone && means.edge[p] == means.edge[v]) {
				sum = sum + double(std::min(means.spread[v] / means.spread[p], 1.f)) * bends[p];
				++count;
			}
		return count > 0 ? (1.0 / count) * sum : sum;
	}

	/// The vertices of level j - 1, smoothed: I - kSmoothing L^2, L the difference from the mean of
	/// the neighbours. The square leaves curvature alone, where L itself would shrink the mesh.
	std::vector<Vec3> smoothed(const std::vector<Vec3>& values) const
	{
		const Index coarse = Index(values.size() - parents.size());
		std::vector<Vec3> bends(values.size()), out(coarse);
		for (Index v = 0; v < values.size(); ++v)
			bends[v] = values[v] - means.at(v, values);
		for (Index v = 0; v < coarse; ++v)
			out[v] = values[v] - kSmoothing * (bends[v] - means.at(v, bends));
		return out;
	}
};

} // namespace

struct DetailPyramid::Levels
{
	std::vector<PyramidStep> steps; ///< coarsest first
	std::vector<Index> source;      ///< row of the mesh of each vertex of the pyramid
	std::vector<Vec3> positions;    ///< of the mesh
	std::size_t baseVertices = 0;
};

Result<DetailPyramid> DetailPyramid::of(const MeshData& mesh, const MultiresolutionOptions& options)
{
	const auto work = [&]() -> Result<DetailPyramid> {
		auto replayed = replayLevels(mesh, options);
		if (!replayed.ok())
			return replayed.status();
		auto levels       = std::make_shared<Levels>();
		levels->positions = mesh.positions;
		levels->source    = std::move(replayed->source);
		levels->steps.resize(replayed->levels.size());
		std::vector<Vec3> values;
		for (const Index v : levels->source)
			values.push_back(mesh.positions[v]);
		CornerTable fine = std::move(replayed->finest);
		for (std::size_t j = levels->steps.size(); j-- > 0;) {
			PyramidStep& step          = levels->steps[j];
			const ReplayedLevel& level = replayed->levels[j];
			step.parents               = parentsOf(level.parent, level.refinement);
			step.means                 = meanValues(fine, values);
			std::vector<Vec3> coarse   = step.smoothed(values);
			std::vector<Vec3> smooth   = coarse;
			step.predict(smooth);
			step.normals = normalsOf(fine, smooth);
			step.details.reserve(values.size());
			for (std::size_t v = 0; v < values.size(); ++v)
				step.details.push_back(values[v] - smooth[v]);
			values            = std::move(coarse);
			fine              = std::move(replayed->levels[j].parent);
			const double done = 1 - double(values.size()) / double(levels->source.size());
			if (options.progress && !options.progress(0.8 + 0.2 * done))
				return Status(StatusCode::Cancelled, "cancelled");
		}
		levels->baseVertices = values.size();
		return DetailPyramid(std::move(levels));
	};
	return guarded(work, [] { return "for the levels of this mesh"; });
}

int DetailPyramid::finestLevel() const
{
	return int(levels_->steps.size());
}

std::vector<Vec3> DetailPyramid::equalise(const Equaliser& equaliser) const
{
	std::vector<Vec3> changes(levels_->baseVertices, Vec3 {0, 0, 0});
	bool any = false; // has anything changed so far?
	for (std::size_t j = 0; j < levels_->steps.size(); ++j) {
		const PyramidStep& step = levels_->steps[j];
		const double gain       = j + 1 < equaliser.gains.size() ? equaliser.gains[j + 1] : 1;
		const bool cuts =
		    equaliser.threshold > 0 && int(j) >= finestLevel() - equaliser.thresholdLevels;
		if (any)
			step.predict(changes);
		else
			changes.assign(step.details.size(), Vec3 {0, 0, 0});
		if (gain == 1 && !cuts)
			continue;
		any = true;
		for (std::size_t v = 0; v < changes.size(); ++v) {
			const Vec3 &d = step.details[v], &n = step.normals[v];
			const double along = dot(d, n);
			const double cut   = cuts ? partCut(along, equaliser.threshold) : 0;
			const Vec3 scaled  = equaliser.normalOnly ? (along - cut) * n : d - cut * n;
			changes[v]         = changes[v] + (gain - 1) * scaled - cut * n;
		}
	}
	std::vector<Vec3> out = levels_->positions;
	for (std::size_t v = 0; v < changes.size(); ++v)
		for (std::size_t k = 0; k < 3; ++k)
			if (changes[v][k] != 0) // adding 0 would turn -0 into 0
				out[levels_->source[v]][k] += changes[v][k];
	return out;
}

} // namespace wavemesh
