// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Damaged files whose damage lies deep.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace wavemesh::test {

/// The file with right checksums, a head that declares what its chunks hold and its levels turn out
/// to be, as far as that can be, and the right digest of the finest level. Chunks that are cut end
/// where the file does. The byte behind the last chunk, if there is one, tells which features to
/// leave out (bit i: feature i).
std::vector<std::uint8_t> mendedFile(const std::uint8_t* bytes, std::size_t size);

} // namespace wavemesh::test
