// SPDX-License-Identifier: GPL-3.0-or-later
// The promises that are asked for: order and exact floating point, together and with any mesh.
#include "codec_check.h"
#include "finish/rank_set.h"
#include "mesh_build.h"
#include "mesh_families.h"
#include "rng.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <set>

namespace wavemesh::test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool sameBits(const MeshData& a, const MeshData& b)
{
	return a.positions.size() == b.positions.size() &&
	       (a.positions.empty() || std::memcmp(
	                                   a.positions.data(), b.positions.data(),
	                                   a.positions.size() * sizeof a.positions[0]) == 0);
}

/// Encodes with the order kept, decodes, and compares row by row.
std::string whatFails(const MeshData& mesh, EncodeOptions o)
{
	o.keepOrder     = true;
	const auto file = encode(mesh, o);
	if (!file.ok())
		return "encode: " + file.status().what;
	if (!file->info.features.orderKept || file->info.features.exact != o.exact)
		return "the info does not tell";
	const auto back = decode(file->bytes.data(), file->bytes.size());
	if (!back.ok())
		return "decode: " + back.status().what;
	if (back->mesh.triangles != mesh.triangles)
		return "faces come in another order";
	if (o.exact)
		return sameBits(mesh, back->mesh) ? "" : "a coordinate has other bits";
	return latticeOf(mesh, back->info) == latticeOf(back->mesh, back->info)
	           ? ""
	           : "vertices come in another order";
}

MeshData withPositions(MeshData mesh, double (*change)(double, Rng&))
{
	Rng rng(5);
	for (auto& p : mesh.positions)
		for (double& x : p)
			x = change(x, rng);
	return mesh;
}

TEST(RankSet, AgreesWithASortedSet)
{
	Rng rng(1);
	for (Index n : {1u, 2u, 3u, 7u, 8u, 100u}) {
		RankSet ranks(n, true);
		std::set<Index> truth;
		for (Index x = 0; x < n; ++x)
			truth.insert(x);
		for (int i = 0; i < 300; ++i) {
			const Index x = rng.below(n);
			if (ranks.has(x)) {
				ranks.erase(x);
				truth.erase(x);
			}
			else {
				ranks.insert(x);
				truth.insert(x);
			}
			ASSERT_EQ(ranks.count(), truth.size());
			Index rank = 0;
			for (const Index member : truth) {
				ASSERT_EQ(ranks.at(rank), member);
				ASSERT_EQ(ranks.below(member), rank);
				++rank;
			}
			ASSERT_EQ(ranks.below(n), truth.size());
		}
	}
}

TEST(KeepOrder, EveryFamilyComesBackInItsOrderAndShuffled)
{
	std::uint64_t seed = 1;
	for (const NamedMesh& family : allFamilies()) {
		ASSERT_EQ(whatFails(family.mesh, {}), "") << family.name;
		ASSERT_EQ(whatFails(shuffled(family.mesh, ++seed), {}), "") << family.name;
	}
}

TEST(KeepOrder, MeshesThatAreNoManifoldComeBackInTheirOrder)
{
	Rng rng(3);
	for (int i = 0; i < 60; ++i) {
		MeshData mesh;
		const std::uint32_t vertices = 2 + rng.below(30);
		for (std::uint32_t v = 0; v < vertices; ++v)
			addVertex(mesh, rng.below(100), rng.below(100), rng.below(100));
		for (std::uint32_t f = rng.below(60); f > 0; --f)
			addFace(mesh, rng.below(vertices), rng.below(vertices), rng.below(vertices));
		ASSERT_EQ(whatFails(mesh, {}), "") << i;
	}
	EXPECT_EQ(whatFails({}, {}), "");
}

TEST(KeepOrder, CostsLittleWhereTheOrderIsCoherent)
{
	for (const MeshData& mesh : {makeGrid(60, 50), makeTorus(60, 40), makeIcosphere(20)}) {
		EncodeOptions o;
		o.keepOrder     = true;
		const auto file = encode(mesh, o);
		ASSERT_TRUE(file.ok());
		EXPECT_LT(8.0 * double(file->info.features.orderBytes), 3.0 * file->info.vertices);
	}
}

TEST(Exact, AnyBitPatternComesBack)
{
	const MeshData mesh = makeBumpySphere(200, 9);
	EncodeOptions o;
	o.exact = true;
	EXPECT_EQ(whatFails(mesh, o), "");
	EXPECT_EQ(
	    whatFails(withPositions(mesh, [](double x, Rng&) { return double(float(x)); }), o), "");
	EXPECT_EQ(whatFails(withPositions(mesh, [](double x, Rng&) { return x * 1e-310; }), o), "");
	EXPECT_EQ(whatFails(withPositions(mesh, [](double x, Rng&) { return x * 1e308; }), o), "");
	EXPECT_EQ(
	    whatFails(
	        withPositions(mesh, [](double x, Rng&) { return std::round(x * 5000) / 1000; }), o),
	    "");
	EXPECT_EQ(
	    whatFails(
	        withPositions(
	            mesh, [](double x, Rng&) { return double(float(std::round(x * 50000) / 10000)); }),
	        o),
	    "");
	const auto anything = [](double, Rng& rng) {
		const std::uint64_t bits = rng.next();
		double x;
		std::memcpy(&x, &bits, sizeof x);
		return x;
	};
	EXPECT_EQ(whatFails(withPositions(mesh, anything), o), "");
}

TEST(Exact, SpecialNumbersComeBack)
{
	const double specials[] = {
	    0.0,
	    -0.0,
	    kInfinity,
	    -kInfinity,
	    std::numeric_limits<double>::quiet_NaN(),
	    std::numeric_limits<double>::denorm_min(),
	    std::numeric_limits<double>::max(),
	    -std::numeric_limits<double>::max(),
	    double(std::numeric_limits<float>::max()),
	    double(std::numeric_limits<float>::denorm_min()),
	    1e-40,
	    0.1,
	    double(0.1f),
	    1e22,
	    123456.789};
	EncodeOptions o;
	o.exact = true;
	for (const double x : specials) {
		MeshData mesh        = makeIcosphere(2);
		mesh.positions[5][1] = x;
		EXPECT_EQ(whatFails(mesh, o), "") << x;
		for (auto& p : mesh.positions)
			p = {x, x, x};
		EXPECT_EQ(whatFails(mesh, o), "") << "all " << x;
	}
}

TEST(Exact, IsolatedVerticesThatAreNowhereComeBack)
{
	EncodeOptions o;
	o.exact = true;
	for (const double x : {kInfinity, -kInfinity, std::nan("")}) {
		MeshData mesh = makeIcosphere(2);
		mesh.positions.push_back({x, 0.5, x});
		EXPECT_EQ(whatFails(mesh, o), "") << x;
	}
}

TEST(Exact, WithoutItANumberThatIsNotFiniteIsRefusedAndTheVertexNamed)
{
	for (const double x : {kInfinity, -kInfinity, std::nan("")}) {
		MeshData mesh         = makeIcosphere(2);
		mesh.positions[17][2] = x;
		const auto file       = encode(mesh);
		EXPECT_EQ(file.status().code, StatusCode::InvalidArgument);
		EXPECT_NE(file.status().what.find("vertex 17"), std::string::npos);
	}
}

TEST(Exact, CoordinatesBeyondAllFloatsNeedItNot)
{
	constexpr double kLargest = std::numeric_limits<double>::max();
	for (const auto& [x, y] :
	     {std::array<double, 2> {1e200, 0},
	      {3.5e38, -3.5e38},
	      {1.7e308, 0},
	      {kLargest, 0},
	      {0, -kLargest},
	      {kLargest / 2, -kLargest / 2}})
		for (const int bits : {1, 7, 12, 24}) {
			MeshData mesh        = makeIcosphere(2);
			mesh.positions[7][2] = x;
			mesh.positions[9][2] = y;
			EncodeOptions o;
			o.bits = bits;
			ASSERT_EQ(whatFails(mesh, o), "") << x << " " << y << " " << bits;
			const auto file = encode(mesh, o);
			const auto back = decode(file->bytes.data(), file->bytes.size());
			for (const auto& p : back->mesh.positions)
				for (const double c : p)
					ASSERT_TRUE(std::isfinite(c)) << x << " " << y << " " << bits;
		}
}

TEST(Exact, IsNeededWhereALatticeWouldReachBeyondAllDoubles)
{
	MeshData mesh = makeIcosphere(2);
	for (auto& p : mesh.positions)
		p = {1e308 * p[0], 1.7e308, p[2]};
	const auto file = encode(mesh, {});
	ASSERT_FALSE(file.ok());
	EXPECT_EQ(file.status().code, StatusCode::InvalidArgument);
	EncodeOptions o;
	o.exact = true;
	EXPECT_EQ(whatFails(mesh, o), "");
}

TEST(Exact, LinesAndPlanesComeBack)
{
	EncodeOptions o;
	o.exact       = true;
	MeshData flat = makeFlatGrid(9, 7);
	EXPECT_EQ(whatFails(flat, o), "");
	for (auto& p : flat.positions)
		p[1] = 0.25;
	EXPECT_EQ(whatFails(flat, o), "");
	EXPECT_EQ(whatFails(flat, {}), "");
}

TEST(Exact, NumbersOfFewDigitsCostFewBits)
{
	const MeshData mesh = withPositions(
	    makeBumpySphere(2000, 9), [](double x, Rng&) { return std::round(x * 1e6) / 1e6; });
	EncodeOptions o;
	o.exact         = true;
	o.bits          = 12;
	const auto file = encode(mesh, o);
	ASSERT_TRUE(file.ok());
	// A step is about a thousand millionths.
	EXPECT_LT(8.0 * double(file->info.features.exactBytes) / double(file->info.vertices), 3 * 11.0);
}

TEST(Exact, EveryPromiseTogetherWithAnyMesh)
{
	MeshData mesh = shuffled(makeBumpySphere(300, 8), 2);
	for (std::uint32_t i = 0; i < 20; ++i) {
		mesh.triangles.push_back({i, i + 30, i + 90});
		mesh.triangles.push_back({i, i, i + 1});
		addVertex(mesh, 0.1 * i, 7, 1e-9);
	}
	mesh.positions[3][1] = kInfinity;
	EncodeOptions o;
	o.exact = true;
	EXPECT_EQ(whatFails(mesh, o), "");
	o.lifting = kLiftingOff;
	EXPECT_EQ(whatFails(mesh, o), "");
}

TEST(Promises, AFileCutBehindTheLevelsGivesTheFinestLevelAndSaysSo)
{
	const MeshData mesh = joined({makeBumpySphere(100, 8), makeStrip(3)});
	EncodeOptions o;
	o.exact = o.keepOrder = true;
	const auto file       = encode(mesh, o);
	ASSERT_TRUE(file.ok());
	const std::uint64_t levels = file->bytes.size() - file->info.features.orderBytes -
	                             file->info.features.exactBytes - 2 * 6;
	for (std::size_t size = levels; size < file->bytes.size(); size += 9) {
		const auto back = decode(file->bytes.data(), size);
		ASSERT_TRUE(back.hasValue()) << size;
		ASSERT_EQ(back.status().code, StatusCode::Truncated) << size;
		ASSERT_EQ(back->level, file->info.finestLevel()) << size;
		ASSERT_EQ(back->mesh.positions.size(), mesh.positions.size());
	}
}

TEST(Promises, NoneIsMadeUnasked)
{
	const auto file = encode(makeIcosphere(3));
	ASSERT_TRUE(file.ok());
	EXPECT_FALSE(file->info.features.restored);
	EXPECT_FALSE(file->info.features.orderKept);
	EXPECT_FALSE(file->info.features.exact);
	EXPECT_EQ(file->info.features.orderBytes + file->info.features.exactBytes, 0u);
}

} // namespace
} // namespace wavemesh::test
