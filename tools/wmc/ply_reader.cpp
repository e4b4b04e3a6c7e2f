// SPDX-License-Identifier: GPL-3.0-or-later
#include "ply_reader.h"

#include "failure.h"

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

Head parseHead(const Bytes& file)
{
	const std::string text(
	    reinterpret_cast<const char*>(file.data()), std::min<std::size_t>(file.size(), 1 << 16));
	std::istringstream lines(text);
	const Failure damaged("its head is damaged");
	Head head;
	std::string line;
	bool hasFormat = false;
	if (!std::getline(lines, line) || line.substr(0, line.find_last_not_of(" \t\r") + 1) != "ply")
		throw Failure("it does not begin with 'ply'");
	while (std::getline(lines, line)) {
		std::istringstream words(line);
		std::string key, a, b;
		words >> key >> std::ws;
		if (key == "format" && words >> a) {
			hasFormat     = a == "ascii" || a == "binary_big_endian" || a == "binary_little_endian";
			head.encoding = a == "ascii"               ? Head::Text
			                : a == "binary_big_endian" ? Head::Big
			                                           : Head::Little;
		}
		else if (key == "comment" || key == "obj_info") {
			std::getline(words, a);
			head.comments.push_back(a.substr(0, a.find_last_not_of(" \t\r") + 1));
		}
		else if (key == "element") {
			Element e;
			long long n = -1;
			if (!(words >> e.name >> n) || n < 0 || n > 0x7fffffff)
				throw damaged;
			e.number = static_cast<std::uint64_t>(n);
			head.elements.push_back(e);
		}
		else if (key == "property") {
			Property p;
			words >> a;
			p.isList = a == "list";
			if (p.isList)
				words >> b >> a;
			if (head.elements.empty() || !(words >> p.name) ||
			    (p.isList && (!findType(b, p.count) || p.count.isFloating)) || !findType(a, p.item))
				throw damaged;
			head.elements.back().properties.push_back(p);
		}
		else if (key == "end_header" && hasFormat) {
			for (const Element& e : head.elements)
				if (e.properties.empty() && e.number > 0)
					throw damaged;
			head.size = lines.eof() ? text.size() : static_cast<std::size_t>(lines.tellg());
			return head;
		}
		else if (!key.empty())
			throw damaged;
	}
	throw Failure("its head does not end");
}

bool Numbers::next(Type type, double& value)
{
	if (head_.encoding == Head::Text)
		return nextWord(type, value);
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

bool Numbers::nextRow(const Element& element, std::vector<std::vector<double>>& row)
{
	row.resize(element.properties.size());
	for (std::size_t i = 0; i < row.size(); ++i) {
		const Property& p   = element.properties[i];
		const int leastSize = head_.encoding == Head::Text ? 1 : p.item.bytes;
		double count        = 1;
		if (p.isList && (!next(p.count, count) ||
		                 !(count >= 0 && count * leastSize <= double(file_.size() - at_))))
			return false;
		row[i].resize(static_cast<std::size_t>(count));
		for (double& x : row[i])
			if (!next(p.item, x))
				return false;
	}
	return true;
}

bool Numbers::nextWord(Type type, double& value)
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
	value     = type.isFloating && type.bytes == 4 ? double(std::strtof(word, &end))
	                                               : std::strtod(word, &end);
	return n > 0 && end != word;
}

} // namespace wavemesh::tool::ply
