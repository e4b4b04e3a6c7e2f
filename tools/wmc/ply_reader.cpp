// SPDX-License-Identifier: GPL-3.0-or-later
#include "ply_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <sstream>

namespace wavemesh::tool::ply {
namespace {

bool findType(const std::string& name, Type& type)
{
	static const std::map<std::string, Type> types = {
	    {"char", {1, false, true}},   {"uchar", {1, false, false}},  {"int8", {1, false, true}},
	    {"uint8", {1, false, false}}, {"short", {2, false, true}},   {"ushort", {2, false, false}},
	    {"int16", {2, false, true}},  {"uint16", {2, false, false}}, {"int", {4, false, true}},
	    {"uint", {4, false, false}},  {"int32", {4, false, true}},   {"uint32", {4, false, false}},
	    {"float", {4, true, true}},   {"double", {8, true, true}},   {"float32", {4, true, true}},
	    {"float64", {8, true, true}}};
	const auto i = types.find(name);
	if (i != types.end())
		type = i->second;
	return i != types.end();
}

} // namespace

std::string parseHead(const Bytes& file, Head& head)
{
	const std::string text(
	    reinterpret_cast<const char*>(file.data()), std::min<std::size_t>(file.size(), 1 << 16));
	std::istringstream lines(text);
	std::string line;
	bool isFirst = true;
	while (std::getline(lines, line)) {
		std::istringstream words(line);
		std::string key, a, b, c;
		words >> key;
		if (isFirst && key != "ply")
			return "it does not begin with 'ply'";
		isFirst = false;
		if (key == "format") {
			words >> a;
			head.encoding = a == "ascii"               ? Head::Text
			                : a == "binary_big_endian" ? Head::Big
			                                           : Head::Little;
		}
		else if (key == "element") {
			Element e;
			long long n = -1;
			if (!(words >> e.name >> n) || n < 0 || n > 0x7fffffff)
				return "its head is damaged";
			e.number = static_cast<std::uint64_t>(n);
			head.elements.push_back(e);
		}
		else if (key == "property") {
			Property p;
			words >> a;
			p.isList = a == "list";
			if (p.isList)
				words >> b >> c;
			if (head.elements.empty() || !(words >> p.name) ||
			    (p.isList && (!findType(b, p.count) || p.count.isFloating)) ||
			    !findType(p.isList ? c : a, p.item))
				return "its head is damaged";
			head.elements.back().properties.push_back(p);
		}
		else if (key == "end_header") {
			head.size = lines.eof() ? text.size() : static_cast<std::size_t>(lines.tellg());
			return {};
		}
	}
	return "its head does not end";
}

namespace {

constexpr Type kUchar {1, false, false}, kInt {4, false, true};

bool isSame(Type a, Type b)
{
	return a.bytes == b.bytes && a.isFloating == b.isFloating && a.isSigned == b.isSigned;
}

void append(Bytes& out, Type type, double value)
{
	std::uint64_t bits = 0;
	if (type.isFloating && type.bytes == 4) {
		const auto single = static_cast<float>(value);
		std::memcpy(&bits, &single, sizeof single);
	}
	else if (type.isFloating)
		std::memcpy(&bits, &value, sizeof value);
	else // a text may have anything
		bits = static_cast<std::uint64_t>(
		    std::isnan(value) ? 0 : static_cast<std::int64_t>(std::clamp(value, -1e18, 1e18)));
	for (int i = 0; i < type.bytes; ++i)
		out.push_back(static_cast<std::uint8_t>(bits >> 8 * i));
}

bool hasUsualTypes(const Head& head)
{
	for (const Element& e : head.elements)
		for (const Property& p : e.properties)
			if (isFaceList(e, p) && !(isSame(p.count, kUchar) && isSame(p.item, kInt)))
				return false;
	return head.encoding != Head::Big;
}

/// The head's text with another encoding and other types of the lists of vertices.
std::string usualHead(const Bytes& file, const Head& head)
{
	std::istringstream lines(
	    std::string(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(head.size)));
	std::string out, element;
	for (std::string line; std::getline(lines, line);) {
		std::istringstream words(line);
		std::string key, a, name;
		words >> key >> a;
		if (key == "element")
			element = a;
		for (std::string word; words >> word;)
			name = word;
		const bool isVertices = name == "vertex_indices" || name == "vertex_index";
		if (key == "format")
			line = "format binary_little_endian 1.0";
		else if (key == "property" && a == "list" && element == "face" && isVertices)
			line = "property list uchar int vertex_indices";
		else if (!line.empty() && line.back() == '\r')
			line.pop_back();
		out += line + "\n";
	}
	return out;
}

} // namespace

Bytes withUsualTypes(const Bytes& file)
{
	Head head;
	if (!parseHead(file, head).empty() || hasUsualTypes(head))
		return {};
	const std::string text = usualHead(file, head);
	Bytes out(text.begin(), text.end());
	Numbers numbers(file, head);
	for (const Element& e : head.elements)
		for (std::uint64_t row = 0; row < e.number; ++row)
			for (const Property& p : e.properties) {
				const bool isFace = isFaceList(e, p);
				double n = 1, value = 0;
				if (p.isList) {
					if (!numbers.next(p.count, n) || n < 0 || (isFace && n > 255))
						return {};
					append(out, isFace ? kUchar : p.count, n);
				}
				for (; n >= 1; --n) {
					if (!numbers.next(p.item, value))
						return {};
					append(out, isFace ? kInt : p.item, value);
				}
			}
	return out;
}

std::vector<std::string> textureNames(const Bytes& file, const Head& head)
{
	std::istringstream lines(
	    std::string(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(head.size)));
	std::vector<std::string> names;
	for (std::string line; std::getline(lines, line);) {
		std::istringstream words(line);
		std::string comment, key, name;
		words >> comment >> key >> std::ws;
		if (comment != "comment" || key != "TextureFile" || !std::getline(words, name))
			continue;
		name.erase(name.find_last_not_of(" \t\r") + 1);
		names.push_back(name);
	}
	return names;
}

bool Numbers::next(Type type, double& value)
{
	if (head_.encoding == Head::Text)
		return nextWord(value);
	const auto n = static_cast<std::size_t>(type.bytes);
	if (file_.size() - at_ < n)
		return false;
	std::uint8_t raw[8] = {};
	for (std::size_t i = 0; i < n; ++i) // as a little-endian machine has them
		raw[i] = file_[at_ + (head_.encoding == Head::Big ? n - 1 - i : i)];
	at_ += n;
	std::uint64_t bits = 0;
	for (std::size_t i = n; i-- > 0;)
		bits = bits << 8 | raw[i];
	if (type.isFloating) {
		float single = 0;
		std::memcpy(&single, raw, sizeof single);
		std::memcpy(&value, raw, sizeof value);
		value = n == 4 ? single : value;
	}
	else {
		value = static_cast<double>(bits);
		if (type.isSigned && bits >> (8 * n - 1))
			value -= std::ldexp(1.0, static_cast<int>(8 * n));
	}
	return true;
}

bool Numbers::skip(std::uint64_t n, Type type)
{
	double ignored = 0;
	if (head_.encoding == Head::Text) {
		while (n-- > 0)
			if (!nextWord(ignored))
				return false;
		return true;
	}
	const auto bytes = static_cast<std::uint64_t>(type.bytes);
	if (n > (file_.size() - at_) / bytes)
		return false;
	at_ += static_cast<std::size_t>(n * bytes);
	return true;
}

bool Numbers::nextWord(double& value)
{
	auto isSpace = [&](std::uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
	while (at_ < file_.size() && isSpace(file_[at_]))
		++at_;
	char word[64];
	std::size_t n = 0;
	while (at_ < file_.size() && !isSpace(file_[at_])) {
		if (n + 1 < sizeof word)
			word[n++] = static_cast<char>(file_[at_]);
		++at_;
	}
	word[n]   = 0;
	char* end = word;
	value     = std::strtod(word, &end);
	return n > 0 && end != word;
}

} // namespace wavemesh::tool::ply
