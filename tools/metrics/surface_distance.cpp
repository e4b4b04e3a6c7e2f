// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_distance.h"

#include "closest_point.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace wavemesh::metrics {

namespace {

/// The n-th of points that fill a triangle evenly, as barycentric coordinates: the R2 sequence
/// folded into the triangle.
Vec3 barycentric(std::uint64_t n)
{
	const double whole = static_cast<double>(n) + 0.5;
	double u           = std::fmod(whole * 0.7548776662466927, 1);
	double v           = std::fmod(whole * 0.5698402909980532, 1);
	if (u + v > 1) {
		u = 1 - u;
		v = 1 - v;
	}
	return {1 - u - v, u, v};
}

double areaOf(const Vec3& a, const Vec3& b, const Vec3& c)
{
	double sum = 0;
	for (std::size_t k = 0; k < 3; ++k) {
		const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
		const double n = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
		sum += n * n;
	}
	return 0.5 * std::sqrt(sum);
}

double diagonalOf(const MeshData& mesh)
{
	double sum = 0;
	for (std::size_t k = 0; k < 3; ++k) {
		double low = mesh.positions[0][k], high = low;
		for (const Vec3& p : mesh.positions) {
			low  = std::min(low, p[k]);
			high = std::max(high, p[k]);
		}
		sum += (high - low) * (high - low);
	}
	return std::sqrt(sum);
}

} // namespace

struct DistanceMeter::Surface
{
	MeshData mesh;
	ClosestPoint closest;
	std::vector<double> areas; ///< of the faces
	double area = 0;

	explicit Surface(const MeshData& data) : mesh(data), closest(mesh)
	{
		const auto& p = mesh.positions;
		areas.reserve(mesh.triangles.size());
		for (const auto& t : mesh.triangles) {
			areas.push_back(areaOf(p[t[0]], p[t[1]], p[t[2]]));
			area += areas.back();
		}
	}

	/// Calls `visit` with each of about `samples` points spread over the area.
	template <class Visit>
	void sample(std::size_t samples, Visit visit) const
	{
		const double density = area > 0 ? static_cast<double>(samples) / area : 0;
		double due           = 0;
		std::uint64_t count  = 0;
		for (std::size_t f = 0; f < areas.size(); ++f) {
			const auto& t = mesh.triangles[f];
			// So many as this face's share; what is left over goes to the next.
			for (due += density * areas[f]; due >= 1; due -= 1) {
				const Vec3 w = barycentric(count++);
				Vec3 p {};
				for (std::size_t i = 0; i < 3; ++i)
					for (std::size_t k = 0; k < 3; ++k)
						p[k] += w[i] * mesh.positions[t[i]][k];
				visit(p, count);
			}
		}
	}
};

DistanceMeter::DistanceMeter(const MeshData& original, std::size_t samples) :
        original_(std::make_unique<Surface>(original)), samples_(samples),
        diagonal_(diagonalOf(original))
{
	if (!(diagonal_ > 0))
		diagonal_ = 1;
}

DistanceMeter::~DistanceMeter() = default;

SurfaceDistance
DistanceMeter::measure(const MeshData& mesh, const std::function<void(double)>& progress) const
{
	const Surface other(mesh);
	SurfaceDistance result;
	double done = 0;
	auto oneWay = [&](const Surface& from, const Surface& to) {
		double squares     = 0;
		std::uint64_t seen = 0;
		from.sample(samples_, [&](const Vec3& p, std::uint64_t count) {
			const double d = to.closest.distance(p);
			squares += d * d;
			result.max = std::max(result.max, d);
			seen       = count;
			if (progress && count % 4096 == 0)
				progress(done + 0.5 * static_cast<double>(count) / static_cast<double>(samples_));
		});
		for (const Vec3& p : from.mesh.positions) // corners are where the largest distances are
			result.max = std::max(result.max, to.closest.distance(p));
		if (seen > 0)
			result.rms = std::max(result.rms, std::sqrt(squares / static_cast<double>(seen)));
		done += 0.5;
	};
	oneWay(*original_, other);
	oneWay(other, *original_);
	return result;
}

} // namespace wavemesh::metrics
