// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What holds of decoding any bytes.
#pragma once

#include <cstddef>
#include <cstdint>

namespace wavemesh::test {

/// Ends the program unless a decoder of these bytes neither fails in itself nor takes more than it
/// was allowed, says the same every time, gives levels of the sizes that the head declares, is
/// at every cut where it was on its way there, and gives as a whole mesh one that the encoder takes
/// back and that comes out again.
void checkDecoding(const std::uint8_t* bytes, std::size_t size);

} // namespace wavemesh::test
