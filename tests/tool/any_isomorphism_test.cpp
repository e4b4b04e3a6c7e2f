// SPDX-License-Identifier: GPL-3.0-or-later
#include "any_isomorphism.h"

#include "mesh_edit.h"
#include "mesh_families.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace wavemesh::test {

namespace {

using tool::LabelledMesh;
using tool::whatDiffersInAnyMesh;

/// Labels are the positions' whole parts.
LabelledMesh labelled(const MeshData& mesh)
{
	LabelledMesh out;
	out.triangles = mesh.triangles;
	for (const auto& p : mesh.positions)
		out.labels.push_back({std::llround(p[0]), std::llround(p[1]), std::llround(p[2])});
	return out;
}

LabelledMesh unlabelled(const MeshData& mesh)
{
	return labelled(scaled(mesh, 0, 0, 0));
}

/// Pages of one edge: each is a strip of faces from the edge outwards.
MeshData makePages(std::uint32_t pages, std::uint32_t facesOfEach)
{
	MeshData mesh;
	mesh.positions = {{0, 0, 0}, {0, 0, 1}};
	for (std::uint32_t page = 0; page < pages; ++page) {
		std::uint32_t a = 0, b = 1;
		for (std::uint32_t i = 0; i < facesOfEach; ++i) {
			const auto c = static_cast<std::uint32_t>(mesh.positions.size());
			mesh.positions.push_back({1.0 + i, double(page), 0});
			mesh.triangles.push_back({a, b, c});
			(i % 2 == 0 ? a : b) = c;
		}
	}
	return mesh;
}

/// Pyramids without a base that meet in one apex.
MeshData makeCones(std::uint32_t cones, std::uint32_t sides)
{
	MeshData mesh;
	mesh.positions = {{0, 0, 0}};
	for (std::uint32_t i = 0; i < cones; ++i) {
		const auto first = static_cast<std::uint32_t>(mesh.positions.size());
		for (std::uint32_t k = 0; k < sides; ++k) {
			mesh.positions.push_back({1.0 + i, double(k), 1});
			mesh.triangles.push_back({0, first + k, first + (k + 1) % sides});
		}
	}
	return mesh;
}

/// A torus of 12 x 7 vertices, put together with a turn: all look alike from everywhere.
MeshData makeTurnedTorus(int turn)
{
	constexpr int kLong = 12, kAround = 7;
	MeshData mesh = makeTorus(kLong, kAround);
	mesh.triangles.clear();
	const auto at = [&](int i, int j) {
		return static_cast<std::uint32_t>(
		    i % kLong * kAround + (j + (i >= kLong ? turn : 0)) % kAround);
	};
	for (int i = 0; i < kLong; ++i)
		for (int j = 0; j < kAround; ++j) {
			mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
			mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
		}
	return mesh;
}

/// Vertex 0 of all parts becomes one.
MeshData joinedAtAVertex(const std::vector<MeshData>& parts)
{
	MeshData mesh       = joined(parts);
	std::uint32_t first = 0;
	for (const MeshData& part : parts) {
		for (auto& t : mesh.triangles)
			std::replace(t.begin(), t.end(), first, 0u);
		first += static_cast<std::uint32_t>(part.positions.size());
	}
	return mesh;
}

MeshData makeAnyFaces(std::uint32_t vertices, std::uint32_t faces, std::uint32_t labels, Rng& rng)
{
	MeshData mesh;
	for (std::uint32_t v = 0; v < vertices; ++v)
		mesh.positions.push_back({double(rng.below(labels)), 0, 0});
	for (std::uint32_t f = 0; f < faces; ++f)
		mesh.triangles.push_back({rng.below(vertices), rng.below(vertices), rng.below(vertices)});
	return mesh;
}

std::vector<std::array<std::uint32_t, 3>>
renumbered(const LabelledMesh& m, const std::vector<std::uint32_t>& to)
{
	auto faces = m.triangles;
	for (auto& t : faces) {
		for (std::uint32_t& v : t)
			v = to[v];
		const std::array<std::uint32_t, 3> second = {t[1], t[2], t[0]}, third = {t[2], t[0], t[1]};
		t = std::min({t, second, third});
	}
	std::sort(faces.begin(), faces.end());
	return faces;
}

/// Every numbering tried.
bool isSame(const LabelledMesh& a, const LabelledMesh& b)
{
	std::vector<std::uint32_t> to(a.labels.size());
	std::iota(to.begin(), to.end(), 0u);
	const auto faces = renumbered(b, to);
	do {
		bool keeps = true;
		for (std::size_t v = 0; v < to.size(); ++v)
			keeps = keeps && a.labels[v] == b.labels[to[v]];
		if (keeps && renumbered(a, to) == faces)
			return true;
	} while (std::next_permutation(to.begin(), to.end()));
	return false;
}

} // namespace

TEST(AnyIsomorphism, IsTheVerdictOfTryingEveryNumbering)
{
	Rng rng(5);
	int same = 0, different = 0;
	for (int i = 0; i < 3000; ++i) {
		const std::uint32_t vertices = 2 + rng.below(4), faces = rng.below(7);
		const MeshData a = makeAnyFaces(vertices, faces, 1 + rng.below(2), rng);
		MeshData b       = shuffled(a, rng.below(1u << 30));
		if (faces > 0 && i % 3 > 0)
			b.triangles[rng.below(faces)][rng.below(3)] = rng.below(vertices);
		const bool truth = isSame(labelled(a), labelled(b));
		ASSERT_EQ(whatDiffersInAnyMesh(labelled(a), labelled(b)).empty(), truth) << i;
		++(truth ? same : different);
	}
	EXPECT_GT(same, 1000);
	EXPECT_GT(different, 1000);
}

TEST(AnyIsomorphism, AcceptsEveryFamilyShuffledWithAndWithoutItsPlaces)
{
	for (const NamedMesh& m : allFamilies()) {
		EXPECT_EQ(whatDiffersInAnyMesh(unlabelled(m.mesh), unlabelled(shuffled(m.mesh, 3))), "")
		    << m.name;
		EXPECT_EQ(whatDiffersInAnyMesh(labelled(m.mesh), labelled(shuffled(m.mesh, 3))), "")
		    << m.name;
	}
}

/// Four times the mesh, compared with itself in another order, takes four times the steps.
void expectStepsInProportion(const MeshData& mesh, const MeshData& fourTimes)
{
	std::uint64_t before = 0;
	for (const MeshData* each : {&mesh, &fourTimes}) {
		std::uint64_t steps = 0;
		ASSERT_EQ(
		    whatDiffersInAnyMesh(unlabelled(*each), unlabelled(shuffled(*each, 1)), &steps), "");
		EXPECT_LT(steps, 250u * each->triangles.size());
		EXPECT_TRUE(before == 0 || steps < 5 * before) << before << " " << steps;
		before = steps;
	}
}

TEST(AnyIsomorphism, OfABookOfManyPagesTakesStepsInProportion)
{
	const MeshData mesh = makePages(16000, 3);
	expectStepsInProportion(makePages(4000, 3), mesh);
	MeshData other = mesh; // one page begins at its other side
	std::swap(other.triangles.back()[0], other.triangles.back()[1]);
	std::uint64_t steps = 0;
	EXPECT_NE(whatDiffersInAnyMesh(unlabelled(mesh), unlabelled(other), &steps), "");
	EXPECT_LT(steps, 250u * mesh.triangles.size());
}

TEST(AnyIsomorphism, OfManyConesAtOneApexTakesStepsInProportion)
{
	expectStepsInProportion(makeCones(1000, 4), makeCones(4000, 4));
	// As many faces and vertices, and all corners alike.
	const MeshData twoOfSix = makeCones(2, 6), threeOfFour = makeCones(3, 4);
	EXPECT_NE(whatDiffersInAnyMesh(unlabelled(twoOfSix), unlabelled(threeOfFour)), "");
}

TEST(AnyIsomorphism, FindsWhichPartsBelongTogetherThoughAllLookAlike)
{
	const MeshData t0 = makeTurnedTorus(0), t1 = makeTurnedTorus(1), t2 = makeTurnedTorus(2);
	const MeshData some = joined({t0, t1, t2, t1}), turned = joined({t1, t2, t1, t0});
	EXPECT_EQ(whatDiffersInAnyMesh(unlabelled(some), unlabelled(shuffled(turned, 1))), "");
	EXPECT_NE(whatDiffersInAnyMesh(unlabelled(some), unlabelled(joined({t0, t1, t2, t2}))), "");
	const MeshData hung = joinedAtAVertex({t0, t1, t2, t1});
	EXPECT_EQ(
	    whatDiffersInAnyMesh(
	        unlabelled(hung), unlabelled(shuffled(joinedAtAVertex({t1, t2, t1, t0}), 1))),
	    "");
	EXPECT_NE(
	    whatDiffersInAnyMesh(unlabelled(hung), unlabelled(joinedAtAVertex({t0, t1, t2, t2}))), "");
}

TEST(AnyIsomorphism, CountsFacesThatAreThereSeveralTimes)
{
	MeshData a = makeTwoTriangles(), b = a;
	a.triangles.push_back(a.triangles[0]);
	b.triangles.push_back(b.triangles[1]);
	EXPECT_EQ(whatDiffersInAnyMesh(unlabelled(a), unlabelled(b)), ""); // one is as the other
	a.positions[a.triangles[0][0]] = {9, 9, 9};
	b.positions[b.triangles[0][0]] = {9, 9, 9};
	EXPECT_NE(whatDiffersInAnyMesh(labelled(a), labelled(b)), "");
}

} // namespace wavemesh::test
