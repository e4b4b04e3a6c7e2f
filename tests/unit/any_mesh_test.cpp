// SPDX-License-Identifier: GPL-3.0-or-later
// Any triangles in, the same triangles out.
#include "any_isomorphism.h"
#include "codec_check.h"
#include "mesh_build.h"
#include "mesh_families.h"
#include "rng.h"

#include "mesh/manifold_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace wavemesh::test {
namespace {

std::string
whatIsLostOfAny(const MeshData& original, const MeshData& decoded, const StreamInfo& info)
{
	return tool::whatDiffersInAnyMesh(
	    {latticeOf(original, info), original.triangles},
	    {latticeOf(decoded, info), decoded.triangles});
}

/// Every level but the restored one must be a manifold, with the copies of one vertex in one place:
/// no gap along a cut.
std::string whatIsWrongWithLevel(const MeshData& mesh)
{
	return mesh.triangles.empty() ? std::string() : whatIsNotManifold(mesh);
}

std::string whatFails(const MeshData& mesh, const EncodeOptions& options = {})
{
	const auto file = encode(mesh, options);
	if (!file.ok())
		return "encode: " + file.status().what;
	if (file->info.bytes != file->bytes.size())
		return "the info has another file size";
	if (file->info.vertices != mesh.positions.size() || file->info.faces != mesh.triangles.size())
		return "the info has other counts";
	const auto levels = levelsOf(file->bytes);
	if (levels.size() != file->info.levels.size())
		return "not all levels came: " + levels.back().status.what;
	for (std::size_t j = 0; j < levels.size(); ++j) {
		if (!levels[j].status.ok())
			return "level " + std::to_string(j) + ": " + levels[j].status.what;
		if (j + 1 < levels.size() || !file->info.features.restored)
			if (std::string s = whatIsWrongWithLevel(levels[j].mesh); !s.empty())
				return "level " + std::to_string(j) + ": " + s;
	}
	return whatIsLostOfAny(mesh, levels.back().mesh, file->info);
}

MeshData turnedOver(MeshData mesh, std::size_t every)
{
	for (std::size_t f = 0; f < mesh.triangles.size(); f += every)
		std::swap(mesh.triangles[f][0], mesh.triangles[f][1]);
	return mesh;
}

/// Merges vertices at the same place.
MeshData welded(const MeshData& mesh)
{
	MeshData out;
	std::map<std::array<double, 3>, std::uint32_t> rows;
	std::vector<std::uint32_t> to;
	for (const auto& p : mesh.positions) {
		const auto [at, fresh] = rows.emplace(p, std::uint32_t(out.positions.size()));
		if (fresh)
			out.positions.push_back(p);
		to.push_back(at->second);
	}
	for (const auto& t : mesh.triangles)
		out.triangles.push_back({to[t[0]], to[t[1]], to[t[2]]});
	return out;
}

/// n x m quads around a strip with half a twist.
MeshData makeMoebius(int n, int m)
{
	MeshData mesh;
	for (int i = 0; i < n; ++i)
		for (int k = 0; k <= m; ++k) {
			const double a = 6.283185307179586 * i / n, w = double(k) / m - 0.5;
			const double r = 2 + w * std::cos(a / 2);
			addVertex(mesh, r * std::cos(a), r * std::sin(a), w * std::sin(a / 2));
		}
	const auto at = [&](int i, int k) {
		return std::uint32_t(i < n ? i * (m + 1) + k : (i - n) * (m + 1) + m - k);
	};
	for (int i = 0; i < n; ++i)
		for (int k = 0; k < m; ++k)
			addQuad(mesh, at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
	return mesh;
}

/// Sheets that meet along one line of n edges, each n x m.
MeshData makeBook(int pages, int n, int m)
{
	std::vector<MeshData> parts;
	for (int page = 0; page < pages; ++page) {
		MeshData sheet;
		for (int i = 0; i <= n; ++i)
			for (int k = 0; k <= m; ++k)
				addVertex(
				    sheet, k == 0 ? 0 : k * std::cos(page * 1.1),
				    k == 0 ? 0 : k * std::sin(page * 1.1), i);
		const auto at = [&](int i, int k) { return std::uint32_t(i * (m + 1) + k); };
		for (int i = 0; i < n; ++i)
			for (int k = 0; k < m; ++k)
				addQuad(sheet, at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k));
		parts.push_back(std::move(sheet));
	}
	return welded(joined(parts));
}

MeshData makeSoup(std::uint32_t vertices, std::uint32_t faces, std::uint64_t seed)
{
	Rng rng(seed);
	MeshData mesh;
	for (std::uint32_t v = 0; v < vertices; ++v)
		addVertex(mesh, rng.below(500), rng.below(500), rng.below(500));
	for (std::uint32_t f = 0; f < faces; ++f)
		addFace(mesh, rng.below(vertices), rng.below(vertices), rng.below(vertices));
	return mesh;
}

/// A mesh with a few faces torn out, added, doubled, turned, made degenerate.
MeshData damaged(MeshData mesh, std::uint64_t seed)
{
	Rng rng(seed);
	const auto vertices = std::uint32_t(mesh.positions.size());
	for (int i = 0; i < 12; ++i) {
		const std::uint32_t f = rng.below(std::uint32_t(mesh.triangles.size()));
		const auto t          = mesh.triangles[f];
		switch (rng.below(7)) {
		case 0:
			if (mesh.triangles.size() > 1)
				mesh.triangles.erase(mesh.triangles.begin() + f);
			break;
		case 1:
			mesh.triangles.push_back(t);
			break;
		case 2:
			mesh.triangles.push_back({t[1], t[0], t[2]});
			break;
		case 3:
			std::swap(mesh.triangles[f][0], mesh.triangles[f][1]);
			break;
		case 4:
			mesh.triangles[f][1] = t[0];
			break;
		case 5:
			addFace(mesh, t[0], t[1], rng.below(vertices));
			break;
		case 6:
			addVertex(mesh, rng.below(9), 0.1 * i, 1);
			break;
		}
	}
	return mesh;
}

TEST(AnyMesh, CutLeavesAManifoldAsItIs)
{
	for (const NamedMesh& family : allFamilies()) {
		const auto cut = cutToManifold(family.mesh.triangles, Index(family.mesh.positions.size()));
		ASSERT_TRUE(cut.ok());
		EXPECT_FALSE(cut->changed()) << family.name;
		for (Index c = 0; c < cut->table.cornerCount(); ++c)
			ASSERT_EQ(cut->table.vertex[c], family.mesh.triangles[c / 3][c % 3]);
	}
}

TEST(AnyMesh, CutRefusesAVertexThatDoesNotExist)
{
	EXPECT_EQ(cutToManifold({{0, 0, 1}, {0, 1, 7}}, 3).status().code, StatusCode::InvalidArgument);
}

TEST(AnyMesh, NothingAtAllComesBack)
{
	EXPECT_EQ(whatFails({}), "");
}

TEST(AnyMesh, PointCloudsComeBack)
{
	for (std::uint32_t n : {1u, 2u, 3u, 100u, 5000u}) {
		const MeshData mesh = makeSoup(n, 0, n);
		EXPECT_EQ(whatFails(mesh), "") << n;
	}
	MeshData same = makeSoup(1, 0, 1);
	same.positions.resize(40, same.positions[0]);
	EXPECT_EQ(whatFails(same), "");
}

TEST(AnyMesh, IsolatedVerticesComeBack)
{
	MeshData mesh = makeIcosphere(4);
	for (int i = 0; i < 30; ++i)
		mesh.positions.insert(
		    mesh.positions.begin() + i, {0.01 * i, 0.5, -2.0}); // shifts the others
	for (auto& t : mesh.triangles)
		for (auto& v : t)
			v += 30;
	EXPECT_EQ(whatFails(mesh), "");
}

TEST(AnyMesh, DegenerateFacesComeBack)
{
	MeshData mesh = makeIcosphere(3);
	for (std::uint32_t i = 0; i < 20; ++i)
		addFace(mesh, i, i, i % 7 == 0 ? i : i + 1);
	addFace(mesh, 3, 9, 3);
	addFace(mesh, 9, 3, 3);
	addVertex(mesh, 1, 2, 3);
	addFace(mesh, 9, std::uint32_t(mesh.positions.size() - 1), 9);
	EXPECT_EQ(whatFails(mesh), "");
	MeshData only;
	addVertex(only, 1, 2, 3);
	addVertex(only, 2, 2, 3);
	addFace(only, 0, 0, 1);
	addFace(only, 1, 1, 1);
	EXPECT_EQ(whatFails(only), "");
}

TEST(AnyMesh, FacesThatAreThereSeveralTimesComeBackAsOften)
{
	MeshData mesh = makeGrid(7, 5);
	for (std::uint32_t i = 0; i < 9; ++i)
		mesh.triangles.push_back(mesh.triangles[i % 4]);
	mesh.triangles.push_back({mesh.triangles[2][1], mesh.triangles[2][0], mesh.triangles[2][2]});
	EXPECT_EQ(whatFails(mesh), "");
}

TEST(AnyMesh, BothSidesOfASurfaceComeBackForAlmostNothing)
{
	const MeshData once = makeBumpySphere(600, 3);
	MeshData twice      = once;
	for (const auto& t : once.triangles)
		twice.triangles.push_back({t[0], t[2], t[1]});
	EXPECT_EQ(whatFails(twice), "");
	EXPECT_LT(encode(twice)->bytes.size(), encode(once)->bytes.size() + 40);
}

TEST(AnyMesh, FacesThatAreTurnedOverComeBackTurnedOver)
{
	EXPECT_EQ(whatFails(turnedOver(makeBumpySphere(300, 4), 3)), "");
	EXPECT_EQ(whatFails(turnedOver(makeTorus(12, 9), 2)), "");
	const MeshData mesh = makeTorus(30, 20);
	MeshData half       = mesh;
	for (std::size_t f = 0; f < half.triangles.size() / 3; ++f)
		std::swap(half.triangles[f][0], half.triangles[f][1]);
	EXPECT_EQ(whatFails(half), "");
	// A region costs its border only, and nothing is opened.
	EXPECT_LT(encode(half)->bytes.size(), encode(mesh)->bytes.size() + 80);
	const auto cut = cutToManifold(half.triangles, Index(half.positions.size()));
	EXPECT_TRUE(cut->group.empty());
}

TEST(AnyMesh, NonOrientableSurfacesComeBack)
{
	EXPECT_EQ(whatFails(makeMoebius(40, 6)), "");
	EXPECT_EQ(whatFails(turnedOver(makeMoebius(17, 3), 2)), "");
	// The projective plane with six vertices.
	MeshData plane  = makeSoup(6, 0, 5);
	plane.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
	                   {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
	EXPECT_EQ(whatFails(plane), "");
}

TEST(AnyMesh, SheetsThatMeetAtALineComeBack)
{
	for (int pages : {3, 4, 5, 8})
		EXPECT_EQ(whatFails(makeBook(pages, 20, 9)), "") << pages;
}

TEST(AnyMesh, SolidsThatTouchAtAnEdgeOrAVertexComeBack)
{
	const MeshData cube = makeCube();
	double size         = 0;
	for (const auto& p : cube.positions)
		size = std::max(size, 2 * p[0]);
	EXPECT_EQ(whatFails(welded(joined({cube, moved(cube, size, size, 0)}))), "");
	EXPECT_EQ(whatFails(welded(joined({cube, moved(cube, size, size, size)}))), "");
	EXPECT_EQ(whatFails(welded(joined({cube, moved(cube, size, 0, 0)}))), "");
	MeshData fans; // many cones with the same apex
	addVertex(fans, 0, 0, 0);
	for (int i = 0; i < 60; ++i) {
		const auto v = addVertex(fans, i, 1, 0);
		addVertex(fans, i, 1, 1);
		addFace(fans, 0, v, v + 1);
	}
	EXPECT_EQ(whatFails(fans), "");
}

TEST(AnyMesh, AnEmptyMeshAndOneOfPointsOnlyComeBack)
{
	EXPECT_EQ(whatFails(MeshData {}), "");
	EXPECT_EQ(whatFails(makeSoup(1, 0, 1)), "");
	EXPECT_EQ(whatFails(makeSoup(1000, 0, 1)), "");
}

TEST(AnyMesh, SingleTrianglesComeBack)
{
	MeshData mesh;
	for (std::uint32_t i = 0; i < 3000; ++i) {
		addVertex(mesh, i % 50, i / 50, 0);
		addVertex(mesh, i % 50 + 0.7, i / 50, 0.3);
		addVertex(mesh, i % 50, i / 50 + 0.7, 0.1);
		addFace(mesh, 3 * i, 3 * i + 1, 3 * i + 2);
	}
	EXPECT_EQ(whatFails(mesh), "");
}

TEST(AnyMesh, AHubOfManyFacesComesBack)
{
	// Corner by corner around the hub, for each of its faces, this would not end.
	constexpr std::uint32_t kSpokes = 400'000;
	MeshData fan;
	addVertex(fan, 0, 0, 1);
	for (std::uint32_t i = 0; i < kSpokes; ++i)
		addVertex(fan, std::cos(kTau * i / kSpokes), std::sin(kTau * i / kSpokes), i % 7);
	for (std::uint32_t i = 0; i < kSpokes; ++i)
		addFace(fan, 0, 1 + i, 1 + (i + 1) % kSpokes);
	EncodeOptions o;
	o.effort        = 1;
	const auto file = encode(fan, o);
	ASSERT_TRUE(file.ok());
	const auto back = decode(file->bytes.data(), file->bytes.size());
	ASSERT_TRUE(back.ok()) << back.status().what;
	EXPECT_EQ(back->mesh.triangles.size(), kSpokes);
}

TEST(AnyMesh, CopiesOfAVertexStayTogetherInEveryLevel)
{
	const MeshData mesh = makeBook(4, 40, 12);
	for (int lifting : {kLiftingOff, 0, 1, 2, 3}) {
		EncodeOptions o;
		o.mode          = lifting == 3 ? Mode::Compact : Mode::Classic;
		o.lifting       = std::min(lifting, 2);
		const auto file = encode(mesh, o);
		ASSERT_EQ(whatFails(mesh, o), "");
		const auto levels = levelsOf(file->bytes);
		ASSERT_GE(levels.size(), 3u);
		// The base holds every copy of the spine's vertices: its 41 places, four sheets in two
		// pairs.
		std::map<std::array<double, 3>, int> inBase;
		for (const auto& p : levels[0].mesh.positions)
			++inBase[p];
		int shared = 0;
		for (const auto& [p, count] : inBase)
			shared += count > 1 ? count : 0;
		EXPECT_GE(shared, 4 * 41) << lifting;
		if (o.mode == Mode::Classic) {
			EXPECT_EQ(shared, 4 * 41) << lifting;
		}
	}
}

TEST(AnyMesh, CopiesOfAVertexStayTogetherInEveryCompactLevel)
{
	const MeshData mesh = makeBook(4, 40, 12);
	EncodeOptions o;
	o.wgc     = Wgc::Off;
	o.mode    = Mode::Classic;
	o.lifting = kLiftingOff;
	// The base of both modes is numbered alike; classic tells which of its vertices are copies.
	const auto classic = levelsOf(encode(mesh, o)->bytes);
	o.mode             = Mode::Compact;
	const auto levels  = levelsOf(encode(mesh, o)->bytes);
	ASSERT_GE(levels.size(), 4u);
	const auto& base = classic[0].mesh.positions;
	std::map<std::array<double, 3>, std::size_t> firstAt;
	std::size_t copies = 0;
	for (std::size_t v = 0; v < base.size(); ++v) {
		const std::size_t first = firstAt.emplace(base[v], v).first->second;
		copies += first != v;
		// The finest level is the original again, in another numbering.
		for (std::size_t j = 0; j + 1 < levels.size(); ++j)
			ASSERT_EQ(levels[j].mesh.positions[v], levels[j].mesh.positions[first]) << j;
	}
	EXPECT_EQ(copies, 3 * 41u);
}

TEST(AnyMesh, AnyDamageToAnyFamilyComesBack)
{
	std::uint64_t seed = 1;
	for (const NamedMesh& family : smallFamilies(120))
		for (int i = 0; i < 6; ++i) {
			EncodeOptions o;
			o.mode    = seed % 2 ? Mode::Classic : Mode::Compact;
			o.lifting = int(seed % 4) - 1;
			o.bits    = 10 + int(seed % 5);
			ASSERT_EQ(whatFails(damaged(family.mesh, seed), o), "") << family.name << " " << seed;
			++seed;
		}
}

TEST(AnyMesh, RandomFacesComeBack)
{
	std::uint64_t seed = 1;
	for (std::uint32_t vertices : {2u, 3u, 4u, 5u, 7u, 12u, 40u, 300u})
		for (std::uint32_t faces : {1u, 2u, 5u, 20u, 90u, 400u})
			for (int i = 0; i < 4; ++i)
				ASSERT_EQ(whatFails(makeSoup(vertices, faces, ++seed)), "")
				    << vertices << " " << faces << " " << seed;
}

// What is missing after the levels must not change how they are shown.
TEST(AnyMesh, AnIsolatedVertexLeavesTheLevelsAsTheyAre)
{
	MeshData mesh = makeBumpySphere(900, 31);
	EncodeOptions o;
	o.bits            = 14;
	const auto closed = encode(mesh, o);
	mesh.positions.push_back(mesh.positions[0]);
	const auto isolated = encode(mesh, o);
	ASSERT_EQ(closed->info.finestLevel(), isolated->info.finestLevel());
	for (int level = 0; level < closed->info.finestLevel(); ++level) {
		DecodeOptions d;
		d.level      = level;
		const auto a = decode(closed->bytes.data(), closed->bytes.size(), d),
		           b = decode(isolated->bytes.data(), isolated->bytes.size(), d);
		ASSERT_EQ(a->mesh.positions, b->mesh.positions) << level;
	}
}

} // namespace
} // namespace wavemesh::test
