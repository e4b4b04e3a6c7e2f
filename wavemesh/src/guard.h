// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Memory that runs out, as every public function reports it.
#pragma once

#include <wavemesh/status.h>

#include <new>
#include <stdexcept>

namespace wavemesh {

/// @param work     returns what a Status converts to
/// @param forWhat  one in a user's words; called only if the memory is not enough
template <class Work, class Name>
auto guarded(const Work& work, const Name& forWhat) -> decltype(work())
{
	try {
		return work();
	}
	catch (const std::bad_alloc&) {
	}
	catch (const std::length_error&) { // more than a vector can ever hold
	}
	return Status(StatusCode::OutOfMemory, std::string("not enough memory ") + forWhat());
}

} // namespace wavemesh
