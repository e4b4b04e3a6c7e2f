// SPDX-License-Identifier: GPL-3.0-or-later
// make_goldens <tests/golden> <samples>: writes the golden files, their index and the table of
// sizes.
#include "golden_files.h"
#include "sample_sizes.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

namespace {

using namespace wavemesh::test;
namespace fs = std::filesystem;

void writeGoldens(const fs::path& folder)
{
	const auto goldens = makeGoldens(); // before anything is removed
	for (const auto& entry : fs::directory_iterator(folder))
		if (entry.path().extension() == ".wmc")
			fs::remove(entry.path());
	std::ofstream index(folder / "index.txt");
	index << "# file, status, level, fingerprint of the mesh\n";
	for (const Golden& g : goldens) {
		writeFile((folder / g.name).string(), g.bytes);
		index << indexLine(g) << '\n';
	}
}

void writeSizes(const fs::path& folder, const fs::path& samples)
{
	std::ofstream table(folder / "sample_sizes.txt");
	table << "# sample, configuration, bytes\n";
	for (const std::string& name : kSamples) {
		const auto mesh = readSamplePly((samples / (name + ".ply")).string());
		for (const Configuration& c : kConfigurations)
			table << name << ' ' << c.name << ' ' << encodeSample(mesh, c).bytes.size() << '\n';
	}
}

} // namespace

int main(int argc, char** argv)
{
	if (argc != 3) {
		std::fprintf(stderr, "usage: make_goldens <tests/golden> <samples>\n");
		return 2;
	}
	try {
		writeGoldens(argv[1]);
		writeSizes(argv[1], argv[2]);
	}
	catch (const std::exception& e) {
		std::fprintf(stderr, "make_goldens: %s\n", e.what());
		return 1;
	}
	return 0;
}
