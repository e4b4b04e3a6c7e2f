// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Time and memory of a piece of work, measured in a process of its own.
#pragma once

#include <cstdint>
#include <functional>

namespace wavemesh::tool {

struct Measured
{
	bool ok                 = false;
	double seconds          = 0; ///< best of the runs
	std::uint64_t peakBytes = 0; ///< most memory held above what there was before
};

/// Runs `work` `runs` times in a child process. `work` returns false to give up. Its effects on
/// memory are lost with the child.
Measured measureInChild(int runs, const std::function<bool()>& work);

} // namespace wavemesh::tool
