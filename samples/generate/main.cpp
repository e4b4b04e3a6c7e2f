// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the sample meshes, as binary PLY in single precision, into the folder given; or, with
// numbers of vertices after the folder, a bumpy sphere of each size, to measure with.
#include "die.h"
#include "mesh_check.h"
#include "mesh_families.h"
#include "shapes.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

namespace {

using wavemesh::MeshData;
using Colours = std::vector<std::array<std::uint8_t, 4>>;

template <class T>
void put(std::string& out, T value)
{
	out.append(reinterpret_cast<const char*>(&value), sizeof value); // little-endian machines only
}

/// With the texture coordinates of corners, if the mesh has an attribute: it is these then.
std::string asPly(const MeshData& mesh, const Colours& colours)
{
	const bool textured = !mesh.attributes.empty();
	std::string out     = "ply\nformat binary_little_endian 1.0\ncomment Wavemesh sample\n";
	if (textured)
		out += "comment TextureFile " + mesh.textures.front() + "\n";
	out += "element vertex " + std::to_string(mesh.positions.size()) +
	       "\nproperty float x\nproperty float y\nproperty float z\n";
	if (!colours.empty())
		out +=
		    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
	out += "element face " + std::to_string(mesh.triangles.size()) +
	       "\nproperty list uchar int vertex_indices\n";
	if (textured)
		out += "property list uchar float texcoord\n";
	out += "end_header\n";
	for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
		for (double x : mesh.positions[v])
			put(out, static_cast<float>(x));
		if (!colours.empty())
			for (std::uint8_t c : colours[v])
				put(out, c);
	}
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
		put(out, std::uint8_t {3});
		for (std::uint32_t v : mesh.triangles[f])
			put(out, static_cast<std::int32_t>(v));
		if (!textured)
			continue;
		put(out, std::uint8_t {6});
		for (std::size_t k = 0; k < 9; ++k)
			if (k % 3 < 2)
				put(out, static_cast<float>(mesh.attributes.front().values[9 * f + k]));
	}
	return out;
}

/// Beyond being manifold, no sample has a face without area.
std::string whatIsWrong(const MeshData& mesh)
{
	for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
		const auto& t = mesh.triangles[f];
		double n      = 0;
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
			const auto &a = mesh.positions[t[0]], &b = mesh.positions[t[1]],
			           &c  = mesh.positions[t[2]];
			const double x = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
			n += x * x;
		}
		if (!(std::sqrt(n) > 1e-9))
			return "face " + std::to_string(f) + " has no area";
	}
	return {};
}

bool writeFile(const std::string& path, const std::string& bytes)
{
	std::ofstream file(path, std::ios::binary);
	file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
	if (file.flush())
		return true;
	std::fprintf(stderr, "%s: cannot be written\n", path.c_str());
	return false;
}

bool write(
    const std::string& folder,
    const char* name,
    const MeshData& mesh,
    const Colours& colours = {},
    bool wantArea          = true)
{
	wavemesh::test::Topology t;
	std::string wrong = wavemesh::test::whatIsNotManifold(mesh, &t);
	if (wrong.empty() && wantArea)
		wrong = whatIsWrong(mesh);
	if (!wrong.empty()) {
		std::fprintf(stderr, "%s: %s\n", name, wrong.c_str());
		return false;
	}
	if (!writeFile(folder + "/" + name, asPly(mesh, colours)))
		return false;
	std::printf(
	    "%-12s %5zu vertices %6zu faces, %u components, %u boundary loops, genus %lld\n", name,
	    mesh.positions.size(), mesh.triangles.size(), t.components, t.boundaryLoops,
	    static_cast<long long>(t.genus));
	return true;
}

int writeSpheres(const std::string& folder, char** numbers, int count)
{
	for (int i = 0; i < count; ++i) {
		const auto n           = static_cast<std::uint32_t>(std::strtoul(numbers[i], nullptr, 10));
		const std::string name = "sphere_" + std::to_string(n) + ".ply";
		// Faces without area are welcome here.
		if (!write(folder, name.c_str(), wavemesh::test::makeBumpySphere(n, 1), {}, false))
			return 1;
	}
	return 0;
}

} // namespace

int main(int argc, char** argv)
{
	using namespace wavemesh::samples;
	if (argc < 2) {
		std::fprintf(stderr, "usage: generate_samples FOLDER [VERTICES ...]\n");
		return 2;
	}
	const std::string folder = argv[1];
	if (argc > 2)
		return writeSpheres(folder, argv + 2, argc - 2);
	const MeshData vase = makeVase();
	bool ok             = write(folder, "blob.ply", makeBlob());
	ok                  = write(folder, "bracket.ply", makeBracket()) && ok;
	ok                  = write(folder, "die.ply", makeDie()) && ok;
	ok                  = writeFile(folder + "/die.png", asPng(dieTexture())) && ok;
	ok                  = write(folder, "island.ply", makeIsland()) && ok;
	ok                  = write(folder, "pebble.ply", makePebble()) && ok;
	ok                  = write(folder, "pieces.ply", makePieces()) && ok;
	ok                  = write(folder, "pretzel.ply", makePretzel()) && ok;
	ok                  = write(folder, "vase.ply", vase, vaseColours(vase)) && ok;
	return ok ? 0 : 1;
}
