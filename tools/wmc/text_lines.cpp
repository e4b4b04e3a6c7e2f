// SPDX-License-Identifier: GPL-3.0-or-later
#include "text_lines.h"

#include <algorithm>
#include <cstdlib>

namespace wavemesh::tool {

const std::vector<std::string_view>& TextLines::next()
{
	words_.clear();
	while (words_.empty() && at_ < text_.size()) {
		std::size_t end = text_.find('\n', at_);
		++line_;
		// A backslash at the end joins lines (OBJ).
		for (; end != text_.npos && end > at_ && text_[end - 1] == '\\'; ++line_)
			end = text_.find('\n', end + 1);
		split(text_.substr(at_, end == text_.npos ? end : end - at_));
		at_ = end == text_.npos ? text_.size() : end + 1;
	}
	return words_;
}

void TextLines::split(std::string_view line)
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

bool leadingInteger(std::string_view word, long long& value)
{
	const std::string s(word.substr(0, 24));
	char* end = nullptr;
	value     = std::strtoll(s.c_str(), &end, 10);
	return end != s.c_str();
}

bool leadingNumber(std::string_view word, double& value)
{
	const std::string s(word);
	char* end = nullptr;
	value     = std::strtod(s.c_str(), &end);
	return end != s.c_str();
}

} // namespace wavemesh::tool
