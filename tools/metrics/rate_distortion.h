// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What the levels of a `.wmc` cost and are worth: rate-distortion curves (the paper's figure 7).
#pragma once

#include "surface_distance.h"

#include <wavemesh/codec.h>

#include <string>
#include <vector>

namespace wavemesh::metrics {

/// A way of encoding that reports compare with others.
struct Configuration
{
	std::string name;
	EncodeOptions options;
};

/// The configurations that a report compares, in order: the paper's I (lazy), II (lifting) and III
/// (lifting and WGC), and the compact mode.
/// @param base  all other options; its lifting gives the k of II and III (0 if it is off)
std::vector<Configuration> comparedConfigurations(const EncodeOptions& base);

/// One file: its head, and the distance of each of its levels from an original.
struct Curve
{
	std::string name;
	StreamInfo info;
	std::vector<SurfaceDistance> levels; ///< by level, relative to the original's diagonal
};

/// Decodes `file` level by level and measures each.
/// @return the curve without a name; for a file that is cut, up to its last whole level. An error
///         of the decoder, or Cancelled
Result<Curve> measureCurve(
    const std::vector<std::uint8_t>& file,
    const DistanceMeter& meter,
    const Progress& progress = {});

double bitsPerVertex(std::uint64_t bytes, std::uint64_t vertices);

/// The best level within `bpv` bits per vertex; null if not even the base mesh fits.
const SurfaceDistance* bestWithin(const Curve& curve, double bpv);

/// Bits per vertex of the first level with an RMS of at most `rms`; negative if there is none.
double rateFor(const Curve& curve, double rms);

std::string nameOf(LevelKind kind); ///< base, split, precise

/// A table for other programs: one line of names, then one for each level of each curve. `rms` and
/// `max` are fractions of the diagonal, `rms_units` and `max_units` model units.
/// @param diagonal  the meter's
std::string asCsv(const std::vector<Curve>& curves, double diagonal);

} // namespace wavemesh::metrics
