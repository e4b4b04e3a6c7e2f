// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A die with a texture: seams along its edges.
#pragma once

#include <wavemesh/mesh_data.h>

#include <cstdint>
#include <string>
#include <vector>

namespace wavemesh::samples {

struct Texture
{
	int width = 0, height = 0;                        ///< pixels; the width a multiple of 4
	std::vector<std::array<std::uint8_t, 3>> colours; ///< four
	std::vector<std::uint8_t> pixels;                 ///< 0..3, row by row from the top
};

/// Closed, of genus 0, rounded, with a dent at each pip; texture coordinates of corners, a chart of
/// the texture for each side.
MeshData makeDie();
Texture dieTexture();

/// As a PNG file, not compressed: the same from every library.
std::string asPng(const Texture& texture);

} // namespace wavemesh::samples
