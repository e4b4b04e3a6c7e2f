// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The level table and the sizes of a file, as JSON and as text.
#pragma once

#include <metrics/rate_distortion.h>

#include <wavemesh/codec.h>

#include <nlohmann/json.hpp>

namespace wavemesh::tool {

using Json = nlohmann::ordered_json;

using metrics::bitsPerVertex;

/// What every command's JSON has: vertices, faces, bytes, bits_per_vertex, levels, the codec's
/// options, and encode_seconds and decode_seconds, null until a command measures them.
Json toJson(const StreamInfo& info);

/// The same for people, on stdout.
void printInfo(const StreamInfo& info);

/// The one object on stdout.
void printJson(const Json& object);

} // namespace wavemesh::tool
