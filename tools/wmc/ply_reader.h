// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// PLY without VCGLib: the head, and the numbers behind it one after the other.
#pragma once

#include "file_io.h"

#include <string>
#include <vector>

namespace wavemesh::tool::ply {

struct Type
{
	int bytes       = 0;
	bool isFloating = false;
	bool isSigned   = false;
};

struct Property
{
	std::string name;
	bool isList = false;
	Type count;
	Type item;
};

struct Element
{
	std::string name;
	std::uint64_t number = 0;
	std::vector<Property> properties;
};

struct Head
{
	enum { Text, Little, Big } encoding = Text;
	std::vector<Element> elements;
	std::size_t size = 0;
};

/// Empty, or what is wrong.
std::string parseHead(const Bytes& file, Head& head);

/// Numbers one after the other, whatever they are written in.
class Numbers
{
public:
	Numbers(const Bytes& file, const Head& head) : file_(file), head_(head), at_(head.size) {}

	bool next(Type type, double& value);
	bool skip(std::uint64_t n, Type type);

private:
	bool nextWord(double& value);

	const Bytes& file_;
	const Head& head_;
	std::size_t at_;
};

/// The file as VCGLib reads it right: little-endian, with lists of vertices of the types it
/// expects. Empty if it is so already, or cannot be.
/// @pre whatIsWrongWithPly(file) is empty
Bytes withUsualTypes(const Bytes& file);

/// Names of textures, blanks inside included.
std::vector<std::string> textureNames(const Bytes& file, const Head& head);

/// Is it the list of a face's vertices?
inline bool isFaceList(const Element& e, const Property& p)
{
	return p.isList && e.name == "face" && (p.name == "vertex_indices" || p.name == "vertex_index");
}

} // namespace wavemesh::tool::ply
