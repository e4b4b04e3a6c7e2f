// SPDX-License-Identifier: GPL-3.0-or-later
#include "allocation_watch.h"

#include <cstdlib>
#include <new>

namespace {

std::size_t alive = 0, highest = 0, before = 0;

/// In front of each block: its size, padded to keep the alignment.
constexpr std::size_t kHeader = alignof(std::max_align_t);

} // namespace

void* operator new(std::size_t size)
{
	auto* block = static_cast<char*>(std::malloc(size + kHeader));
	if (!block)
		throw std::bad_alloc();
	*reinterpret_cast<std::size_t*>(block) = size;
	alive += size;
	highest = alive > highest ? alive : highest;
	return block + kHeader;
}

void operator delete(void* p) noexcept
{
	if (!p)
		return;
	char* block = static_cast<char*>(p) - kHeader;
	alive -= *reinterpret_cast<std::size_t*>(block);
	std::free(block);
}

void operator delete(void* p, std::size_t) noexcept
{
	operator delete(p);
}

namespace wavemesh::test {

AllocationWatch::AllocationWatch()
{
	before = highest = alive;
}

std::size_t AllocationWatch::peak() const
{
	return highest - before;
}

} // namespace wavemesh::test
