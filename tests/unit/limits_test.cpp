// SPDX-License-Identifier: GPL-3.0-or-later
// Files that declare much more than they hold: refused by name, or ended, before memory is taken.
#include "allocation_watch.h"
#include "codec_check.h"
#include "container/container.h"
#include "mesh_families.h"
#include "wmc_files.h"

#include <gtest/gtest.h>

namespace wavemesh::test {
namespace {

constexpr std::size_t kLittle = 16u << 20; ///< bytes: the decoder's models take a few megabytes

/// A file as its head and its other chunks' payloads.
struct Parts
{
	Head head;
	std::vector<std::pair<std::uint8_t, Bytes>> chunks;

	Bytes file() const
	{
		Bytes out;
		writeHead(head, out);
		for (const auto& [type, payload] : chunks)
			writeChunk(type, payload, out);
		return out;
	}
	/// The payload of a feature, in the head too.
	void replace(Feature feature, const Bytes& payload)
	{
		head.featureBytes[feature] = payload.size();
		for (auto& [type, old] : chunks)
			if (type == kFeatureChunk[feature])
				old = payload;
	}
};

constexpr Mode kModes[] = {Mode::Classic, Mode::Compact};

Parts partsOf(const MeshData& mesh, Mode mode)
{
	EncodeOptions options;
	options.mode       = mode;
	const auto encoded = encode(mesh, options);
	const Bytes& file  = encoded->bytes;
	std::size_t end    = 0;
	Parts parts {readHead(file.data(), file.size(), end).value(), {}};
	const auto places = chunksOf(file);
	for (std::size_t i = 1; i < places.size(); ++i)
		parts.chunks.emplace_back(
		    places[i].type, Bytes(
		                        file.begin() + std::ptrdiff_t(places[i].payload),
		                        file.begin() + std::ptrdiff_t(places[i].checksum)));
	return parts;
}

std::vector<Bytes> emptyStreams()
{
	return {Bytes(4, 0), Bytes(60, 0), Bytes(60, 0x55), Bytes(60, 255)};
}

/// Not a word of this mesh is true; but what is always the same takes few bits, so that a stream of
/// 60 bytes may well begin like one of millions of points.
void expectLittleMemoryFor(const Bytes& file, std::size_t little = 4 * kLittle)
{
	AllocationWatch watch;
	const auto back = decode(file.data(), file.size());
	EXPECT_FALSE(back.ok());
	EXPECT_FALSE(back.hasValue());
	EXPECT_LT(watch.peak(), little) << back.status().what;
}

TEST(Limits, AreNamedWithWhatIsDeclaredAndAllowed)
{
	const auto file      = encode(makeTorus(12, 9));
	const auto complaint = [&](const DecodeLimits& limits) {
		DecodeOptions o;
		o.limits        = limits;
		const auto back = decode(file->bytes.data(), file->bytes.size(), o);
		EXPECT_EQ(back.status().code, StatusCode::LimitExceeded);
		return back.status().what;
	};
	DecodeLimits limits;
	limits.maxVertices = 107;
	EXPECT_EQ(
	    complaint(limits),
	    "the file declares 108 vertices, more than the limit of 107 (maxVertices)");
	limits          = {};
	limits.maxFaces = 200;
	EXPECT_EQ(
	    complaint(limits), "the file declares 216 faces, more than the limit of 200 (maxFaces)");
}

TEST(Limits, ADeclaredButAbsentRestorationTakesNoMemory)
{
	MeshData mesh = makeIcosphere(2);
	mesh.positions.push_back({1, 2, 3});
	for (const Mode mode : kModes) {
		Parts parts = partsOf(mesh, mode);
		ASSERT_TRUE(parts.head.has(kRestoration));
		parts.head.vertices = 190'000'000;
		parts.head.faces    = 380'000'000;
		for (const Bytes& stream : emptyStreams()) {
			parts.replace(kRestoration, stream);
			expectLittleMemoryFor(parts.file());
		}
	}
}

TEST(Limits, DeclaredButAbsentAttributesTakeNoMemory)
{
	MeshData mesh = makeIcosphere(2);
	Attribute a;
	a.components = 10;
	a.values.assign(10 * mesh.positions.size(), 0.5);
	mesh.attributes.assign(60, a);
	for (const Mode mode : kModes) {
		Parts parts = partsOf(mesh, mode);
		for (Channel& channel : parts.head.channels) {
			ASSERT_TRUE(channel.columns.empty());
			channel.components = Channel::kMostColumns;
		}
		for (const Bytes& stream : emptyStreams()) {
			parts.replace(kAttributes, stream);
			expectLittleMemoryFor(parts.file(), kLittle / 2);
		}
	}
}

TEST(Limits, AttributesBeyondTheirsAreRefusedByName)
{
	MeshData mesh = makeIcosphere(2);
	mesh.attributes.resize(1);
	mesh.attributes[0].values.assign(mesh.positions.size(), 0.5);
	DecodeOptions o;
	o.limits.maxAttributeValues = mesh.positions.size() - 1;
	for (const Mode mode : kModes) {
		const Bytes file = partsOf(mesh, mode).file();
		const auto back  = decode(file.data(), file.size(), o);
		EXPECT_EQ(back.status().code, StatusCode::LimitExceeded);
		EXPECT_NE(back.status().what.find("maxAttributeValues"), std::string::npos);
	}
}

TEST(Limits, AttributesCountInTheFinestLevelToo_WhereAnOpenedMeshHasMoreRows)
{
	MeshData mesh; // many pages on one edge: two vertices become two of each page
	mesh.positions = {{0, 0, 0}, {0, 0, 1}};
	for (std::uint32_t page = 0; page < 50; ++page) {
		mesh.positions.push_back({1, double(page), 0});
		mesh.triangles.push_back({0, 1, page + 2});
	}
	mesh.attributes.resize(1);
	mesh.attributes[0].values.assign(mesh.positions.size(), 0.5);
	const auto file = encode(mesh);
	ASSERT_EQ(file->info.features.attributeValues, 52u);
	DecodeOptions o;
	o.limits.maxAttributeValues = 149;
	EXPECT_EQ(
	    decode(file->bytes.data(), file->bytes.size(), o).status().what,
	    "the file declares 150 numbers in attributes, more than the limit of 149 "
	    "(maxAttributeValues)");
	o.limits.maxAttributeValues = 150;
	EXPECT_TRUE(decode(file->bytes.data(), file->bytes.size(), o).ok());
}

TEST(Limits, ThousandsOfLevelsThatAddAVertexEachAreRefusedByName)
{
	for (const Mode mode : kModes) {
		Parts parts = partsOf(makeTetrahedron(), mode);
		ASSERT_EQ(parts.head.rows.size(), 1u);
		LevelRow row = parts.head.rows[0];
		row.vertices = parts.head.rows[0].vertices = 1'000'000;
		row.faces = parts.head.rows[0].faces = 2'000'000;
		row.kind                             = LevelKind::Split;
		row.bytes                            = 0;
		parts.head.rows[0].endsChunk         = false;
		while (parts.head.rows.size() < 4096) {
			++row.vertices;
			row.faces += 2;
			parts.head.rows.push_back(row);
		}
		parts.head.rows.back().endsChunk = true;
		const Bytes file                 = parts.file();
		AllocationWatch watch;
		const auto back = decode(file.data(), file.size());
		EXPECT_EQ(back.status().code, StatusCode::LimitExceeded);
		EXPECT_NE(back.status().what.find("maxLevelShare"), std::string::npos)
		    << back.status().what;
		EXPECT_LT(watch.peak(), kLittle);
		DecodeOptions o;
		o.limits = DecodeLimits::none();
		EXPECT_EQ(decode(file.data(), file.size(), o).status().code, StatusCode::Corrupt);
	}
}

/// What decoding takes at most for a mesh that is there: a fixed part, and so much for a vertex.
TEST(Limits, DecodingTakesMemoryForTheDeclaredMeshOnly)
{
	for (const std::uint32_t vertices : {2'000u, 40'000u})
		for (const bool full : {false, true})
			for (const Mode mode : kModes) {
				EncodeOptions options;
				options.keepOrder = options.exact = full;
				options.mode                      = mode;
				const auto file                   = encode(makeBumpySphere(vertices, 3), options);
				AllocationWatch watch;
				ASSERT_TRUE(decode(file->bytes.data(), file->bytes.size()).ok());
				EXPECT_LT(watch.peak(), kLittle + 700 * std::size_t(vertices)) << vertices;
			}
}

} // namespace
} // namespace wavemesh::test
