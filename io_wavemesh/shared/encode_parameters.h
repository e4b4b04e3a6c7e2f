// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How a mesh is to be encoded: the parameters, the same in the save dialog and in the filters.
#pragma once

#include <wavemesh/codec.h>

#include <common/parameters/rich_parameter_list.h>

namespace wavemesh {

/// Which of the parameters are not in a dialog's advanced part.
enum class Offered {
	All,
	Method,   ///< all but bits, step and aim
	Precision ///< bits alone
};

/// Appends the parameters to `list`, with the values of `defaults`.
void addEncodeParameters(
    RichParameterList& list, const EncodeOptions& defaults, Offered offered = Offered::All);

/// Appends what a file may promise besides its lattice: exact coordinates, the order.
void addPromiseParameters(RichParameterList& list);

/// Appends how precisely attributes are kept.
void addAttributeParameters(RichParameterList& list);

/// Sets the bits of the attributes of `mesh` as these parameters say.
/// @param exact  keep them all
/// @throws MLException naming the parameter that is out of range
void setAttributeBits(const RichParameterList& list, bool exact, MeshData& mesh);

/// Reads them back, the promises too; what a script leaves out keeps the value of `defaults`.
/// @throws MLException naming the parameter that is out of range
EncodeOptions encodeOptions(const RichParameterList& list, const EncodeOptions& defaults);

} // namespace wavemesh
