// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The codec's options as the command line has them, and its answers as messages.
#pragma once

#include "file_io.h"

#include <metrics/rate_distortion.h>

#include <wavemesh/codec.h>

#include <CLI/CLI.hpp>

#include <string>

namespace wavemesh::tool {

/// Options of encode, report and bench, as typed.
/// For options that are unsigned: CLI11 takes -1 for the largest of all.
CLI::Validator notNegative();

struct CodecOptions
{
	int bits         = 12;
	double step      = 0;
	std::string mode = "compact";
	int effort       = 2;
	std::string lifting; ///< empty: not given
	std::string optimize = "balanced";
	std::string wgc      = "auto";
	double sharpness     = 0.3;
	double deviation     = 0.25;
	bool exact           = false;
	bool keepOrder       = false;

	void addTo(CLI::App& command);
	/// Throws UsageError where options contradict each other.
	EncodeOptions toEncodeOptions() const;
};

using metrics::nameOf; // of a LevelKind
std::string nameOf(Mode mode);
std::string nameOf(Optimize optimize);
std::string nameOfLifting(int lifting);           ///< off, 0, 1, 2
std::string nameOf(const EncodeOptions& options); ///< one line for people

/// `path: what the codec says`, with the offset if there is one.
std::string messageOf(const std::string& path, const Status& status);

/// Encodes with a progress line. Throws Failure.
EncodedMesh encodeMesh(
    const std::string& path,
    const MeshData& mesh,
    const EncodeOptions& options,
    double* seconds = nullptr);

/// For files made here, or whose mesh is at hand: no limits.
DecodeOptions ofOwnFile();

/// Decodes with a progress line. Throws Failure if there is no mesh at all.
Result<DecodedMesh> decodeBytes(
    const std::string& path,
    const Bytes& bytes,
    DecodeOptions options = {},
    double* seconds       = nullptr);

} // namespace wavemesh::tool
