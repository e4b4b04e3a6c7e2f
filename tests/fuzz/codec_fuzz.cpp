// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What any bytes whatever must not break: a decoder neither crashes nor takes more than it was
/// allowed, says the same every time, and what it gives as a whole mesh is one that the encoder
/// takes back, on the same lattice, and that comes out again with as many vertices and faces.
#include <wavemesh/codec.h>

#include <cstdlib>
#include <vector>

using namespace wavemesh;

namespace {

void require(bool condition)
{
	if (!condition)
		std::abort();
}

bool same(const MeshData& a, const MeshData& b)
{
	return a.positions == b.positions && a.triangles == b.triangles;
}

DecodeOptions smallOptions()
{
	DecodeOptions options;
	options.limits.maxVertices = 100'000;
	options.limits.maxFaces    = 200'000;
	return options;
}

void levelByLevel(const std::uint8_t* data, std::size_t size, const MeshData* finest)
{
	auto decoder = Decoder::open(data, size, smallOptions().limits);
	if (!decoder.hasValue())
		return;
	std::size_t vertices = 0;
	while (decoder->level() < decoder->info().finestLevel() && decoder->advance().ok()) {
		const MeshData mesh = decoder->mesh();
		require(mesh.positions.size() >= vertices);
		vertices = mesh.positions.size();
		for (const auto& triangle : mesh.triangles)
			for (const std::uint32_t v : triangle)
				require(v < vertices);
	}
	if (finest != nullptr)
		require(same(decoder->mesh(), *finest));
}

void roundTrip(const DecodedMesh& decoded)
{
	EncodeOptions options;
	options.step       = decoded.info.step;
	options.wgc        = Wgc::Off;
	const auto encoded = encode(decoded.mesh, options);
	if (!encoded.ok())
		return; // too wide for its step, for one
	const auto again = decode(encoded->bytes.data(), encoded->bytes.size());
	require(again.ok());
	require(again->mesh.positions.size() == decoded.mesh.positions.size());
	require(again->mesh.triangles.size() == decoded.mesh.triangles.size());
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
	// A copy of exactly this size, so that reading past the end is noticed.
	const std::vector<std::uint8_t> copy(bytes, bytes + size);
	const auto first  = decode(copy.data(), copy.size(), smallOptions());
	const auto second = decode(copy.data(), copy.size(), smallOptions());
	require(first.status().code == second.status().code);
	require(first.hasValue() == second.hasValue());
	require(first.status().code != StatusCode::Internal);
	if (first.hasValue())
		require(same(first->mesh, second->mesh));
	levelByLevel(copy.data(), copy.size(), first.ok() ? &first->mesh : nullptr);
	if (first.ok())
		roundTrip(*first);
	return 0;
}
