// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Lines of a text and the words of a line: OFF, OBJ and STL.
#pragma once

#include "file_io.h"

#include <string>
#include <string_view>
#include <vector>

namespace wavemesh::tool {

class TextLines
{
public:
	/// @param file  must stay
	explicit TextLines(const Bytes& file) :
	        text_(reinterpret_cast<const char*>(file.data()), file.size())
	{
	}
	/// The words of the next line that has any and is no comment; empty at the end.
	const std::vector<std::string_view>& next();
	std::string where() const { return "line " + std::to_string(line_); }
	double fraction() const { return double(at_) / double(text_.size()); }

private:
	void split(std::string_view line);

	std::string_view text_;
	std::size_t at_     = 0;
	std::uint64_t line_ = 0;
	std::vector<std::string_view> words_;
};

/// The number that `word` begins with; false if it begins with none.
bool leadingInteger(std::string_view word, long long& value);
bool leadingNumber(std::string_view word, double& value);

} // namespace wavemesh::tool
