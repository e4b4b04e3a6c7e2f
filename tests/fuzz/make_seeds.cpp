// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Writes inputs to begin fuzzing with: small files with every feature, and bytes to draw from.
/// usage: make_fuzz_seeds FOLDER
#include "rng.h"
#include "wmc_files.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace fs = std::filesystem;
using wavemesh::test::Bytes;

namespace {

bool write(const fs::path& path, const Bytes& bytes)
{
	std::ofstream out(path, std::ios::binary);
	out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
	return bool(out.flush());
}

} // namespace

int main(int argc, char** argv)
{
	if (argc != 2)
		return 2;
	const fs::path files = fs::path(argv[1]) / "files", bytes = fs::path(argv[1]) / "bytes";
	fs::create_directories(files);
	fs::create_directories(bytes);
	bool good = true;
	for (const auto& small : wavemesh::test::smallFiles())
		good = write(files / (small.name + ".wmc"), small.encoded.bytes) && good;
	for (std::uint32_t i = 0; i < 24; ++i) {
		wavemesh::test::Rng rng(i + 1);
		Bytes some(16 + 24 * i);
		for (std::uint8_t& b : some) // often small, as counts and indices are
			b = std::uint8_t(rng.below(1u << (1 + rng.below(8))));
		good = write(bytes / ("drawn_" + std::to_string(i)), some) && good;
	}
	return good ? 0 : 1;
}
