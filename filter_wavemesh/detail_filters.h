// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The two filters on the details of a layer's mesh, Colour by Detail and Equalise Detail: their
/// parameters, and what they do to the layer.
#pragma once

#include <wavemesh/detail_pyramid.h>

#include <common/ml_document/mesh_model.h>
#include <common/parameters/rich_parameter_list.h>

#include <QVariant>

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace wavemesh {

/// The details of the mesh that was decomposed last: live preview decomposes a mesh once.
class PyramidCache
{
public:
	/// @throws MLException if the mesh has no hierarchy (it is no manifold, ...)
	const DetailPyramid& of(const MeshModel& layer, Wgc wgc);

private:
	std::uint64_t fingerprint_ = 0;
	Wgc wgc_                   = Wgc::On;
	std::optional<DetailPyramid> pyramid_;
};

/// What a parameter list says of the geometrical criterion: off or on.
Wgc criterionOf(const RichParameterList& list);

void addDetailParameters(RichParameterList& list);

/// Gives every vertex its detail as quality and colours it by that, in MeshLab's own ramp.
/// @return minimum, maximum and mean of the quality, the range of the ramp, the number of levels
std::map<std::string, QVariant> colourByDetail(MeshModel& layer, const RichParameterList& list);

/// Five bands of levels.
constexpr int kBands = 5;

/// Level `level`, 1..finest, belongs to this band, 0 (coarsest) .. kBands - 1.
int bandOf(int level, int finest);

/// One gain for each band, the threshold, and gains by level for scripts.
/// @param finest  of the layer's hierarchy, for the labels; 0 if it has none
void addEqualiserParameters(RichParameterList& list, int finest);

/// Moves the vertices; normals and bounding box follow. A layer whose details stay as they are is
/// not touched.
/// @return the number of vertices moved and the largest displacement (model units)
std::map<std::string, QVariant>
equaliseDetail(MeshModel& layer, const DetailPyramid& pyramid, const RichParameterList& list);

} // namespace wavemesh
