// SPDX-License-Identifier: GPL-3.0-or-later
#include "sample_sizes.h"

#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace wavemesh::test {

const std::vector<std::string> kSamples {"blob",   "bracket", "die",     "island",
                                         "pebble", "pieces",  "pretzel", "vase"};

const std::vector<Configuration> kConfigurations {
    {"I", Mode::Classic, kLiftingOff, Wgc::Off, Optimize::Size, 2},
    {"II", Mode::Classic, 0, Wgc::Off, Optimize::Size, 2},
    {"III", Mode::Classic, 0, Wgc::On, Optimize::Size, 2},
    {"compact_2", Mode::Compact, 0, Wgc::Auto, Optimize::Balanced, 2},
    {"compact_3", Mode::Compact, 0, Wgc::Auto, Optimize::Balanced, 3},
    {"size_3", Mode::Compact, 0, Wgc::Auto, Optimize::Size, 3}};

namespace {

template <class T>
T take(std::istream& in)
{
	T x {};
	in.read(reinterpret_cast<char*>(&x), sizeof x); // little-endian, as the file
	return x;
}

struct PlyHeader
{
	std::size_t vertices = 0, faces = 0;
	std::size_t behindPosition = 0; ///< bytes of a vertex after its coordinates
	std::size_t listsOfFace    = 0; ///< of numbers of four bytes
};

PlyHeader readHeader(std::istream& in)
{
	PlyHeader h;
	bool ofVertex = false;
	for (std::string line; std::getline(in, line) && line != "end_header";) {
		std::istringstream words(line);
		std::string key, type, name;
		words >> key >> type >> name;
		if (key == "element") {
			ofVertex                          = type == "vertex";
			(ofVertex ? h.vertices : h.faces) = std::stoul(name);
		}
		else if (key == "property" && ofVertex && name != "x" && name != "y" && name != "z")
			h.behindPosition += type == "uchar" ? 1 : 4;
		else if (key == "property" && type == "list")
			++h.listsOfFace;
	}
	return h;
}

} // namespace

MeshData readSamplePly(const std::string& path)
{
	std::ifstream in(path, std::ios::binary);
	if (!in)
		throw std::runtime_error("cannot read " + path);
	const PlyHeader h = readHeader(in);
	MeshData m;
	for (std::size_t v = 0; v < h.vertices; ++v) {
		m.positions.emplace_back();
		for (double& x : m.positions.back())
			x = double(take<float>(in));
		in.ignore(static_cast<std::streamsize>(h.behindPosition));
	}
	for (std::size_t f = 0; f < h.faces; ++f) {
		if (take<std::uint8_t>(in) != 3)
			throw std::runtime_error(path + " is not made of triangles");
		m.triangles.emplace_back();
		for (std::uint32_t& v : m.triangles.back())
			v = static_cast<std::uint32_t>(take<std::int32_t>(in));
		for (std::size_t list = 1; list < h.listsOfFace; ++list)
			in.ignore(4 * take<std::uint8_t>(in));
	}
	if (!in)
		throw std::runtime_error(path + " ends early");
	return m;
}

EncodedMesh encodeSample(const MeshData& mesh, const Configuration& configuration)
{
	EncodeOptions o;
	o.bits     = 12;
	o.lifting  = configuration.lifting;
	o.wgc      = configuration.wgc;
	o.mode     = configuration.mode;
	o.optimize = configuration.optimize;
	o.effort   = configuration.effort;
	return encode(mesh, o).value();
}

} // namespace wavemesh::test
