// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The manual page, made of what --help is made of.
#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace wavemesh::tool {

/// wmc(1) in man's macros: every command of `app` with its arguments and options.
std::string manPage(const CLI::App& app, const std::string& version);

} // namespace wavemesh::tool
