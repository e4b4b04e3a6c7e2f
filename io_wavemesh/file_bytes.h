// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Whole files in and out.
#pragma once

#include <QString>

#include <cstdint>
#include <vector>

namespace wavemesh {

/// Reads the first `maxBytes` of a file, or all of it.
/// @throws MLException if there is no such file, if it cannot be read, or if it is larger than any
///         `.wmc` this version can decode
std::vector<std::uint8_t> readFile(const QString& name, std::uint64_t maxBytes);

/// Writes a file under a temporary name and renames it: afterwards it is there whole, or (with an
/// MLException) what was there before is untouched.
void writeFile(const QString& name, const std::vector<std::uint8_t>& bytes);

} // namespace wavemesh
