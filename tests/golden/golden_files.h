// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Goldens: what is in tests/golden, as the program that writes it and the test that reads it see
/// it.
#pragma once

#include "wmc_files.h"

#include <string>
#include <vector>

namespace wavemesh::test {

/// A file and what decoding it gives.
struct Golden
{
	std::string name; ///< of the file
	Bytes bytes;
	int status           = 0;  ///< StatusCode
	int level            = -1; ///< of the mesh; -1 without one
	std::uint64_t digest = 0;  ///< fingerprint() of the mesh; 0 without one
};

/// The files written anew by today's encoder, with the outcome that they must have.
std::vector<Golden> makeGoldens();
/// Decodes golden.bytes and fills in what came out.
Golden outcomeOf(const Golden& golden);
/// The line of the index that stands for a golden: name, status, level, digest.
std::string indexLine(const Golden& golden);

Bytes readFile(const std::string& path); ///< throws if it cannot
void writeFile(const std::string& path, const Bytes& bytes);

} // namespace wavemesh::test
