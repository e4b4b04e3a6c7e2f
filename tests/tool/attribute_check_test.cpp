// SPDX-License-Identifier: GPL-3.0-or-later
#include "attribute_check.h"

#include "mesh_families.h"
#include "rng.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace wavemesh::test {

namespace {

constexpr double kStep = 1.0 / 1024;

std::string whatDiffers(const MeshData& original, const MeshData& decoded, double step)
{
	const auto atOnePlace = [](const MeshData& m) {
		return tool::LabelledMesh {
		    std::vector<std::array<std::int64_t, 3>>(m.positions.size()), m.triangles};
	};
	StreamInfo info;
	info.attributes.resize(decoded.attributes.size());
	for (AttributeInfo& a : info.attributes)
		a.step = step;
	return tool::whatDiffersInAttributes(
	    original, atOnePlace(original), decoded, atOnePlace(decoded), info);
}

/// `rows` numbers of three columns, and the same in another order and on steps.
struct Rows
{
	Attribute original, decoded;

	Rows(AttributeOf of, std::size_t rows, bool rounded)
	{
		Rng rng(3);
		original.of         = of;
		original.components = 3;
		decoded             = original;
		for (std::size_t i = 0; i < 3 * rows; ++i)
			original.values.push_back(rounded ? rng.between(0, 1) : rng.below(50));
		std::vector<std::size_t> order(rows);
		std::iota(order.begin(), order.end(), std::size_t(0));
		for (std::size_t i = rows; i > 1; --i)
			std::swap(order[i - 1], order[rng.below(static_cast<std::uint32_t>(i))]);
		for (const std::size_t row : order)
			for (std::size_t k = 0; k < 3; ++k) {
				const double x = original.values[3 * row + k];
				decoded.values.push_back(rounded ? std::round(x / kStep) * kStep : x);
			}
	}
};

} // namespace

TEST(AttributeCheck, OfManyVerticesInOnePlaceEnds)
{
	// Comparing every vertex with every other one would not end.
	for (const bool rounded : {false, true}) {
		const Rows rows(AttributeOf::Vertex, 300'000, rounded);
		MeshData original {std::vector<std::array<double, 3>>(300'000), {}, {rows.original}, {}};
		MeshData decoded      = original;
		decoded.attributes[0] = rows.decoded;
		const double step     = rounded ? kStep : 0;
		EXPECT_EQ(whatDiffers(original, decoded, step), "") << rounded;
		decoded.attributes[0].values[333'333] += 0.75 * kStep;
		EXPECT_NE(whatDiffers(original, decoded, step), "") << rounded;
	}
}

TEST(AttributeCheck, OfManyFacesInOnePlaceEnds)
{
	constexpr std::uint32_t kFaces = 100'000;
	for (const bool rounded : {false, true}) {
		const Rows rows(AttributeOf::Face, kFaces, rounded);
		MeshData original = makeTriangle();
		original.triangles.assign(kFaces, original.triangles[0]);
		MeshData decoded    = original;
		original.attributes = {rows.original};
		decoded.attributes  = {rows.decoded};
		EXPECT_EQ(whatDiffers(original, decoded, rounded ? kStep : 0), "") << rounded;
		decoded.attributes[0].values[7] += 0.75 * kStep;
		EXPECT_NE(whatDiffers(original, decoded, rounded ? kStep : 0), "") << rounded;
	}
}

} // namespace wavemesh::test
