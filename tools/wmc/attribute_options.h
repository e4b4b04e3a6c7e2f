// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Attributes as the command line has them: which to keep, and how many bits of them; their names.
#pragma once

#include <wavemesh/mesh_data.h>

#include <CLI/CLI.hpp>

#include <string>

namespace wavemesh::tool {

struct AttributeOptions
{
	std::string kept = "colour,quality,radius,texcoord,polygons,custom";
	std::string bits;

	void addTo(CLI::App& command);
	/// Of VcgChannel (wavemesh/vcg_attributes.h), combined. Throws UsageError.
	unsigned channels() const;
	/// @param exact  is what `bits` does not name to be exact? Throws UsageError.
	void setBits(MeshData& mesh, bool exact) const;
};

std::string nameOf(AttributeKind kind);
std::string nameOf(AttributeOf of);
std::string nameOf(NumberType type);
/// "vertex colour", "corner texcoord", "face custom 'depth'"
std::string nameOf(AttributeOf of, AttributeKind kind, const std::string& name);

} // namespace wavemesh::tool
