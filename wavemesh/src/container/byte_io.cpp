// SPDX-License-Identifier: GPL-3.0-or-later
#include "container/byte_io.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace wavemesh {

std::uint32_t checksum(const std::uint8_t* data, std::size_t size)
{
	return XXH32(data, size, 0);
}

} // namespace wavemesh
