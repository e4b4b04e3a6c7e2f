// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Little-endian bytes, variable-length integers and checksums. Writer and reader answer to the
/// same calls, so that a header is described once.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

namespace wavemesh {

/// XXH32 with seed 0.
std::uint32_t checksum(const std::uint8_t* data, std::size_t size);

class ByteWriter
{
public:
	static constexpr bool kReading = false;
	std::vector<std::uint8_t> bytes;

	template <class Int>
	void fixed(const Int& x)
	{
		for (std::size_t i = 0; i < sizeof(Int); ++i)
			bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(x) >> (8 * i)));
	}
	/// LEB128: seven bits a byte, the lowest first, the top bit set on all but the last.
	template <class Int>
	void varint(const Int& value)
	{
		std::uint64_t x = value;
		for (; x >= 128; x >>= 7)
			bytes.push_back(static_cast<std::uint8_t>(x | 128));
		bytes.push_back(static_cast<std::uint8_t>(x));
	}
	void real32(const double& x)
	{
		const float f = static_cast<float>(x);
		std::uint32_t u;
		std::memcpy(&u, &f, sizeof u);
		fixed(u);
	}
	void real64(const double& x)
	{
		std::uint64_t u;
		std::memcpy(&u, &x, sizeof u);
		fixed(u);
	}
	bool failed() const { return false; }
};

/// Reads within [data, data + size); past the end everything is zero and failed() is true.
class ByteReader
{
public:
	static constexpr bool kReading = true;

	ByteReader(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

	std::size_t position() const { return at_; }
	bool failed() const { return failed_; }

	std::uint8_t byte()
	{
		if (at_ == size_) {
			failed_ = true;
			return 0;
		}
		return data_[at_++];
	}
	template <class Int>
	void fixed(Int& x)
	{
		std::uint64_t u = 0;
		for (std::size_t i = 0; i < sizeof(Int); ++i)
			u |= std::uint64_t(byte()) << (8 * i);
		x = static_cast<Int>(u);
	}
	/// Fails for numbers that do not fit into Int.
	template <class Int>
	void varint(Int& x)
	{
		std::uint64_t u = 0;
		for (int shift = 0;; shift += 7) {
			const std::uint8_t b = byte();
			if (shift > 56 || (shift == 56 && b > 127)) {
				failed_ = true;
				break;
			}
			u |= std::uint64_t(b & 127) << shift;
			if (b < 128)
				break;
		}
		x       = static_cast<Int>(u);
		failed_ = failed_ || static_cast<std::uint64_t>(x) != u;
	}
	void real32(double& x)
	{
		std::uint32_t u;
		fixed(u);
		float f;
		std::memcpy(&f, &u, sizeof f);
		x = static_cast<double>(f);
	}
	void real64(double& x)
	{
		std::uint64_t u;
		fixed(u);
		std::memcpy(&x, &u, sizeof x);
	}

private:
	const std::uint8_t* data_;
	std::size_t size_;
	std::size_t at_ = 0;
	bool failed_    = false;
};

} // namespace wavemesh
