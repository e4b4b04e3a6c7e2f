// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The plain arrays that cross the codec's border.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace wavemesh {

/// What an attribute belongs to.
enum class AttributeOf : std::uint8_t {
	Vertex = 0,
	Face   = 1,
	Corner = 2, ///< of a face; three rows a face
	Mesh   = 3, ///< one row
};

/// What an attribute means. The numbers are stable; a reader keeps those that it does not know.
enum class AttributeKind : std::uint8_t {
	Custom    = 0, ///< by name
	Colour    = 1, ///< red, green, blue, alpha, 0..255
	Normal    = 2,
	Quality   = 3,
	TexCoord  = 4, ///< u, v, number of the texture
	Radius    = 5,
	Selected  = 6, ///< 0 or 1
	FauxEdges = 7, ///< bit k: the edge from corner k to the next is inside a polygon
	Transform = 8, ///< 4 by 4, by rows
};

/// What numbers an attribute holds. All are kept exactly, unless Attribute::bits says otherwise.
enum class NumberType : std::uint8_t {
	Integer = 0, ///< magnitude up to 2^53
	Float   = 1, ///< values of 32-bit floats
	Double  = 2,
};

/// Attribute::bits that leave nothing to be seen for most: steps of half a texel of a 2048
/// pixel texture, a quarter of a degree at most. 0, exact, for what has a meaning of its own.
constexpr int usualBits(AttributeKind kind)
{
	switch (kind) {
	case AttributeKind::TexCoord:
		return 12;
	case AttributeKind::Normal:
		return 10;
	case AttributeKind::Quality:
	case AttributeKind::Radius:
		return 16;
	default:
		return 0;
	}
}

struct Attribute
{
	AttributeOf of     = AttributeOf::Vertex;
	AttributeKind kind = AttributeKind::Custom;
	NumberType type    = NumberType::Float;
	int components     = 1; ///< 1..16 numbers a row
	std::string name;       ///< up to 255 bytes; may be empty
	/// 0: every number is kept. 1..24: columns that hold other than whole numbers are rounded to
	/// 2^bits - 1 steps over the largest of their ranges, each by half a step at most.
	int bits = 0;
	/// #rows by `components`, row after row: number k of row r is values[r * components + k]. Rows
	/// are those of MeshData: vertex r, face r, corner r % 3 of face r / 3, or one row.
	std::vector<double> values;
};

/// A triangle mesh as arrays. Faces are oriented counter-clockwise seen from outside.
struct MeshData
{
	std::vector<std::array<double, 3>> positions {};        ///< #V by 3, model units
	std::vector<std::array<std::uint32_t, 3>> triangles {}; ///< #F by 3, rows of `positions`
	std::vector<Attribute> attributes {};                   ///< up to 64
	std::vector<std::string> textures {};                   ///< names, up to 65535 of as many bytes
};

} // namespace wavemesh
