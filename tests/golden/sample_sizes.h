// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The sizes of the sample meshes' files in the paper's configurations and in the compact mode,
/// at 12 bits.
#pragma once

#include <wavemesh/codec.h>

#include <string>
#include <vector>

namespace wavemesh::test {

/// A binary little-endian PLY as samples/generate writes it: positions as floats, triangles.
MeshData readSamplePly(const std::string& path);

extern const std::vector<std::string> kSamples; ///< names without suffix

struct Configuration
{
	const char* name;
	Mode mode;
	int lifting;
	Wgc wgc;
	Optimize optimize;
	int effort;
};
/// I, II, III of the paper, and compact files by effort.
extern const std::vector<Configuration> kConfigurations;

EncodedMesh encodeSample(const MeshData& mesh, const Configuration& configuration);

} // namespace wavemesh::test
