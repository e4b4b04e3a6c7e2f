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

/// Has one allocation fail: the one behind `after` others. One at a time, one thread.
class AllocationFailure
{
public:
	explicit AllocationFailure(std::size_t after);
	~AllocationFailure();
	void end();
};

} // namespace wavemesh::test
