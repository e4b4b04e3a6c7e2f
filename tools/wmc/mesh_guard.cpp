// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_guard.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <vector>

namespace wavemesh::tool {

namespace {

/// Lines of a text and the words of a line.
class Text
{
public:
	explicit Text(const Bytes& file) :
	        text_(reinterpret_cast<const char*>(file.data()), file.size())
	{
	}
	/// The words of the next line that has any and is no comment; empty at the end.
	const std::vector<std::string_view>& nextLine()
	{
		words_.clear();
		while (words_.empty() && at_ < text_.size()) {
			std::size_t end = text_.find('\n', at_);
			// A backslash at the end joins lines (OBJ).
			while (end != text_.npos && end > at_ && text_[end - 1] == '\\')
				end = text_.find('\n', end + 1);
			split(text_.substr(at_, end == text_.npos ? end : end - at_));
			at_ = end == text_.npos ? text_.size() : end + 1;
			++line_;
		}
		return words_;
	}
	std::string where() const { return "line " + std::to_string(line_); }

private:
	void split(std::string_view line)
	{
		constexpr std::string_view space = " \t\r\n\\\v\f";
		for (std::size_t i = 0; (i = line.find_first_not_of(space, i)) != line.npos;) {
			if (line[i] == '#')
				return;
			const std::size_t end = std::min(line.find_first_of(space, i), line.size());
			words_.push_back(line.substr(i, end - i));
			i = end;
		}
	}

	std::string_view text_;
	std::size_t at_     = 0;
	std::uint64_t line_ = 0;
	std::vector<std::string_view> words_;
};

/// The integer that `word` begins with; false if it begins with none.
bool leadingInteger(std::string_view word, long long& value)
{
	const std::string s(word.substr(0, 24));
	char* end = nullptr;
	value     = std::strtoll(s.c_str(), &end, 10);
	return end != s.c_str();
}

bool isNumber(std::string_view word)
{
	const std::string s(word);
	char* end = nullptr;
	std::strtod(s.c_str(), &end);
	return end != s.c_str();
}

/// The importer counts vertices by the look of raw lines before it reads them: an indented one is
/// read, and stored past the end. And it looks for the last character of an empty line after `\\`.
std::string whatIsWrongWithObjLines(const Bytes& file)
{
	const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
	std::uint64_t number = 0;
	bool wasJoined       = false;
	for (std::size_t at = 0; at <= text.size(); ++number) {
		const std::size_t end = std::min(text.find('\n', at), text.size());
		std::string_view line = text.substr(at, end - at);
		at                    = end + 1;
		if (wasJoined && (line.empty() || line == "\r"))
			return "line " + std::to_string(number) + " continues on an empty line";
		const std::size_t first = line.find_first_not_of(" \t\r");
		const bool isVertex     = first != line.npos && line[first] == 'v' &&
		                      (first + 1 == line.size() || line[first + 1] == ' ' ||
		                       line[first + 1] == '\t' || line[first + 1] == '\r');
		if (isVertex && (first > 0 || wasJoined))
			return "line " + std::to_string(number + 1) + ": a vertex must begin its line";
		if (!line.empty() && line.back() == '\r')
			line.remove_suffix(1);
		wasJoined = !line.empty() && line.back() == '\\';
	}
	return {};
}

} // namespace

std::string whatIsWrongWithObj(const Bytes& file)
{
	if (std::string s = whatIsWrongWithObjLines(file); !s.empty())
		return s;
	Text text(file);
	long long vertices = 0;
	while (true) {
		const auto& words = text.nextLine();
		if (words.empty())
			return {};
		if (words[0] == "v") {
			if (words.size() < 4 || !isNumber(words[1]) || !isNumber(words[2]) ||
			    !isNumber(words[3]))
				return text.where() + " is not a vertex";
			++vertices;
		}
		const bool zeroBased = words[0] == "q";
		if (words[0] != "f" && !zeroBased)
			continue;
		if (words.size() < 4)
			return text.where() + ": a face with fewer than three corners";
		for (std::size_t i = 1; i < words.size(); ++i) {
			long long v = 0;
			if (!leadingInteger(words[i], v))
				return text.where() + " is not a face";
			v = zeroBased ? v : v > 0 ? v - 1 : v == 0 ? -1 : v + vertices;
			if (v < 0 || v >= vertices)
				return text.where() + ": a face refers to a vertex that does not exist";
		}
	}
}

std::string whatIsWrongWithOff(const Bytes& file)
{
	Text text(file);
	std::vector<std::string_view> head = text.nextLine();
	if (head.empty() || head[0].size() < 3 || head[0].substr(head[0].size() - 3) != "OFF")
		return "it does not begin with OFF";
	const bool onePerLine = head[0].size() > 3;
	head.erase(head.begin());
	if (head.empty())
		head = text.nextLine();
	long long vertices = 0, faces = 0;
	if (head.size() < 3 || !leadingInteger(head[0], vertices) || !leadingInteger(head[1], faces) ||
	    vertices < 0 || faces < 0)
		return "it does not tell how many vertices and faces it has";
	for (std::size_t have = 0, want = static_cast<std::size_t>(vertices) * (onePerLine ? 1 : 3);
	     have < want;) {
		const auto& words = text.nextLine();
		if (words.empty())
			return "it ends before its last vertex";
		for (std::size_t i = 0; i < (onePerLine ? 3 : words.size()); ++i)
			if (i >= words.size() || !isNumber(words[i]))
				return text.where() + " is not a vertex";
		have += onePerLine ? 1 : words.size();
		if (have > want)
			return text.where() + ": more coordinates than vertices";
	}
	for (long long f = 0; f < faces; ++f) {
		const auto& words = text.nextLine();
		long long corners = 0;
		if (words.empty())
			return "it ends before its last face";
		if (!leadingInteger(words[0], corners) || corners < 3 ||
		    words.size() <= static_cast<std::size_t>(corners))
			return text.where() + " is not a face";
		if (corners > 4)
			return text.where() + ": a polygon of more than four corners; triangulate it first";
		for (std::size_t i = 1; i <= static_cast<std::size_t>(corners); ++i) {
			long long v = 0;
			if (!leadingInteger(words[i], v) || v < 0 || v >= vertices)
				return text.where() + ": a face refers to a vertex that does not exist";
		}
	}
	return {};
}

std::string whatIsWrongWithStl(const Bytes& file)
{
	constexpr std::size_t kHead = 84, kFacet = 50;
	if (file.size() >= kHead) {
		std::uint32_t facets = 0;
		std::memcpy(&facets, file.data() + 80, 4);
		if (file.size() == kHead + kFacet * std::size_t {facets})
			return {};
	}
	const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
	if (text.substr(0, 5) != "solid" ||
	    std::any_of(file.begin(), file.end(), [](std::uint8_t c) { return c == 0 || c > 126; }))
		return "it is not text, and its length is not that of the facets it declares";
	if (text.find("endsolid") == text.npos || text.find('\n') == text.npos)
		return "it ends before 'endsolid'";
	return {};
}

} // namespace wavemesh::tool
