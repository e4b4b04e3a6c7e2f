// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the head says of attributes, both ways (docs/wmc_format.md, section 12.6).
#pragma once

#include "attributes/channel.h"
#include "container/byte_io.h"

namespace wavemesh {

template <class Io>
bool visitText(Io& io, std::string& text)
{
	std::uint64_t length = text.size();
	io.varint(length);
	if constexpr (Io::kReading)
		for (text.clear(); length > 0 && !io.failed(); --length)
			text.push_back(char(io.byte()));
	else
		for (const char c : text)
			io.fixed(std::uint8_t(c));
	return !io.failed();
}

/// An enumeration of up to 256 values as a byte.
template <class Io, class Enum>
void visitEnum(Io& io, Enum& value)
{
	std::uint8_t byte = std::uint8_t(value);
	io.fixed(byte);
	value = Enum(byte);
}

template <class Io>
bool visitColumn(Io& io, Column& column)
{
	std::uint8_t byte = std::uint8_t(column.bits | (column.whole ? 128 : 0));
	io.fixed(byte);
	column.bits  = byte & 127;
	column.whole = byte >= 128;
	if (column.bits > Column::kMostBits)
		return false;
	if (column.whole) {
		// The sign lowest.
		std::uint64_t low =
		    column.low < 0 ? 2 * std::uint64_t(-column.low) - 1 : 2 * std::uint64_t(column.low);
		io.varint(low);
		column.low = low & 1 ? -double(low / 2 + 1) : double(low / 2);
		return low < (std::uint64_t(1) << 55);
	}
	io.real64(column.low);
	io.real64(column.step);
	return std::isfinite(column.low) && column.step > 0 &&
	       std::isfinite(column.low + column.step * (1 << Column::kMostBits));
}

/// @return false if what is read is no channel
template <class Io>
bool visitChannel(Io& io, Channel& c)
{
	visitEnum(io, c.of);
	visitEnum(io, c.kind);
	visitEnum(io, c.type);
	std::uint8_t components = std::uint8_t(c.components);
	io.fixed(components);
	c.components = components;
	// 0: on lattices; 1..32: one more than wide + 2 * (digits + 1); 64 + bits of an octahedron.
	constexpr int kOctahedron = 64;
	std::uint8_t coding       = c.octahedron > 0 ? std::uint8_t(kOctahedron + c.octahedron)
	                            : c.onLattice()
	                                ? std::uint8_t(0)
	                                : std::uint8_t(1 + (c.exact.wide ? 1 : 0) + 2 * (c.exact.digits + 1));
	io.fixed(coding);
	if (c.of > AttributeOf::Mesh || c.type > NumberType::Double || components < 1 ||
	    components > Channel::kMostColumns)
		return false;
	if constexpr (Io::kReading) {
		if (coding == 0)
			c.columns.resize(components);
		else if (coding <= 2 + 2 * (NumberFormat::kMost + 1))
			c.exact = {(coding - 1) % 2 != 0, (coding - 1) / 2 - 1};
		else if (
		    coding >= kOctahedron + 2 && coding <= kOctahedron + Channel::kMostOctahedronBits &&
		    c.isNormal())
			c.octahedron = coding - kOctahedron;
		else
			return false;
	}
	for (Column& column : c.columns)
		if (!visitColumn(io, column))
			return false;
	io.varint(c.bytes);
	return visitText(io, c.name) && c.name.size() <= 255;
}

template <class Io>
bool visitAttributes(Io& io, std::vector<Channel>& channels, std::vector<std::string>& textures)
{
	std::uint32_t count = std::uint32_t(channels.size()), names = std::uint32_t(textures.size());
	io.varint(count);
	io.varint(names);
	if (count > Channel::kMost || names > 0xffff)
		return false;
	channels.resize(count);
	for (Channel& c : channels)
		if (!visitChannel(io, c))
			return false;
	for (std::uint32_t i = 0; i < names; ++i) {
		if constexpr (Io::kReading)
			textures.emplace_back();
		if (!visitText(io, textures[i]) || textures[i].size() > 0xffff)
			return false;
	}
	return !io.failed();
}

} // namespace wavemesh
