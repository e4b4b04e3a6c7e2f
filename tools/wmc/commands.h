// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The commands of wmc. Each addX() declares its command line; the command runs, once the line is
/// parsed, as the function left in `chosen`, which returns the exit code.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace wavemesh::tool {

using Command = std::function<int()>;

void addEncode(CLI::App& app, Command& chosen);
void addDecode(CLI::App& app, Command& chosen);
void addInfo(CLI::App& app, Command& chosen);
void addVerify(CLI::App& app, Command& chosen);
void addReport(CLI::App& app, Command& chosen);
void addBench(CLI::App& app, Command& chosen);

} // namespace wavemesh::tool
