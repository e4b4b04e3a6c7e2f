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
	double seconds          = 0; ///< on the clock, best of the runs
	double cpuSeconds       = 0; ///< processor time, best of the runs: others do not slow it
	std::uint64_t peakBytes = 0; ///< most memory held above what there was before
};

/// Runs `work` `runs` times in a child process, after `warmUp`, which should touch the same code on
/// next to no data: what it leaves is not counted as memory. `work` returns false to give up. What
/// both do to memory is lost with the child.
Measured
measureInChild(int runs, const std::function<void()>& warmUp, const std::function<bool()>& work);

} // namespace wavemesh::tool
