// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the fuzz targets share: a claim that ends the program where it does not hold, and choices
/// drawn from the input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace wavemesh::test {

/// Ends the program with `claim` unless `holds`.
inline void require(bool holds, const char* claim, const std::string& detail = {})
{
	if (holds)
		return;
	std::fprintf(stderr, "NOT TRUE: %s %s\n", claim, detail.c_str());
	std::abort();
}

/// Empty `trouble`, or the end of the program.
inline void requireNone(const std::string& trouble, const char* where)
{
	require(trouble.empty(), where, trouble);
}

/// Numbers from bytes, all zero behind their end.
class ByteSource
{
public:
	ByteSource(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}

	bool empty() const { return at_ == end_; }
	std::uint8_t byte() { return empty() ? std::uint8_t(0) : *at_++; }
	/// Little-endian.
	std::uint64_t word(int bytes)
	{
		std::uint64_t x = 0;
		for (int i = 0; i < bytes; ++i)
			x |= std::uint64_t(byte()) << (8 * i);
		return x;
	}
	/// 0..n-1, from as few bytes as that takes. @pre n > 0
	std::uint32_t below(std::uint32_t n)
	{
		return std::uint32_t(word(n <= 256 ? 1 : n <= 65536 ? 2 : 4) % n);
	}
	bool flag() { return (byte() & 1) != 0; }

private:
	const std::uint8_t* at_;
	const std::uint8_t* end_;
};

} // namespace wavemesh::test
