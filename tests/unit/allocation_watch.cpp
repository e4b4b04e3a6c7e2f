// SPDX-License-Identifier: GPL-3.0-or-later
#include "allocation_watch.h"

#include <cstdlib>
#include <new>

namespace {

std::size_t alive = 0, highest = 0, before = 0;
std::size_t untilFailure = 0; ///< allocations, that one too; 0: none fails

/// In front of each block: its size, padded to keep the alignment.
constexpr std::size_t kHeader = alignof(std::max_align_t);

} // namespace

// All forms, so that none of the standard library's own (or a sanitizer's) meets one of these.

void* operator new(std::size_t size, const std::nothrow_t&) noexcept
{
	if (untilFailure > 0 && --untilFailure == 0)
		return nullptr;
	auto* block = static_cast<char*>(std::malloc(size + kHeader));
	if (!block)
		return nullptr;
	*reinterpret_cast<std::size_t*>(block) = size;
	alive += size;
	highest = alive > highest ? alive : highest;
	return block + kHeader;
}

void* operator new(std::size_t size)
{
	if (void* p = operator new(size, std::nothrow))
		return p;
	throw std::bad_alloc();
}

void* operator new[](std::size_t size)
{
	return operator new(size);
}

void* operator new[](std::size_t size, const std::nothrow_t&) noexcept
{
	return operator new(size, std::nothrow);
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

void operator delete(void* p, const std::nothrow_t&) noexcept
{
	operator delete(p);
}

void operator delete[](void* p) noexcept
{
	operator delete(p);
}

void operator delete[](void* p, std::size_t) noexcept
{
	operator delete(p);
}

void operator delete[](void* p, const std::nothrow_t&) noexcept
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

AllocationFailure::AllocationFailure(std::size_t after)
{
	untilFailure = after + 1;
}

AllocationFailure::~AllocationFailure()
{
	end();
}

void AllocationFailure::end()
{
	untilFailure = 0;
}

} // namespace wavemesh::test
