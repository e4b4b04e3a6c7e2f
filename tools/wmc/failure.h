// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How a command of the tool ends early. Caught in main() only.
#pragma once

#include <stdexcept>
#include <string>

namespace wavemesh::tool {

enum ExitCode {
	kFine    = 0,
	kRefused = 1, ///< refused input, corrupt or unreadable file, output that cannot be written
	kUsage   = 2,
};

/// Ends the program with kRefused and its one line on stderr.
struct Failure : std::runtime_error
{
	using std::runtime_error::runtime_error;
};

/// Ends the program with kUsage and its one line on stderr.
struct UsageError : std::runtime_error
{
	using std::runtime_error::runtime_error;
};

} // namespace wavemesh::tool
