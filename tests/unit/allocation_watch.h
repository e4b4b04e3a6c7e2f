// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Measures what operator new hands out. A program that links allocation_watch.cpp has it replaced.
#pragma once

#include <cstddef>

namespace wavemesh::test {

/// Counts from its construction on. One at a time, one thread.
class AllocationWatch
{
public:
	AllocationWatch();
	/// Most bytes alive at once since construction, without what was alive before.
	std::size_t peak() const;
};

} // namespace wavemesh::test
