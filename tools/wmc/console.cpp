// SPDX-License-Identifier: GPL-3.0-or-later
#include "console.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <unistd.h>
#include <utility>

namespace wavemesh::tool {

namespace {

using Clock = std::chrono::steady_clock;

// Of the process: when it began, when the line was last drawn, and whether it is on the screen.
const Clock::time_point begin = Clock::now();
Clock::time_point lastDrawn;
bool isDrawn = false;

void wipe()
{
	if (isDrawn)
		std::fputs("\r\033[K", stderr);
	isDrawn = false;
}

/// Short work needs no progress; WMC_PROGRESS_AFTER tells otherwise, in milliseconds.
std::chrono::milliseconds patience()
{
	const char* text = std::getenv("WMC_PROGRESS_AFTER");
	return std::chrono::milliseconds(text ? std::strtoul(text, nullptr, 10) : 1000);
}

std::string formatted(const char* format, int digits, double x)
{
	char text[64];
	std::snprintf(text, sizeof text, format, digits, x);
	return text;
}

} // namespace

std::string visible(std::string text)
{
	for (char& c : text)
		if ((c >= 0 && c < ' ') || c == 127)
			c = '?';
	return text;
}

void warn(const std::string& line)
{
	wipe();
	std::fprintf(stderr, "wmc: warning: %s\n", visible(line).c_str());
}

void printError(const std::string& line)
{
	wipe();
	std::fprintf(stderr, "wmc: %s\n", visible(line).c_str());
}

ProgressLine::ProgressLine(std::string what) : what_(std::move(what)) {}

ProgressLine::~ProgressLine()
{
	wipe();
}

void ProgressLine::show(double fraction)
{
	static const bool onTerminal = ::isatty(STDERR_FILENO) != 0;
	static const auto wait       = patience();
	const auto now               = Clock::now();
	if (!onTerminal || now - begin < wait || now - lastDrawn < std::chrono::milliseconds(100))
		return;
	lastDrawn = now;
	isDrawn   = true;
	std::fprintf(
	    stderr, "\r\033[K%s %3.0f %%", what_.c_str(), 100 * std::clamp(fraction, 0.0, 1.0));
	std::fflush(stderr);
}

Progress ProgressLine::callback()
{
	return [this](double fraction) {
		show(fraction);
		return true;
	};
}

void Table::print() const
{
	std::vector<std::size_t> width;
	for (const auto& row : rows_) {
		width.resize(std::max(width.size(), row.size()));
		for (std::size_t i = 0; i < row.size(); ++i)
			width[i] = std::max(width[i], row[i].size());
	}
	for (const auto& row : rows_) {
		std::string line;
		for (std::size_t i = 0; i < row.size(); ++i) {
			const std::string space(width[i] - row[i].size(), ' ');
			line += i == 0 ? row[i] + space : "  " + space + row[i];
		}
		line.erase(line.find_last_not_of(' ') + 1);
		std::puts(visible(line).c_str());
	}
}

std::string fixed(double x, int digits)
{
	return formatted("%.*f", digits, x);
}

std::string significant(double x, int digits)
{
	return formatted("%.*g", digits, x);
}

std::string grouped(std::uint64_t n)
{
	std::string s = std::to_string(n);
	for (auto i = static_cast<std::ptrdiff_t>(s.size()) - 3; i > 0; i -= 3)
		s.insert(static_cast<std::size_t>(i), 1, ' ');
	return s;
}

std::string megabytes(std::uint64_t bytes)
{
	return fixed(static_cast<double>(bytes) / 1e6, 1) + " MB";
}

} // namespace wavemesh::tool
