// SPDX-License-Identifier: GPL-3.0-or-later
// The thumbnailer's picture, of meshes that are nowhere, too.
#include "mesh_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wavemesh::test {
namespace {

int pixelsDrawn(const MeshData& mesh)
{
	const QImage image = pictureOf(mesh, 64);
	int drawn          = 0;
	for (int y = 0; y < image.height(); ++y)
		for (int x = 0; x < image.width(); ++x)
			drawn += qAlpha(image.pixel(x, y)) > 0;
	return drawn;
}

MeshData tetrahedron()
{
	MeshData mesh;
	mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
	mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
	return mesh;
}

TEST(MeshPicture, LeavesOutFacesThatAreNowhere)
{
	const int whole = pixelsDrawn(tetrahedron());
	EXPECT_GT(whole, 1000);
	constexpr double kInfinity = std::numeric_limits<double>::infinity();
	for (const double x : {std::nan(""), kInfinity, -kInfinity})
		for (std::size_t k = 0; k < 3; ++k) {
			MeshData mesh        = tetrahedron();
			mesh.positions[1][k] = x;
			EXPECT_GT(pixelsDrawn(mesh), 0) << x;
			mesh.positions.assign(4, {x, x, x});
			EXPECT_EQ(pixelsDrawn(mesh), 0) << x;
		}
}

/// Only a sanitizer tells whether this is defined.
TEST(MeshPicture, OfNumbersOfAnySizeIsDefined)
{
	for (const double x : {1e30, 1e200, 1.7e308, -1.7e308, 1e-320})
		for (std::size_t k = 0; k < 3; ++k) {
			MeshData mesh        = tetrahedron();
			mesh.positions[1][k] = x;
			(void)pixelsDrawn(mesh);
			for (auto& p : mesh.positions)
				for (double& c : p)
					c *= x;
			(void)pixelsDrawn(mesh);
		}
}

} // namespace
} // namespace wavemesh::test
