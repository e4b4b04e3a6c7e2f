// SPDX-License-Identifier: GPL-3.0-or-later
#include "decode_checks.h"

#include "any_isomorphism.h"
#include "codec_check.h"
#include "fuzz_check.h"
#include "wmc_files.h"

#include <algorithm>
#include <cstring>

namespace wavemesh::test {
namespace {

/// Bit for bit: exact coordinates may be no numbers.
template <class Row>
bool sameRows(const std::vector<Row>& a, const std::vector<Row>& b)
{
	return a.size() == b.size() &&
	       (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Row)) == 0);
}

bool same(const MeshData& a, const MeshData& b)
{
	if (!sameRows(a.positions, b.positions) || a.triangles != b.triangles ||
	    a.textures != b.textures || a.attributes.size() != b.attributes.size())
		return false;
	for (std::size_t i = 0; i < a.attributes.size(); ++i)
		if (a.attributes[i].name != b.attributes[i].name ||
		    !sameRows(a.attributes[i].values, b.attributes[i].values))
			return false;
	return true;
}

DecodeOptions smallOptions()
{
	DecodeOptions options;
	options.limits.maxVertices        = 20'000;
	options.limits.maxFaces           = 40'000;
	options.limits.maxAttributeValues = 400'000;
	return options;
}

void checkStatus(const Status& s)
{
	const auto code = static_cast<int>(s.code);
	require(
	    s.ok() || s.code == StatusCode::LimitExceeded ||
	        (code >= int(StatusCode::NotWmc) && code <= int(StatusCode::ChecksumMismatch)),
	    "a file is refused for what is in it", s.what);
	require(s.ok() == s.what.empty(), "there is a message if there is an error");
}

/// Rows of attributes fit the mesh.
void checkAttributes(const MeshData& mesh)
{
	for (const Attribute& a : mesh.attributes) {
		const std::size_t rows[] = {
		    mesh.positions.size(), mesh.triangles.size(), 3 * mesh.triangles.size(), 1};
		require(
		    a.values.size() ==
		        rows[static_cast<std::size_t>(a.of)] * static_cast<std::size_t>(a.components),
		    "an attribute has a row for each element", a.name);
	}
}

/// A level as any level may be. That it is a manifold is the writer's duty (docs/wmc_format.md,
/// section 11.5): who can make checksums right can write other meshes.
void checkLevel(const Decoder& decoder, const MeshData& mesh, bool whole)
{
	checkAttributes(mesh);
	for (const auto& t : mesh.triangles)
		for (const std::uint32_t v : t)
			require(v < mesh.positions.size(), "indices exist");
	if (!whole)
		return;
	const LevelInfo& row = decoder.info().levels[static_cast<std::size_t>(decoder.level())];
	require(
	    mesh.positions.size() == row.vertices && mesh.triangles.size() == row.faces,
	    "a level has the size that the head declares");
}

/// Every level as far as the bytes go.
std::vector<MeshData> levelByLevel(const std::uint8_t* data, std::size_t size)
{
	std::vector<MeshData> levels;
	auto decoder = Decoder::open(data, size, smallOptions().limits);
	if (!decoder.hasValue())
		return levels;
	while (decoder->level() < decoder->info().finestLevel()) {
		const int before = decoder->level();
		const Status s   = decoder->advance();
		checkStatus(s);
		// What a chunk behind the levels contradicts is no mesh to use.
		if (!s.ok() && s.code != StatusCode::Truncated) {
			require(
			    before < 0 || decoder->mesh().positions.empty(), "no mesh is left after an error");
			break;
		}
		if (decoder->level() > before) {
			levels.push_back(decoder->mesh());
			checkLevel(*decoder, levels.back(), s.ok());
		}
		if (!s.ok())
			break;
	}
	return levels;
}

/// A prefix is an earlier level, or one in the middle of the next whose connectivity is whole.
void checkCut(const std::uint8_t* data, std::size_t size, const std::vector<MeshData>& levels)
{
	const auto cut = decode(data, size, smallOptions());
	checkStatus(cut.status());
	if (!cut.hasValue() || levels.empty())
		return;
	const auto level = static_cast<std::size_t>(cut->level);
	if (level + 1 >= levels.size())
		return; // the finest may be without what follows it
	require(
	    cut->mesh.triangles == levels[level].triangles, "a prefix has an earlier level's faces");
}

void checkRoundTrip(const DecodedMesh& decoded)
{
	EncodeOptions options;
	options.step      = decoded.info.step;
	options.exact     = decoded.info.features.exact;
	options.keepOrder = decoded.mesh.positions.size() % 2 == 1;
	options.wgc       = Wgc::Off;
	const auto file   = encode(decoded.mesh, options);
	if (!file.ok())
		return; // too wide for its step, for one
	const auto again = decode(file->bytes.data(), file->bytes.size());
	require(again.ok(), "what was encoded is decoded:", again.status().what);
	if (options.keepOrder)
		require(again->mesh.triangles == decoded.mesh.triangles, "faces keep their order");
	else if (!options.exact) {
		const std::string trouble = tool::whatDiffersInAnyMesh(
		    {latticeOf(decoded.mesh, file->info), decoded.mesh.triangles},
		    {latticeOf(again->mesh, file->info), again->mesh.triangles});
		require(trouble.empty(), "the mesh comes back:", trouble);
	}
}

} // namespace

void checkDecoding(const std::uint8_t* bytes, std::size_t size)
{
	const ExactBuffer data(bytes, size);
	const auto first  = decode(data.data(), size, smallOptions());
	const auto second = decode(data.data(), size, smallOptions());
	checkStatus(first.status());
	require(
	    first.status().code == second.status().code && first.hasValue() == second.hasValue(),
	    "the same bytes have the same outcome");
	if (first.hasValue())
		require(same(first->mesh, second->mesh), "the same bytes give the same mesh");
	const std::vector<MeshData> levels = levelByLevel(data.data(), size);
	if (first.hasValue())
		require(same(first->mesh, levels.back()), "level by level it is the same mesh");
	if (!levels.empty()) {
		const std::size_t at = size * (1 + bytes[size / 2] % 16) / 17;
		const ExactBuffer cut(bytes, at);
		checkCut(cut.data(), at, levels);
	}
	if (first.ok())
		checkRoundTrip(*first);
}

} // namespace wavemesh::test
