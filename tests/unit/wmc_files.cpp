// SPDX-License-Identifier: GPL-3.0-or-later
#include "wmc_files.h"

#include "container/byte_io.h"
#include "mesh_build.h"
#include "mesh_families.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace wavemesh::test {

ExactBuffer::ExactBuffer(const std::uint8_t* data, std::size_t size) :
        block_(new std::uint8_t[size]), size_(size)
{
	std::copy(data, data + size, block_.get());
}

std::vector<ChunkPlace> chunksOf(const Bytes& file)
{
	constexpr std::size_t kMagicSize = 8, kChecksumSize = 4;
	std::vector<ChunkPlace> chunks;
	for (std::size_t at = kMagicSize; at < file.size();) {
		ChunkPlace c;
		c.begin            = at;
		c.type             = file.at(at++);
		std::size_t length = 0;
		for (int shift = 0;; shift += 7) {
			const std::uint8_t b = file.at(at++);
			length |= static_cast<std::size_t>(b & 127) << shift;
			if (b < 128)
				break;
		}
		c.payload  = at;
		c.checksum = at + length;
		at = c.end = c.checksum + kChecksumSize;
		if (c.end > file.size())
			throw std::runtime_error("not a whole file");
		chunks.push_back(c);
	}
	return chunks;
}

void mendChecksum(Bytes& file, const ChunkPlace& chunk)
{
	const std::uint32_t sum = checksum(file.data() + chunk.begin, chunk.checksum - chunk.begin);
	for (std::size_t i = 0; i < 4; ++i)
		file[chunk.checksum + i] = static_cast<std::uint8_t>(sum >> (8 * i));
}

Bytes makeChunk(std::uint8_t type, const Bytes& payload)
{
	Bytes chunk {type};
	std::size_t n = payload.size();
	for (; n >= 128; n >>= 7)
		chunk.push_back(static_cast<std::uint8_t>(n | 128));
	chunk.push_back(static_cast<std::uint8_t>(n));
	chunk.insert(chunk.end(), payload.begin(), payload.end());
	ChunkPlace place;
	place.checksum = chunk.size();
	chunk.resize(chunk.size() + 4);
	mendChecksum(chunk, place);
	return chunk;
}

namespace {

/// A little of everything that a manifold has not.
MeshData makeNoManifold()
{
	MeshData m = makeOctahedron();
	addFace(m, 0, 1, addVertex(m, 3, 1, 0.5)); // third at an edge
	addFace(m, 2, 6, addVertex(m, 1, 3, 2));
	std::swap(m.triangles[3][0], m.triangles[3][1]);
	m.triangles.push_back(m.triangles[1]);
	addFace(m, 4, 4, 5);
	addVertex(m, 0.2, 0.3, 4);
	return m;
}

MeshData withColours(MeshData m)
{
	Attribute colour, wedge;
	colour.kind       = AttributeKind::Colour;
	colour.type       = NumberType::Integer;
	colour.components = 3;
	wedge.of          = AttributeOf::Corner;
	wedge.name        = "w";
	for (std::size_t i = 0; i < 3 * m.positions.size(); ++i)
		colour.values.push_back(double(i * 7 % 256));
	for (std::size_t i = 0; i < 3 * m.triangles.size(); ++i)
		wedge.values.push_back(double(i % 5) / 4);
	m.attributes = {colour, wedge};
	m.textures   = {"t"};
	return m;
}

} // namespace

std::vector<SmallFile> smallFiles()
{
	struct Recipe
	{
		const char* name;
		MeshData mesh;
		int bits, lifting;
		Wgc wgc;
		bool keepOrder = false, exact = false;
		Mode mode         = Mode::Classic;
		int effort        = 2;
		Optimize optimize = Optimize::Balanced;
	};
	const Recipe recipes[] = {
	    {"triangle", makeTriangle(), 8, kLiftingOff, Wgc::Off},
	    {"sphere_lazy", makeIcosphere(3), 8, kLiftingOff, Wgc::Off},
	    {"flipped_sphere", makeFlippedSphere(40, 5), 6, 0, Wgc::Off},
	    {"terrain", makeTerrain(50, 1), 7, 1, Wgc::On},
	    {"components",
	     joined({makeTorus(5, 4), moved(makeStrip(5), 3, 0, 0), moved(makeTetrahedron(), 0, 4, 0)}),
	     7, kLiftingOff, Wgc::Auto},
	    {"kleetope", makeKleetope(makeIcosahedron()), 5, 2, Wgc::Off},
	    {"no_manifold", makeNoManifold(), 6, 0, Wgc::Off},
	    {"order_and_exact", makeFlippedSphere(20, 6), 5, 0, Wgc::Off, true, true},
	    {"every_promise", makeNoManifold(), 6, kLiftingOff, Wgc::Off, true, true},
	    {"attributes", withColours(makeGrid(4, 3)), 6, kLiftingOff, Wgc::Off},
	    {"several_chunks", makeFlippedSphere(200, 15), 20, kLiftingOff, Wgc::Off},
	    {"compact_triangle", makeTriangle(), 8, 0, Wgc::Off, false, false, Mode::Compact},
	    {"compact_smooth", makeBumpySphere(40, 1), 12, 0, Wgc::Off, false, false, Mode::Compact},
	    {"compact_open", joined({makeTerrain(30, 1), moved(makeStrip(5), 3, 0, 0)}), 10, 0,
	     Wgc::Off, false, false, Mode::Compact, 3},
	    {"compact_repeats", punch(makeFlatGrid(6, 6), 3, 1), 14, 0, Wgc::Off, false, false,
	     Mode::Compact, 2, Optimize::Size},
	    {"compact_repeats_effort_3", joined({makeFlatGrid(5, 5), makeCube()}), 16, 0, Wgc::Auto,
	     false, false, Mode::Compact, 3, Optimize::Size},
	    {"compact_every_promise", withColours(makeNoManifold()), 8, 0, Wgc::Off, true, true,
	     Mode::Compact},
	    {"every_promise_in_levels", withColours(joined({makeNoManifold(), makeTerrain(50, 4)})), 10,
	     0, Wgc::Off, true, true},
	    {"compact_every_promise_in_levels",
	     withColours(joined({makeNoManifold(), makeBumpySphere(40, 4)})), 10, 0, Wgc::Off, true,
	     true, Mode::Compact},
	    {"compact_24_bits", makeFlippedSphere(30, 5), 24, 0, Wgc::Off, false, false, Mode::Compact},
	};
	std::vector<SmallFile> files;
	for (const Recipe& r : recipes) {
		EncodeOptions o;
		o.bits      = r.bits;
		o.lifting   = r.lifting;
		o.wgc       = r.wgc;
		o.keepOrder = r.keepOrder;
		o.exact     = r.exact;
		o.optimize  = r.optimize;
		o.mode      = r.mode;
		o.effort    = r.effort;
		auto file   = encode(r.mesh, o);
		if (!file.ok())
			throw std::runtime_error(file.status().what);
		files.push_back({r.name, r.mesh, std::move(*file)});
	}
	return files;
}

} // namespace wavemesh::test
