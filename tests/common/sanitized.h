// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Is this a build with sanitizers, where everything takes ten times as long?
#pragma once

namespace wavemesh::test {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

} // namespace wavemesh::test
