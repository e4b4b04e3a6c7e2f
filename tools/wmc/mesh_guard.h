// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Looked at before VCGLib's importers see a file: they trust indices and counts, and on some
/// damaged files read outside their arrays or do not end.
#pragma once

#include "file_io.h"

#include <string>

namespace wavemesh::tool {

/// Empty, or what is wrong with the file. Indices in range, counts that the file can hold.
std::string whatIsWrongWithPly(const Bytes& file);
std::string whatIsWrongWithObj(const Bytes& file);
std::string whatIsWrongWithOff(const Bytes& file);
std::string whatIsWrongWithStl(const Bytes& file);

} // namespace wavemesh::tool
