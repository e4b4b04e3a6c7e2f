// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the tool prints: warnings, a progress line, aligned tables.
#pragma once

#include <wavemesh/codec.h>

#include <string>
#include <vector>

namespace wavemesh::tool {

/// With no character that a terminal takes for a command: names come from files.
std::string visible(std::string text);

/// One line on stderr, after the progress line was wiped.
void warn(const std::string& line);
void printError(const std::string& line);

/// A line on stderr that tells what goes on: only on a terminal, and only once the program has
/// run for a second.
class ProgressLine
{
public:
	explicit ProgressLine(std::string what);
	~ProgressLine();
	ProgressLine(const ProgressLine&)            = delete;
	ProgressLine& operator=(const ProgressLine&) = delete;

	void show(double fraction); ///< 0..1
	Progress callback();        ///< for the codec; valid as long as this object

private:
	std::string what_;
};

/// Text columns, right aligned but the first.
class Table
{
public:
	explicit Table(std::vector<std::string> head) { rows_.push_back(std::move(head)); }
	void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
	void print() const; ///< on stdout

private:
	std::vector<std::vector<std::string>> rows_;
};

std::string fixed(double x, int digits);       ///< 12.50
std::string significant(double x, int digits); ///< 0.0125, 1.3e-05
std::string grouped(std::uint64_t n);          ///< 1 234 567
std::string megabytes(std::uint64_t bytes);    ///< 12.3 MB

} // namespace wavemesh::tool
