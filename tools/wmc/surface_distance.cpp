// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface_distance.h"

#include "vcg_mesh.h"

#include <wavemesh/vcg_wmc.h>

#include <vcg/complex/algorithms/closest.h>
#include <vcg/complex/algorithms/update/component_ep.h>
#include <vcg/space/index/grid_static_ptr.h>

#include <algorithm>
#include <cmath>

namespace wavemesh::tool {

namespace {

using Point = vcg::Point3d;

/// The n-th of points that fill a triangle evenly, as barycentric coordinates: the R2 sequence
/// folded into the triangle.
Point barycentric(std::uint64_t n)
{
	const double whole = static_cast<double>(n) + 0.5;
	double u           = std::fmod(whole * 0.7548776662466927, 1),
	       v           = std::fmod(whole * 0.5698402909980532, 1);
	if (u + v > 1) {
		u = 1 - u;
		v = 1 - v;
	}
	return {1 - u - v, u, v};
}

} // namespace

struct DistanceMeter::Surface
{
	mutable VcgMesh mesh;
	mutable vcg::GridStaticPtr<VcgFace, double> grid;

	explicit Surface(const MeshData& data)
	{
		fromMeshData(data, mesh);
		vcg::tri::UpdateNormal<VcgMesh>::PerFaceNormalized(mesh);
		grid.Set(mesh.face.begin(), mesh.face.end());
	}

	double distanceTo(const Point& p, double reach) const
	{
		double distance = reach;
		Point nearest;
		vcg::tri::GetClosestFaceBase(mesh, grid, p, reach, distance, nearest);
		return std::fabs(distance);
	}
};

DistanceMeter::DistanceMeter(const MeshData& original, std::size_t samples) :
        original_(std::make_unique<Surface>(original)), samples_(samples)
{
}

DistanceMeter::~DistanceMeter() = default;

double DistanceMeter::diagonal() const
{
	const double d = original_->mesh.bbox.Diag();
	return d > 0 ? d : 1;
}

SurfaceDistance
DistanceMeter::measure(const MeshData& mesh, const std::function<void(double)>& progress) const
{
	const Surface other(mesh);
	const double reach = 10 * (diagonal() + other.mesh.bbox.Diag());
	SurfaceDistance result;
	double done = 0;

	auto oneWay = [&](const Surface& from, const Surface& to) {
		double area = 0;
		for (const VcgFace& f : from.mesh.face)
			area += vcg::DoubleArea(f);
		double squares = 0, due = 0;
		std::uint64_t count = 0;
		for (const VcgFace& f : from.mesh.face) {
			// So many as this face's share, what is left over goes to the next.
			due += area > 0 ? static_cast<double>(samples_) * vcg::DoubleArea(f) / area : 0;
			for (; due >= 1; due -= 1) {
				const Point b  = barycentric(count++);
				const Point p  = f.cP(0) * b[0] + f.cP(1) * b[1] + f.cP(2) * b[2];
				const double d = to.distanceTo(p, reach);
				squares += d * d;
				result.max = std::max(result.max, d);
				if (progress && count % 4096 == 0)
					progress(
					    done + 0.5 * static_cast<double>(count) / static_cast<double>(samples_));
			}
		}
		for (const VcgVertex& v : from.mesh.vert) // corners are where the largest distances are
			result.max = std::max(result.max, to.distanceTo(v.cP(), reach));
		if (count > 0)
			result.rms = std::max(result.rms, std::sqrt(squares / static_cast<double>(count)));
		done += 0.5;
	};
	oneWay(*original_, other);
	oneWay(other, *original_);
	return result;
}

} // namespace wavemesh::tool
