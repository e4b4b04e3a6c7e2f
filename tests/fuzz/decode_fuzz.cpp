// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Any bytes whatever, as they are.
#include "decode_checks.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
	wavemesh::test::checkDecoding(bytes, size);
	return 0;
}
