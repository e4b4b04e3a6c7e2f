// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The head of a PLY, and the numbers behind it one after the other. Never reads past the file.
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
	std::vector<std::string> comments; ///< without the word; obj_info too
	std::size_t size = 0;
};

/// Throws Failure.
Head parseHead(const Bytes& file);

/// Numbers one after the other, whatever they are written in.
class Numbers
{
public:
	Numbers(const Bytes& file, const Head& head) : file_(file), head_(head), at_(head.size) {}

	/// False at the end of the file, or if it is no number.
	bool next(Type type, double& value);
	/// A row of `element`: of each property its number, or those of its list. False if there is no
	/// such row any more.
	bool nextRow(const Element& element, std::vector<std::vector<double>>& row);
	double fraction() const { return double(at_) / double(file_.size()); }

private:
	bool nextWord(Type type, double& value);

	const Bytes& file_;
	const Head& head_;
	std::size_t at_;
};

} // namespace wavemesh::tool::ply
