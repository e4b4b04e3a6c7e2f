// SPDX-License-Identifier: GPL-3.0-or-later
// PLY: the head says what follows; walk through it all and look at the faces' indices.
#include "mesh_guard.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <sstream>
#include <vector>

namespace wavemesh::tool {

namespace {

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

/// Empty, or what is wrong.
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
			head.size = static_cast<std::size_t>(lines.tellg());
			return {};
		}
	}
	return "its head does not end";
}

/// Numbers one after the other, whatever they are written in.
class Numbers
{
public:
	Numbers(const Bytes& file, const Head& head) : file_(file), head_(head), at_(head.size) {}

	bool next(Type type, double& value)
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
	bool skip(std::uint64_t n, Type type)
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

private:
	bool nextWord(double& value)
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

	const Bytes& file_;
	const Head& head_;
	std::size_t at_;
};

std::string checkFaceList(Numbers& numbers, const Property& p, double count, double vertices)
{
	// The importer keeps the count in a byte.
	if (!(count >= 3 && count <= 255))
		return "a face with " + std::to_string(static_cast<long long>(count)) + " corners";
	for (int i = 0; i < static_cast<int>(count); ++i) {
		double v = 0;
		if (!numbers.next(p.item, v))
			return "it ends before its last face";
		if (!(v >= 0 && v < vertices))
			return "a face refers to a vertex that does not exist";
	}
	return {};
}

} // namespace

std::string whatIsWrongWithPly(const Bytes& file)
{
	Head head;
	if (std::string s = parseHead(file, head); !s.empty())
		return s;
	Numbers numbers(file, head);
	double vertices = 0, count = 0;
	for (const Element& e : head.elements) {
		const std::string shortFile = "it ends before its last " + e.name;
		if (e.properties.empty() && e.number > 0)
			return "its head is damaged";
		for (std::uint64_t i = 0; i < e.number; ++i)
			for (const Property& p : e.properties) {
				if (!p.isList) {
					if (!numbers.skip(1, p.item))
						return shortFile;
					continue;
				}
				if (!numbers.next(p.count, count) || !(count >= 0))
					return shortFile;
				const bool isFace =
				    e.name == "face" && (p.name == "vertex_indices" || p.name == "vertex_index");
				if (isFace) {
					if (std::string s = checkFaceList(numbers, p, count, vertices); !s.empty())
						return s;
				}
				else if (!numbers.skip(static_cast<std::uint64_t>(count), p.item))
					return shortFile;
			}
		if (e.name == "vertex")
			vertices = static_cast<double>(e.number);
	}
	return {};
}

} // namespace wavemesh::tool
