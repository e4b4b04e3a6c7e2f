// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Any mesh whatever with any options: what is decoded is what was promised, every level is a
/// manifold, and every level's prefix of the file is that level.
#include "any_isomorphism.h"
#include "codec_check.h"
#include "drawn_mesh.h"
#include "fuzz_check.h"
#include "wmc_files.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace wavemesh::test {
namespace {

using Label = std::array<std::int64_t, 3>;

bool isFinite(const MeshData& mesh)
{
	for (const auto& p : mesh.positions)
		for (const double x : p)
			if (!std::isfinite(x))
				return false;
	return true;
}

/// What a vertex keeps: the bits of its coordinates, or its lattice point.
std::vector<Label> labelsOf(const MeshData& mesh, const StreamInfo& info)
{
	if (!info.features.exact)
		return latticeOf(mesh, info);
	std::vector<Label> labels(mesh.positions.size());
	if (!labels.empty())
		std::memcpy(labels.data(), mesh.positions.data(), labels.size() * sizeof(Label));
	return labels;
}

/// What element `row` of an attribute belongs to, in labels.
std::vector<Label>
ownerOf(const Attribute& a, std::size_t row, const MeshData& mesh, const std::vector<Label>& labels)
{
	switch (a.of) {
	case AttributeOf::Vertex:
		return {labels[row]};
	case AttributeOf::Corner:
		return {labels[mesh.triangles[row / 3][row % 3]]};
	case AttributeOf::Face: {
		const auto& t = mesh.triangles[row];
		std::vector<Label> corners {labels[t[0]], labels[t[1]], labels[t[2]]};
		std::sort(corners.begin(), corners.end());
		return corners;
	}
	case AttributeOf::Mesh:
		break;
	}
	return {};
}

/// Rows of an attribute with what they belong to, in an order of their own.
std::vector<std::pair<std::vector<Label>, std::vector<std::uint64_t>>>
rowsOf(const Attribute& a, const MeshData& mesh, const std::vector<Label>& labels)
{
	const auto width = static_cast<std::size_t>(a.components);
	std::vector<std::pair<std::vector<Label>, std::vector<std::uint64_t>>> rows;
	for (std::size_t row = 0; row * width < a.values.size(); ++row) {
		std::vector<std::uint64_t> bits(width);
		std::memcpy(bits.data(), a.values.data() + row * width, width * sizeof bits[0]);
		rows.emplace_back(ownerOf(a, row, mesh, labels), std::move(bits));
	}
	return rows;
}

void checkAttributes(
    const MeshData& a,
    const std::vector<Label>& ofA,
    const MeshData& b,
    const std::vector<Label>& ofB,
    bool inOrder)
{
	require(a.textures == b.textures, "textures come back");
	require(a.attributes.size() == b.attributes.size(), "attributes come back");
	for (std::size_t i = 0; i < a.attributes.size(); ++i) {
		const Attribute &x = a.attributes[i], &y = b.attributes[i];
		require(
		    x.of == y.of && x.kind == y.kind && x.type == y.type && x.name == y.name &&
		        x.components == y.components,
		    "an attribute stays what it is");
		auto before = rowsOf(x, a, ofA), after = rowsOf(y, b, ofB);
		if (!inOrder) {
			std::sort(before.begin(), before.end());
			std::sort(after.begin(), after.end());
		}
		require(before == after, "an attribute's values stay with their elements");
	}
}

void checkWhole(const MeshData& mesh, const EncodeOptions& options, const DecodedMesh& back)
{
	const std::vector<Label> before = labelsOf(mesh, back.info),
	                         after  = labelsOf(back.mesh, back.info);
	if (options.keepOrder) {
		require(back.mesh.triangles == mesh.triangles, "faces keep their order");
		require(before == after, "vertices keep their order and place");
	}
	else {
		const std::string trouble =
		    tool::whatDiffersInAnyMesh({before, mesh.triangles}, {after, back.mesh.triangles});
		require(trouble.empty(), "the mesh comes back:", trouble);
	}
	checkAttributes(mesh, before, back.mesh, after, options.keepOrder);
}

void checkLevels(const EncodedMesh& file, std::uint32_t drawn)
{
	const auto levels = levelsOf(file.bytes);
	require(levels.size() == file.info.levels.size(), "all levels come");
	for (std::size_t j = 0; j < levels.size(); ++j) {
		const MeshData& mesh = levels[j].mesh;
		require(levels[j].status.ok(), "a level comes:", levels[j].status.what);
		require(
		    mesh.positions.size() == file.info.levels[j].vertices &&
		        mesh.triangles.size() == file.info.levels[j].faces,
		    "a level has the size that the head declares");
		const bool finest = j + 1 == levels.size();
		if (!mesh.triangles.empty() &&
		    (!finest || !(file.info.features.restored || file.info.features.exact)))
			requireNone(whatIsNotManifold(mesh), "a level is a manifold:");
	}
	const std::size_t j = drawn % levels.size();
	const ExactBuffer data(file.bytes.data(), std::size_t(file.info.levels[j].prefix));
	const auto cut = decode(data.data(), data.size());
	require(cut.hasValue() && std::size_t(cut->level) >= j, "a level's prefix gives the level");
	// The same bytes may tell the next connectivity already.
	if (std::size_t(cut->level) == j)
		require(
		    cut->mesh.triangles == levels[j].mesh.triangles &&
		        fingerprint(cut->mesh) == fingerprint(levels[j].mesh),
		    "a level's prefix gives the level's mesh");
}

void roundTrip(ByteSource& in)
{
	const EncodeOptions options = drawnOptions(in);
	const std::uint32_t drawn   = in.byte();
	const MeshData mesh         = drawnMesh(in);
	const auto file             = encode(mesh, options);
	if (!file.ok()) {
		require(
		    file.status().code == StatusCode::InvalidArgument,
		    "only a mesh that is none is refused:", file.status().what);
		require(
		    !isFinite(mesh) || options.step > 0 ||
		        file.status().what.find("bounding") != std::string::npos,
		    "a mesh is encoded:", file.status().what);
		return;
	}
	require(options.exact || isFinite(mesh), "what is not finite needs exact coordinates");
	require(file->info.bytes == file->bytes.size(), "the info knows the file's size");
	const ExactBuffer data(file->bytes.data(), file->bytes.size());
	const auto back = decode(data.data(), data.size());
	require(back.ok(), "what was encoded is decoded:", back.status().what);
	checkWhole(mesh, options, *back);
	checkLevels(*file, drawn);
}

} // namespace
} // namespace wavemesh::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
	wavemesh::test::ByteSource in(bytes, size);
	wavemesh::test::roundTrip(in);
	return 0;
}
