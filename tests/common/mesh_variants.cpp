// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes made from other meshes, and the list of all.
#include "mesh_edit.h"
#include "mesh_families.h"

#include <numeric>
#include <utility>

namespace wavemesh::test {

MeshData punch(const MeshData& mesh, int holes, std::uint64_t seed)
{
	Rng rng(seed);
	std::vector<bool> rim(mesh.positions.size(), false);
	std::vector<bool> gone(mesh.triangles.size(), false);
	std::vector<std::uint32_t> order(mesh.triangles.size());
	std::iota(order.begin(), order.end(), 0u);
	for (std::size_t i = order.size(); i > 1; --i)
		std::swap(order[i - 1], order[rng.below(static_cast<std::uint32_t>(i))]);
	// A vertex next to no other hole keeps one fan of faces; so does the mesh's own boundary.
	const MeshEdit edit(mesh);
	for (std::uint32_t h = 0; h < edit.halfEdges(); ++h)
		if (edit.twin(h) == MeshEdit::kNone)
			rim[edit.from(h)] = rim[edit.to(h)] = true;
	for (std::uint32_t f : order) {
		const auto& t = mesh.triangles[f];
		if (holes == 0)
			break;
		if (rim[t[0]] || rim[t[1]] || rim[t[2]])
			continue;
		rim[t[0]] = rim[t[1]] = rim[t[2]] = gone[f] = true;
		--holes;
	}
	MeshData out {mesh.positions, {}};
	for (std::size_t f = 0; f < gone.size(); ++f)
		if (!gone[f])
			out.triangles.push_back(mesh.triangles[f]);
	return out;
}

MeshData joined(const std::vector<MeshData>& parts)
{
	MeshData out;
	for (const MeshData& part : parts) {
		const auto first = static_cast<std::uint32_t>(out.positions.size());
		out.positions.insert(out.positions.end(), part.positions.begin(), part.positions.end());
		for (const auto& t : part.triangles)
			out.triangles.push_back({first + t[0], first + t[1], first + t[2]});
	}
	return out;
}

MeshData moved(MeshData mesh, double x, double y, double z)
{
	for (auto& p : mesh.positions)
		p = {p[0] + x, p[1] + y, p[2] + z};
	return mesh;
}

MeshData scaled(MeshData mesh, double x, double y, double z)
{
	for (auto& p : mesh.positions)
		p = {p[0] * x, p[1] * y, p[2] * z};
	return mesh;
}

MeshData shuffled(const MeshData& mesh, std::uint64_t seed)
{
	Rng rng(seed);
	const auto n = static_cast<std::uint32_t>(mesh.positions.size());
	std::vector<std::uint32_t> place(n);
	std::iota(place.begin(), place.end(), 0u);
	for (std::uint32_t i = n; i > 1; --i)
		std::swap(place[i - 1], place[rng.below(i)]);
	MeshData out = mesh;
	for (std::uint32_t v = 0; v < n; ++v)
		out.positions[place[v]] = mesh.positions[v];
	for (auto& t : out.triangles) {
		const auto k   = static_cast<std::size_t>(rng.below(3));
		const auto old = t;
		for (std::size_t i = 0; i < 3; ++i)
			t[i] = place[old[(i + k) % 3]];
	}
	for (auto i = static_cast<std::uint32_t>(out.triangles.size()); i > 1; --i)
		std::swap(out.triangles[i - 1], out.triangles[rng.below(i)]);
	return out;
}

MeshData jittered(MeshData mesh, double amount, std::uint64_t seed)
{
	Rng rng(seed);
	for (auto& p : mesh.positions)
		for (double& x : p)
			x += static_cast<double>(
			         static_cast<std::int64_t>(rng.between(-amount, amount) * 1048576.0)) /
			     1048576.0;
	return mesh;
}

MeshData makeFlippedSphere(std::uint32_t vertices, std::uint64_t seed)
{
	Rng rng(seed);
	const MeshData m = makeBumpySphere(vertices, seed + 1);
	return flipRandomEdges(m, static_cast<std::uint32_t>(4 * m.positions.size()), rng);
}

MeshData makeCollapsedSphere(std::uint32_t vertices, std::uint64_t seed)
{
	Rng rng(seed);
	const MeshData m = makeBumpySphere(2 * vertices, seed + 1);
	return collapseRandomEdges(m, static_cast<std::uint32_t>(m.positions.size() - vertices), rng);
}

namespace {

void addClosed(std::vector<NamedMesh>& all)
{
	all.push_back({"tetrahedron", makeTetrahedron()});
	all.push_back({"octahedron", makeOctahedron()});
	all.push_back({"cube", makeCube()});
	all.push_back({"icosahedron", makeIcosahedron()});
	all.push_back({"icosphere_4", makeIcosphere(4)});
	all.push_back({"icosphere_8", makeIcosphere(8)});
	all.push_back({"icosphere_15", makeIcosphere(15)});
	all.push_back({"bumpy_sphere", makeBumpySphere(1500, 11)});
	for (int n : {3, 5, 6, 7, 12, 100, 1000})
		all.push_back({"bipyramid_" + std::to_string(n), makeBipyramid(n)});
	all.push_back({"double_cone", makeDoubleCone(40, 12)});
	all.push_back({"kleetope_icosahedron", makeKleetope(makeIcosahedron())});
	all.push_back({"kleetope_twice", makeKleetope(makeKleetope(makeIcosphere(4)), 0.02)});
	all.push_back({"star_prism", makeStarPrism(9, 1)});
	all.push_back({"star_prism_layers", makeStarPrism(16, 20)});
	all.push_back({"flipped_sphere", makeFlippedSphere(1000, 3)});
	all.push_back({"flipped_sphere_small", makeFlippedSphere(40, 5)});
	all.push_back({"collapsed_sphere", makeCollapsedSphere(1000, 7)});
	all.push_back({"collapsed_sphere_small", makeCollapsedSphere(40, 9)});
	all.push_back({"torus_3_3", makeTorus(3, 3)});
	all.push_back({"torus_3_7", makeTorus(3, 7)});
	all.push_back({"torus_40_20", makeTorus(40, 20)});
	for (int genus : {0, 1, 2, 5})
		all.push_back({"holed_plate_genus_" + std::to_string(genus), makeHoledPlate(genus, 1)});
	all.push_back({"holed_plate_fine", makeHoledPlate(3, 6)});
}

void addOpen(std::vector<NamedMesh>& all)
{
	all.push_back({"triangle", makeTriangle()});
	all.push_back({"two_triangles", makeTwoTriangles()});
	for (int n : {3, 4, 7, 50})
		all.push_back({"strip_" + std::to_string(n), makeStrip(n)});
	for (int n : {3, 4, 5, 30})
		all.push_back({"annulus_" + std::to_string(n), makeAnnulus(n)});
	for (int n : {3, 4, 6, 9, 200})
		all.push_back({"fan_" + std::to_string(n), makeFan(n)});
	all.push_back({"cylinder", makeCylinder(24, 30)});
	all.push_back({"cylinder_thin", makeCylinder(3, 40)});
	all.push_back({"grid_2_2", makeGrid(2, 2)});
	all.push_back({"grid_3_3", makeGrid(3, 3)});
	all.push_back({"grid_33_33", makeGrid(33, 33)});
	all.push_back({"grid_40_17", makeGrid(40, 17)});
	all.push_back({"flat_grid", makeFlatGrid(25, 30)});
	all.push_back({"terrain_small", makeTerrain(50, 1)});
	all.push_back({"terrain", makeTerrain(1500, 2)});
	all.push_back({"punched_sphere", punch(makeIcosphere(10), 40, 4)});
	all.push_back({"punched_terrain", punch(makeTerrain(800, 6), 25, 8)});
	all.push_back({"punched_torus", punch(makeTorus(20, 12), 1000, 10)});
	all.push_back({"punched_flipped", punch(makeFlippedSphere(600, 12), 1000, 13)});
}

/// Several components, coincident points, odd scales.
void addCombined(std::vector<NamedMesh>& all)
{
	all.push_back(
	    {"components",
	     joined(
	         {makeTetrahedron(), moved(makeTorus(12, 8), 3, 0, 0), moved(makeGrid(9, 9), 0, 3, 0),
	          moved(makeTriangle(), 0, 0, 3), moved(makeBumpySphere(300, 21), 3, 3, 0),
	          moved(makeStrip(5), 3, 0, 3)})});
	std::vector<MeshData> triangles;
	for (int i = 0; i < 200; ++i)
		triangles.push_back(moved(makeTriangle(), i % 15, i / 15, 0.25 * (i % 7)));
	all.push_back({"many_triangles", joined(triangles)});
	std::vector<MeshData> tetrahedra(50, makeTetrahedron());
	for (std::size_t i = 0; i < tetrahedra.size(); ++i)
		tetrahedra[i] = moved(tetrahedra[i], 4 * static_cast<double>(i), 0, 0);
	all.push_back({"many_tetrahedra", joined(tetrahedra)});
	all.push_back({"same_place_twice", joined({makeIcosphere(5), makeIcosphere(5)})});
	all.push_back({"all_in_one_point", scaled(makeIcosphere(3), 0, 0, 0)});
	all.push_back({"all_on_one_line", scaled(makeBumpySphere(200, 31), 1, 0, 0)});
	all.push_back({"flat_sphere", scaled(makeFlippedSphere(200, 33), 1, 1, 0)});
	all.push_back({"far_away", moved(makeBumpySphere(400, 35), 100000, -200000, 300000)});
	all.push_back(
	    {"tiny", scaled(makeTorus(16, 10), 1.0 / (1 << 30), 1.0 / (1 << 30), 1.0 / (1 << 30))});
	all.push_back({"huge", scaled(makeTorus(16, 10), 1 << 30, 1 << 30, 1 << 30)});
	all.push_back({"stretched", scaled(makeBumpySphere(400, 37), 1, 64, 1.0 / 256)});
	all.push_back({"noisy_sphere", jittered(makeIcosphere(8), 0.3, 39)});
	all.push_back({"shuffled_torus", shuffled(makeTorus(30, 15), 41)});
}

} // namespace

std::vector<NamedMesh> allFamilies()
{
	std::vector<NamedMesh> all;
	addClosed(all);
	addOpen(all);
	addCombined(all);
	return all;
}

std::vector<NamedMesh> smallFamilies(std::size_t maxVertices)
{
	std::vector<NamedMesh> small;
	for (NamedMesh& m : allFamilies())
		if (m.mesh.positions.size() <= maxVertices)
			small.push_back(std::move(m));
	return small;
}

} // namespace wavemesh::test
