// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A damaged file with everything made right that would give the damage away at once: checksums,
/// lengths, counts and the finest level's digest. What the levels and the chunks behind them hold
/// is as the input has it.
#include "decode_checks.h"
#include "mended_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
	const auto file = wavemesh::test::mendedFile(bytes, size);
	wavemesh::test::checkDecoding(file.data(), file.size());
	return 0;
}
