// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Runs a fuzz target without a fuzzer: on the files given, on all files in the folders given, and
/// on as many changes of each as asked for, always the same ones.
///
/// usage: <target>_replay [--changes N] {FILE|FOLDER}
#include "rng.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);

namespace {

namespace fs = std::filesystem;
using Bytes  = std::vector<std::uint8_t>;

std::vector<fs::path> filesIn(const fs::path& place)
{
	if (!fs::is_directory(place))
		return {place};
	std::vector<fs::path> files;
	for (const auto& entry : fs::recursive_directory_iterator(place))
		if (entry.is_regular_file())
			files.push_back(entry.path());
	std::sort(files.begin(), files.end());
	return files;
}

/// One to four changes: of a bit, of a byte, bytes out or twice, the end cut off.
Bytes changed(Bytes bytes, wavemesh::test::Rng& rng)
{
	for (std::uint32_t n = 1 + rng.below(4); n > 0 && !bytes.empty(); --n) {
		const auto at = rng.below(std::uint32_t(bytes.size()));
		const auto to = at + std::min(rng.below(8), std::uint32_t(bytes.size()) - at);
		switch (rng.below(8)) {
		case 0:
			bytes.resize(at);
			break;
		case 1:
			bytes.erase(bytes.begin() + at, bytes.begin() + to);
			break;
		case 2: {
			const Bytes twice(bytes.begin() + at, bytes.begin() + to);
			bytes.insert(bytes.begin() + at, twice.begin(), twice.end());
			break;
		}
		case 3:
		case 4:
			bytes[at] = std::uint8_t(rng.next());
			break;
		default:
			bytes[at] ^= std::uint8_t(1 << rng.below(8));
		}
	}
	return bytes;
}

/// A copy of exactly this size, so that reading past the end is noticed.
void runOn(const Bytes& bytes)
{
	const std::vector<std::uint8_t> exact(bytes.begin(), bytes.end());
	LLVMFuzzerTestOneInput(exact.data(), exact.size());
}

} // namespace

int main(int argc, char** argv)
{
	unsigned long changes = 0;
	std::size_t inputs    = 0;
	for (int i = 1; i < argc; ++i) {
		if (std::strcmp(argv[i], "--changes") == 0 && i + 1 < argc) {
			changes = std::strtoul(argv[++i], nullptr, 10);
			continue;
		}
		for (const fs::path& path : filesIn(argv[i])) {
			std::ifstream in(path, std::ios::binary);
			if (!in) {
				std::fprintf(stderr, "cannot read %s\n", path.c_str());
				return 1;
			}
			const Bytes bytes {
			    std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
			std::fprintf(stderr, "%s\n", path.c_str()); // the last one is the one that failed
			runOn(bytes);
			wavemesh::test::Rng rng(bytes.size());
			for (unsigned long k = 0; k < changes; ++k)
				runOn(changed(bytes, rng));
			++inputs;
		}
	}
	std::printf("%zu files, %lu changes of each\n", inputs, changes);
	return inputs == 0 ? 1 : 0;
}
