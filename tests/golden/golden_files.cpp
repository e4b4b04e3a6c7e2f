// SPDX-License-Identifier: GPL-3.0-or-later
#include "golden_files.h"

#include "codec_check.h"
#include "container/container.h"
#include "mesh_families.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace wavemesh::test {

Bytes readFile(const std::string& path)
{
	std::ifstream in(path, std::ios::binary);
	if (!in)
		throw std::runtime_error("cannot read " + path);
	return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void writeFile(const std::string& path, const Bytes& bytes)
{
	std::ofstream out(path, std::ios::binary);
	out.write(
	    reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
	if (!out.flush())
		throw std::runtime_error("cannot write " + path);
}

Golden outcomeOf(const Golden& golden)
{
	Golden out = golden;
	const ExactBuffer data(golden.bytes.data(), golden.bytes.size());
	const auto back = decode(data.data(), data.size());
	out.status      = static_cast<int>(back.status().code);
	out.level       = back.hasValue() ? back->level : -1;
	out.digest      = back.hasValue() ? fingerprint(back->mesh) : 0;
	return out;
}

std::string indexLine(const Golden& g)
{
	std::ostringstream line;
	line << g.name << ' ' << g.status << ' ' << g.level << ' ' << std::hex << g.digest;
	return line.str();
}

namespace {

Bytes fileOf(const MeshData& mesh, int bits, int lifting, Wgc wgc, double step = 0, int effort = 2)
{
	EncodeOptions o;
	o.optimize = Optimize::Size; // files of every kind, whatever the default is good for
	o.bits     = bits;
	o.lifting  = lifting;
	o.wgc      = wgc;
	o.step     = step;
	o.effort   = effort;
	o.mode     = Mode::Classic;
	return encode(mesh, o).value().bytes;
}

EncodedMesh compactFileOf(const MeshData& mesh, int bits, int effort = 2)
{
	EncodeOptions o;
	o.optimize = Optimize::Size;
	o.mode     = Mode::Compact;
	o.bits     = bits;
	o.effort   = effort;
	return encode(mesh, o).value();
}

/// A sphere one of whose vertices belongs to another sphere too, and an edge with three faces.
MeshData notManifold()
{
	MeshData m      = joined({makeIcosphere(3), moved(makeIcosphere(2), 2, 0, 0)});
	const Index own = m.triangles.front()[0], other = m.triangles.back()[0];
	for (auto& t : m.triangles)
		for (auto& v : t)
			if (v == other)
				v = own;
	const auto edge = m.triangles[5];
	m.positions.push_back({0.5, 1.5, 2});
	m.triangles.push_back({edge[1], edge[0], Index(m.positions.size() - 1)});
	return m;
}

/// One attribute of each coding: on lattices, on an octahedron, exact; of vertices, faces, corners
/// with a seam, the mesh; and edges of polygons.
MeshData withAttributes(MeshData m)
{
	const auto add = [&](AttributeOf of, AttributeKind kind, NumberType type, int columns,
	                     int bits) {
		Attribute a;
		a.of         = of;
		a.kind       = kind;
		a.type       = type;
		a.components = columns;
		a.bits       = bits;
		m.attributes.push_back(a);
		return std::ref(m.attributes.back().values);
	};
	m.attributes.reserve(8);
	auto& colour = add(AttributeOf::Vertex, AttributeKind::Colour, NumberType::Integer, 4, 0).get();
	auto& quality = add(AttributeOf::Vertex, AttributeKind::Quality, NumberType::Float, 1, 0).get();
	auto& normal  = add(AttributeOf::Vertex, AttributeKind::Normal, NumberType::Float, 3, 8).get();
	for (const auto& p : m.positions) {
		colour.insert(
		    colour.end(), {std::floor(99 + 40 * p[0]), std::floor(150 + 9 * p[1] * p[2]), 7, 255});
		quality.push_back(double(float(p[0] * p[1] / 3)));
		const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
		for (const double x : p)
			normal.push_back(length > 0 ? double(float(x / length)) : 0);
	}
	auto& face  = add(AttributeOf::Face, AttributeKind::Quality, NumberType::Integer, 1, 0).get();
	auto& edges = add(AttributeOf::Face, AttributeKind::FauxEdges, NumberType::Integer, 1, 0).get();
	auto& wedge =
	    add(AttributeOf::Corner, AttributeKind::TexCoord, NumberType::Double, 3, 10).get();
	for (std::size_t f = 0; f < m.triangles.size(); ++f) {
		const double chart = m.positions[m.triangles[f][0]][0] > 0.2 ? 1 : 0;
		face.push_back(double(f / 16));
		edges.push_back(f % 3 == 1 ? double(1 << f % 2) : 0);
		for (const Index v : m.triangles[f])
			wedge.insert(wedge.end(), {m.positions[v][1] + chart, m.positions[v][2], chart});
	}
	auto& placed =
	    add(AttributeOf::Mesh, AttributeKind::Transform, NumberType::Double, 16, 0).get();
	for (int k = 0; k < 16; ++k)
		placed.push_back(k % 5 == 0 ? 1 : 0.25 * k);
	m.textures = {"wood.png"};
	return m;
}

/// The finest mesh is as it was, in all.
Bytes promisingFileOf(const MeshData& mesh, Mode mode, bool order, bool exact)
{
	EncodeOptions o;
	o.mode      = mode;
	o.keepOrder = order;
	o.exact     = exact;
	return encode(mesh, o).value().bytes;
}

std::vector<Golden> goodOnes()
{
	std::vector<Golden> all;
	const auto add = [&](const char* name, const Bytes& bytes) {
		all.push_back({std::string("good_") + name + ".wmc", bytes});
	};
	add("triangle_1_bit", fileOf(makeTriangle(), 1, kLiftingOff, Wgc::Off));
	add("tetrahedron_step", fileOf(makeTetrahedron(), 12, 0, Wgc::Off, 0.1));
	add("sphere_lazy", fileOf(makeBumpySphere(160, 1), 12, kLiftingOff, Wgc::Off));
	add("sphere_fast", fileOf(makeBumpySphere(160, 1), 12, kLiftingOff, Wgc::Off, 0, 1));
	add("plate_fast", fileOf(makeHoledPlate(2, 2), 10, 0, Wgc::Off, 0, 1));
	add("sphere_lifted_0", fileOf(makeBumpySphere(160, 1), 12, 0, Wgc::Off));
	add("sphere_lifted_1", fileOf(makeBumpySphere(160, 1), 12, 1, Wgc::Off));
	add("sphere_lifted_2", fileOf(makeBumpySphere(160, 1), 12, 2, Wgc::Off));
	add("star_prism_wgc", fileOf(makeStarPrism(9, 4), 10, 0, Wgc::On));
	add("terrain_wgc", fileOf(makeTerrain(150, 2), 16, 0, Wgc::On));
	add("flips", fileOf(makeFlippedSphere(150, 3), 8, 0, Wgc::Off));
	add("kleetope_centres", fileOf(makeKleetope(makeIcosphere(2)), 10, 1, Wgc::Off));
	add("genus_2", fileOf(makeHoledPlate(2, 2), 10, 0, Wgc::Auto));
	add("components_24_bits",
	    fileOf(
	        joined({makeTorus(6, 5), moved(makeGrid(5, 5), 3, 0, 0), moved(makeFan(7), 0, 4, 0)}),
	        24, kLiftingOff, Wgc::Off));
	add("compact_smooth", compactFileOf(makeBumpySphere(160, 1), 12).bytes);
	add("compact_repeats", compactFileOf(punch(makeFlatGrid(12, 12), 9, 1), 12).bytes);
	add("compact_few_predictors", compactFileOf(makeBumpySphere(16400, 1), 8).bytes);
	add("compact_effort_3", compactFileOf(makeBumpySphere(160, 1), 12, 3).bytes);
	add("compact_repeats_effort_3",
	    compactFileOf(joined({makeFlatGrid(9, 9), makeCube()}), 14, 3).bytes);
	add("compact_boundary", compactFileOf(makeTerrain(150, 2), 16).bytes);
	add("compact_components",
	    compactFileOf(
	        joined({makeTorus(6, 5), moved(makeGrid(5, 5), 3, 0, 0), moved(makeFan(7), 0, 4, 0)}),
	        12)
	        .bytes);
	add("compact_1_bit", compactFileOf(makeFlippedSphere(60, 3), 1).bytes);
	add("compact_24_bits", compactFileOf(makeFlippedSphere(150, 3), 24).bytes);
	add("compact_centres", compactFileOf(makeKleetope(makeIcosphere(2)), 10).bytes);
	add("compact_not_manifold", compactFileOf(notManifold(), 12).bytes);
	add("compact_order", promisingFileOf(makeBumpySphere(120, 1), Mode::Compact, true, false));
	add("order_exact_not_manifold", promisingFileOf(notManifold(), Mode::Classic, true, true));
	add("compact_exact", promisingFileOf(makeTerrain(100, 2), Mode::Compact, false, true));
	add("compact_attributes",
	    promisingFileOf(withAttributes(makeBumpySphere(160, 1)), Mode::Compact, false, false));
	add("attributes_order_not_manifold",
	    promisingFileOf(withAttributes(notManifold()), Mode::Classic, true, true));
	add("far_away_wide_head", fileOf(moved(makeIcosphere(2), 1e7 + 0.1, 0.3, -5), 12, 0, Wgc::Off));
	return all;
}

/// Changes the head of a file and writes it anew, the levels as they are.
template <class Change>
Bytes withHead(const Bytes& file, const Change& change)
{
	std::size_t end = 0;
	Head head       = readHead(file.data(), file.size(), end).value();
	change(head);
	Bytes out;
	writeHead(head, out);
	out.insert(out.end(), file.begin() + static_cast<std::ptrdiff_t>(end), file.end());
	return out;
}

Bytes cutAt(const Bytes& file, std::size_t size)
{
	return {file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size)};
}

/// @param add  callable (name, bytes, status)
template <class Add>
void badCompactOnes(const Add& add)
{
	const EncodedMesh file = compactFileOf(makeBumpySphere(160, 1), 12);
	const auto& levels     = file.info.levels;
	std::size_t precise    = levels.size() - 1;
	while (levels[precise].kind != LevelKind::Precise)
		--precise;
	add("compact_cut_in_a_precise_level",
	    cutAt(file.bytes, std::size_t(levels[precise].prefix - levels[precise].geometryBytes / 2)),
	    StatusCode::Truncated);
	add("compact_base_without_bits",
	    withHead(file.bytes, [](Head& h) { h.lattice.bits = h.rows[0].shift; }),
	    StatusCode::Corrupt);
	Bytes classic   = file.bytes;
	const auto head = chunksOf(classic).front();
	classic[head.payload + 2] &= 0xf8; // the mode: no row can be precise
	mendChecksum(classic, head);
	add("compact_called_classic", classic, StatusCode::Corrupt);
	add("compact_one_bit_more",
	    withHead(
	        file.bytes,
	        [&](Head& h) {
		        for (std::size_t i = 0; i < precise; ++i)
			        ++h.rows[i].shift;
	        }),
	    StatusCode::Corrupt);
	add("compact_unknown_predictors",
	    withHead(file.bytes, [](Head& h) { h.predictors = PredictorSet(3); }), StatusCode::Corrupt);
}

std::vector<Golden> badOnes()
{
	std::vector<Golden> all;
	const auto add = [&](const char* name, const Bytes& bytes, StatusCode code) {
		all.push_back({std::string("bad_") + name + ".wmc", bytes, static_cast<int>(code)});
	};
	const Bytes file  = fileOf(makeFlippedSphere(110, 15), 12, 0, Wgc::Off);
	const auto chunks = chunksOf(file);
	const auto mended = [&](std::size_t chunk, std::size_t at, std::uint8_t value) {
		Bytes changed                       = file;
		changed[chunks[chunk].payload + at] = value;
		mendChecksum(changed, chunks[chunk]);
		return changed;
	};
	const std::string ply = "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n";
	add("empty", {}, StatusCode::NotWmc);
	add("ply", {ply.begin(), ply.end()}, StatusCode::NotWmc);
	Bytes text = file;
	text.erase(text.begin() + 4); // the carriage return
	add("text_mode", text, StatusCode::Corrupt);
	add("newer_major", mended(0, 0, 1), StatusCode::VersionTooNew);
	add("bits_0", mended(0, 4, 0), StatusCode::Corrupt);
	add("bits_25", mended(0, 4, 25), StatusCode::Corrupt);
	add("unknown_mode", mended(0, 2, 7), StatusCode::Corrupt);
	add("cut_in_magic", cutAt(file, 5), StatusCode::Truncated);
	add("cut_in_head", cutAt(file, chunks[0].checksum - 1), StatusCode::Truncated);
	add("cut_after_head", cutAt(file, chunks[0].end), StatusCode::Truncated);
	add("cut_in_a_level", cutAt(file, file.size() - file.size() / 4), StatusCode::Truncated);
	add("cut_in_the_last_checksum", cutAt(file, file.size() - 2), StatusCode::Truncated);
	Bytes flipped = file;
	flipped[chunks[0].payload + 6] ^= 1;
	add("head_bit", flipped, StatusCode::ChecksumMismatch);
	flipped = file;
	flipped[chunks[1].payload + 6] ^= 1;
	add("level_bit", flipped, StatusCode::ChecksumMismatch);
	Bytes critical   = file;
	const Bytes next = makeChunk('Q', {1, 2, 3});
	critical.insert(
	    critical.begin() + static_cast<std::ptrdiff_t>(chunks[0].end), next.begin(), next.end());
	add("unknown_critical_chunk", critical, StatusCode::Corrupt);
	add("other_digest", withHead(file, [](Head& h) { ++h.digest; }), StatusCode::ChecksumMismatch);
	add("one_vertex_more", withHead(file, [](Head& h) { ++h.rows.back().vertices; }),
	    StatusCode::Corrupt);
	add("one_face_more", withHead(file, [](Head& h) { ++h.rows.back().faces; }),
	    StatusCode::Corrupt);
	badCompactOnes(add);
	add("base_too_large",
	    withHead(file, [](Head& h) { h.rows[0].vertices = 3 * h.rows[0].faces + 1; }),
	    StatusCode::Corrupt);
	add("beyond_the_limit",
	    withHead(
	        file,
	        [](Head& h) {
		        h.rows.resize(1);
		        h.rows[0].vertices  = 300'000'000;
		        h.rows[0].faces     = 600'000'000;
		        h.rows[0].endsChunk = true;
	        }),
	    StatusCode::LimitExceeded);
	return all;
}

} // namespace

std::vector<Golden> makeGoldens()
{
	std::vector<Golden> all = goodOnes(), bad = badOnes();
	all.insert(all.end(), bad.begin(), bad.end());
	for (Golden& g : all) {
		const Golden outcome = outcomeOf(g);
		if (outcome.status != g.status)
			throw std::runtime_error(
			    g.name + " gives status " + std::to_string(outcome.status) + " and not " +
			    std::to_string(g.status));
		g = outcome;
	}
	return all;
}

} // namespace wavemesh::test
