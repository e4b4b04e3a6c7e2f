// SPDX-License-Identifier: GPL-3.0-or-later
#include "golden_files.h"

#include "codec_check.h"
#include "container/container.h"
#include "golden_meshes.h"
#include "mesh_families.h"

#include <fstream>
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

/// Whole but for what it says: an empty base mesh, and a split of it.
Bytes splitOfNothing()
{
	Head h;
	h.mode         = Mode::Compact;
	h.rich         = true;
	h.lattice.bits = 12;
	h.lattice.step = 1;
	h.rows.resize(2);
	h.rows[0].kind = LevelKind::Base;
	h.rows[1].kind = LevelKind::Split;
	for (LevelRow& row : h.rows)
		row.endsChunk = true;
	h.digest = digestOf(CornerTable(), {});
	Bytes file;
	writeHead(h, file);
	for (std::size_t i = 0; i < h.rows.size(); ++i)
		writeChunk(kLevelChunk, {}, file);
	return file;
}

EncodedMesh encoded(const MeshData& mesh, const EncodeOptions& options)
{
	auto file = encode(mesh, options);
	if (!file.ok())
		throw std::runtime_error("a golden's mesh is refused: " + file.status().what);
	return std::move(*file);
}

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
	return encoded(mesh, o).bytes;
}

EncodedMesh compactFileOf(const MeshData& mesh, int bits, int effort = 2)
{
	EncodeOptions o;
	o.optimize = Optimize::Size;
	o.mode     = Mode::Compact;
	o.bits     = bits;
	o.effort   = effort;
	return encoded(mesh, o);
}

/// The finest mesh is as it was, in all.
Bytes promisingFileOf(const MeshData& mesh, Mode mode, bool order, bool exact)
{
	EncodeOptions o;
	o.mode      = mode;
	o.keepOrder = order;
	o.exact     = exact;
	return encoded(mesh, o).bytes;
}

/// Every kind of row crossed with every way to make the finest mesh the original.
/// @param add  callable (name, bytes)
template <class Add>
void goodAttributes(const Add& add)
{
	constexpr auto kFloat = NumberType::Float, kDouble = NumberType::Double;
	const MeshData sphere = makeFlippedSphere(90, 3), centres = makeKleetope(makeIcosphere(2));
	add("compact_turned_order_corners",
	    promisingFileOf(
	        withCorners(turned(makeBumpySphere(90, 1)), kFloat, 11), Mode::Compact, true, false));
	add("turned_order_exact_corners",
	    promisingFileOf(withCorners(turned(notManifold()), kDouble, 0), Mode::Classic, true, true));
	add("compact_flipped_corners",
	    promisingFileOf(withCorners(sphere, kFloat, 9), Mode::Compact, false, false));
	add("centres_corners",
	    promisingFileOf(withCorners(centres, kFloat, 8), Mode::Classic, false, false));
	add("compact_not_finite_floats",
	    promisingFileOf(withNotFinite(makeTerrain(70, 2), kFloat), Mode::Compact, true, true));
	add("not_finite_doubles",
	    promisingFileOf(withNotFinite(sphere, kDouble), Mode::Classic, false, true));
	add("compact_normals", promisingFileOf(withNormals(sphere), Mode::Compact, false, false));
	add("order_normals", promisingFileOf(withNormals(notManifold()), Mode::Classic, true, false));
	add("compact_flags_order",
	    promisingFileOf(withFlags(turned(makeGrid(8, 7))), Mode::Compact, true, false));
	MeshData points = makeIcosphere(2);
	points.triangles.clear();
	add("compact_points", promisingFileOf(withFlags(points), Mode::Compact, true, true));
}

std::vector<Golden> goodOnes()
{
	std::vector<Golden> all;
	const auto add = [&](const char* name, const Bytes& bytes) {
		all.push_back({std::string("good_") + name + ".wmc", bytes});
	};
	add("example", fileOf(makeGrid(3, 3), 4, 0, Wgc::Off)); // of docs/wmc_format.md
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
	goodAttributes(add);
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

/// What follows the levels: cut there, and contradicting itself.
/// @param add  callable (name, bytes, status)
template <class Add>
void badFeatures(const Add& add)
{
	const Bytes file = promisingFileOf(
	    withFlags(withCorners(turned(makeGrid(6, 5)), NumberType::Float, 11)), Mode::Compact, true,
	    true);
	const auto chunks = chunksOf(file);
	const auto& level = chunks[chunks.size() - 5]; // the last one, before R, O, X and A
	add("cut_in_attributes_of_a_level", cutAt(file, level.checksum - 20), StatusCode::Truncated);
	for (std::size_t i = chunks.size() - 4; i < chunks.size(); ++i)
		add(std::string("cut_in_") + char(chunks[i].type), cutAt(file, chunks[i].checksum - 1),
		    StatusCode::Truncated);
	const Bytes classic = promisingFileOf(
	    withNotFinite(notManifold(), NumberType::Float), Mode::Classic, false, true);
	const auto places = chunksOf(classic);
	add("classic_cut_in_attributes_of_a_level",
	    cutAt(classic, places[places.size() - 4].checksum - 40), StatusCode::Truncated);
	add("cut_before_R", cutAt(classic, places[places.size() - 3].begin), StatusCode::Truncated);

	for (std::size_t i = chunks.size() - 4; i < chunks.size(); ++i) {
		Bytes digest = file;
		digest[chunks[i].payload] ^= 1;
		mendChecksum(digest, chunks[i]);
		add(std::string("other_digest_of_") + char(chunks[i].type), digest,
		    StatusCode::ChecksumMismatch);
	}
	add("features_16", withHead(file, [](Head& h) { h.features |= 16; }), StatusCode::Corrupt);
	add("length_of_order", withHead(file, [](Head& h) { ++h.featureBytes[kOrder]; }),
	    StatusCode::Corrupt);
	add("fewer_faces_than_the_finest_level",
	    withHead(file, [](Head& h) { h.faces = h.rows.back().faces - 1; }), StatusCode::Corrupt);
	add("fewer_faces_than_copies", withHead(file, [](Head& h) { h.faces = h.rows.back().faces; }),
	    StatusCode::Corrupt);
	add("attribute_of_nothing", withHead(file, [](Head& h) { h.channels[0].of = AttributeOf(4); }),
	    StatusCode::Corrupt);
	add("attribute_with_a_step_of_0",
	    withHead(
	        file,
	        [](Head& h) {
		        h.channels[0].columns[0] = {0, 0, 11, false};
	        }),
	    StatusCode::Corrupt);
	add("attribute_on_an_octahedron_of_21_bits",
	    withHead(file, [](Head& h) { h.channels[1].octahedron = 21; }), StatusCode::Corrupt);
}

std::vector<Golden> badOnes()
{
	std::vector<Golden> all;
	const auto add = [&](const std::string& name, const Bytes& bytes, StatusCode code) {
		all.push_back({"bad_" + name + ".wmc", bytes, static_cast<int>(code)});
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
	add("older_minor", mended(0, 1, 4), StatusCode::VersionTooOld);
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
	badFeatures(add);
	add("base_too_large",
	    withHead(file, [](Head& h) { h.rows[0].vertices = 3 * h.rows[0].faces + 1; }),
	    StatusCode::Corrupt);
	add("split_of_nothing", splitOfNothing(), StatusCode::Corrupt);
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
