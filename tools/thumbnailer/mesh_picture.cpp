// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace wavemesh {
namespace {

using Vec3 = std::array<double, 3>;

/// Pixels are drawn so many times as fine in either direction, and averaged.
constexpr int kFiner = 3;
/// Below the cosine of this angle between a face and the mean of its neighbours, the edge is sharp.
constexpr double kSharp = 0.9;

Vec3 cross(const Vec3& a, const Vec3& b)
{
	return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double dot(const Vec3& a, const Vec3& b)
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vec3 minus(const Vec3& a, const Vec3& b)
{
	return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Vec3 unit(const Vec3& a)
{
	const double length = std::sqrt(dot(a, a));
	return length > 0 ? Vec3 {a[0] / length, a[1] / length, a[2] / length} : Vec3 {0, 0, 0};
}

bool isFinite(const Vec3& a)
{
	return std::isfinite(a[0]) && std::isfinite(a[1]) && std::isfinite(a[2]);
}

/// Turned to the view, and scaled to the picture: x to the right, y down, z towards the eye. What
/// is nowhere stays nowhere.
std::vector<Vec3> toView(const std::vector<Vec3>& positions, int size)
{
	const double yaw = -0.5, pitch = 0.35;
	std::vector<Vec3> view;
	view.reserve(positions.size());
	Vec3 low, high;
	low.fill(std::numeric_limits<double>::max());
	high.fill(std::numeric_limits<double>::lowest());
	for (const Vec3& p : positions) {
		const double x = std::cos(yaw) * p[0] + std::sin(yaw) * p[2];
		const double z = std::cos(yaw) * p[2] - std::sin(yaw) * p[0];
		view.push_back(
		    {x, -(std::cos(pitch) * p[1] - std::sin(pitch) * z),
		     std::sin(pitch) * p[1] + std::cos(pitch) * z});
		for (std::size_t k = 0; k < 3 && isFinite(view.back()); ++k) {
			low[k]  = std::min(low[k], view.back()[k]);
			high[k] = std::max(high[k], view.back()[k]);
		}
	}
	const double extent = std::max(high[0] - low[0], high[1] - low[1]);
	const double scale  = extent > 0 ? 0.94 * size / extent : 1;
	for (Vec3& p : view) {
		p[0] = size / 2. + scale * (p[0] - (low[0] + high[0]) / 2);
		p[1] = size / 2. + scale * (p[1] - (low[1] + high[1]) / 2);
		p[2] *= scale;
	}
	return view;
}

/// A picture with depths.
class Canvas
{
public:
	explicit Canvas(int size) :
	        size_(size), image_(size, size, QImage::Format_ARGB32_Premultiplied),
	        depth_(std::size_t(size) * std::size_t(size), std::numeric_limits<double>::lowest())
	{
		image_.fill(Qt::transparent);
	}

	/// @param light  of the corners, 0..1
	void triangle(const Vec3 (&p)[3], const double (&light)[3])
	{
		const double area =
		    (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
		if (!std::isfinite(area) || area == 0 || !isFinite(p[0]) || !isFinite(p[1]) ||
		    !isFinite(p[2]))
			return;
		const auto range = [&](std::size_t k) {
			const double low  = std::min({p[0][k], p[1][k], p[2][k]});
			const double high = std::max({p[0][k], p[1][k], p[2][k]});
			const double last = size_ - 1;
			return std::pair(
			    int(std::clamp(std::floor(low), 0., last)),
			    int(std::clamp(std::ceil(high), 0., last)));
		};
		const auto [left, right] = range(0);
		const auto [top, bottom] = range(1);
		for (int y = top; y <= bottom; ++y) {
			auto* line = reinterpret_cast<QRgb*>(image_.scanLine(y));
			for (int x = left; x <= right; ++x) {
				double w[3];
				for (std::size_t i = 0; i < 3; ++i) {
					const Vec3 &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
					w[i] = ((b[0] - a[0]) * (y + 0.5 - a[1]) - (b[1] - a[1]) * (x + 0.5 - a[0])) /
					       area;
				}
				if (w[0] < 0 || w[1] < 0 || w[2] < 0)
					continue;
				const double depth = w[0] * p[0][2] + w[1] * p[1][2] + w[2] * p[2][2];
				double& nearest    = depth_[std::size_t(y) * std::size_t(size_) + std::size_t(x)];
				if (depth <= nearest)
					continue;
				nearest = depth;
				line[x] = colour(w[0] * light[0] + w[1] * light[1] + w[2] * light[2]);
			}
		}
	}

	const QImage& image() const { return image_; }

private:
	static QRgb colour(double light)
	{
		const auto part = [light](double full) {
			return int(std::clamp(full * (0.25 + 0.75 * light), 0., 255.));
		};
		return qRgb(part(196), part(206), part(220));
	}

	int size_;
	QImage image_;
	std::vector<double> depth_;
};

} // namespace

QImage pictureOf(const MeshData& mesh, int size)
{
	const std::vector<Vec3> view = toView(mesh.positions, size * kFiner);
	std::vector<Vec3> faceNormals, vertexNormals(view.size(), Vec3 {0, 0, 0});
	faceNormals.reserve(mesh.triangles.size());
	for (const auto& t : mesh.triangles) {
		const Vec3 n = cross(minus(view[t[1]], view[t[0]]), minus(view[t[2]], view[t[0]]));
		for (const std::uint32_t v : t)
			for (std::size_t k = 0; k < 3; ++k)
				vertexNormals[v][k] += n[k];
		faceNormals.push_back(unit(n));
	}
	for (Vec3& n : vertexNormals)
		n = unit(n);

	const Vec3 lamp = unit({-0.35, -0.5, 1});
	Canvas canvas(size * kFiner);
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
		const auto& t = mesh.triangles[f];
		Vec3 corners[3];
		double light[3];
		for (std::size_t i = 0; i < 3; ++i) {
			corners[i]      = view[t[i]];
			const Vec3& n   = faceNormals[f];
			const Vec3& m   = vertexNormals[t[i]];
			const bool soft = dot(n, m) > kSharp;
			light[i]        = std::fabs(dot(soft ? m : n, lamp));
		}
		canvas.triangle(corners, light);
	}
	return canvas.image().scaled(size, size, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

} // namespace wavemesh
