// SPDX-License-Identifier: GPL-3.0-or-later
#include "info_json.h"

#include "attribute_options.h"
#include "codec_options.h"
#include "console.h"

#include <cstdio>

namespace wavemesh::tool {

Json toJson(const StreamInfo& info)
{
	const std::uint64_t attributes = info.features.attributeBytes;
	const std::uint64_t other =
	    info.bytes - info.connectivityBytes - info.geometryBytes - attributes;
	Json j;
	j["version"]  = std::to_string(info.versionMajor) + "." + std::to_string(info.versionMinor);
	j["mode"]     = nameOf(info.mode);
	j["lifting"]  = nameOfLifting(info.lifting);
	j["wgc"]      = info.wgc ? "on" : "off";
	j["bits"]     = info.bits;
	j["step"]     = info.step;
	j["origin"]   = info.origin;
	j["vertices"] = info.vertices;
	j["faces"]    = info.faces;
	j["bytes"]    = info.bytes;
	j["bits_per_vertex"] = {
	    {"total", bitsPerVertex(info.bytes, info.vertices)},
	    {"connectivity", bitsPerVertex(info.connectivityBytes, info.vertices)},
	    {"geometry", bitsPerVertex(info.geometryBytes, info.vertices)},
	    {"attributes", bitsPerVertex(attributes, info.vertices)},
	    {"other", bitsPerVertex(other, info.vertices)}};
	const StreamFeatures& f = info.features;
	j["lossless"]           = {{"lattice", true}, {"float", f.exact}, {"order", f.orderKept}};
	j["restored"]           = f.restored;
	j["feature_bytes"]      = {
	         {"restoration", f.restorationBytes},
	         {"order", f.orderBytes},
	         {"exact", f.exactBytes},
	         {"attributes", f.attributeBytes}};
	j["attributes"] = Json::array();
	for (const AttributeInfo& a : info.attributes)
		j["attributes"].push_back(
		    {{"of", nameOf(a.of)},
		     {"kind", nameOf(a.kind)},
		     {"name", a.name},
		     {"columns", a.components},
		     {"type", nameOf(a.type)},
		     {"bits", a.bits},
		     {"step", a.step},
		     {"bytes", a.bytes},
		     {"bits_per_vertex", bitsPerVertex(a.bytes, info.vertices)}});
	j["textures"] = info.textures;
	j["levels"]   = Json::array();
	for (std::size_t i = 0; i < info.levels.size(); ++i) {
		const LevelInfo& level = info.levels[i];
		j["levels"].push_back(
		    {{"level", i},
		     {"kind", nameOf(level.kind)},
		     {"vertices", level.vertices},
		     {"faces", level.faces},
		     {"bytes", level.bytes},
		     {"prefix", level.prefix},
		     {"bits", level.bits},
		     {"error", level.error}});
	}
	j["encode_seconds"] = nullptr;
	j["decode_seconds"] = nullptr;
	return j;
}

static void printAttributes(const StreamInfo& info)
{
	if (info.attributes.empty() && info.textures.empty())
		return;
	std::printf("\n");
	Table table({"attribute", "columns", "type", "bits", "step", "bytes", "bpv"});
	for (const AttributeInfo& a : info.attributes)
		table.add(
		    {nameOf(a.of, a.kind, a.name), std::to_string(a.components), nameOf(a.type),
		     a.bits > 0 ? std::to_string(a.bits) : "exact",
		     a.bits > 0 ? significant(a.step, 4) : "-", grouped(a.bytes),
		     fixed(bitsPerVertex(a.bytes, info.vertices), 2)});
	table.print();
	for (const std::string& name : info.textures)
		std::printf("texture %s\n", visible(name).c_str());
}

void printInfo(const StreamInfo& info)
{
	auto bpv = [&](std::uint64_t bytes) { return fixed(bitsPerVertex(bytes, info.vertices), 2); };
	std::printf(
	    "%s vertices, %s faces, %s bytes, %s bits per vertex\n", grouped(info.vertices).c_str(),
	    grouped(info.faces).c_str(), grouped(info.bytes).c_str(), bpv(info.bytes).c_str());
	const std::uint64_t attributes = info.features.attributeBytes;
	std::printf(
	    "connectivity %s, geometry %s, attributes %s, other %s bits per vertex\n",
	    bpv(info.connectivityBytes).c_str(), bpv(info.geometryBytes).c_str(),
	    bpv(attributes).c_str(),
	    bpv(info.bytes - info.connectivityBytes - info.geometryBytes - attributes).c_str());
	std::printf(
	    "version %d.%d, mode %s, %d bits per coordinate (step %s), lifting %s, wgc %s\n",
	    info.versionMajor, info.versionMinor, nameOf(info.mode).c_str(), info.bits,
	    significant(info.step, 6).c_str(), nameOfLifting(info.lifting).c_str(),
	    info.wgc ? "on" : "off");
	const StreamFeatures& f = info.features;
	std::printf(
	    "promises: lattice-lossless%s%s\n", f.exact ? ", float-lossless" : "",
	    f.orderKept ? ", order-preserving" : "");
	const auto feature = [&](bool has, const char* what, std::uint64_t bytes) {
		if (has)
			std::printf(
			    "behind the levels: %s, %s bytes, %s bits per vertex\n", what,
			    grouped(bytes).c_str(), bpv(bytes).c_str());
	};
	feature(f.restored, "what the original has and a manifold has not", f.restorationBytes);
	feature(f.orderKept, "order", f.orderBytes);
	feature(f.exact, "exact coordinates", f.exactBytes);
	printAttributes(info);
	std::printf("\n");
	Table table({"level", "kind", "vertices", "faces", "bytes", "up to here", "bpv", "error"});
	for (std::size_t i = 0; i < info.levels.size(); ++i) {
		const LevelInfo& level = info.levels[i];
		table.add(
		    {std::to_string(i), nameOf(level.kind), grouped(level.vertices), grouped(level.faces),
		     grouped(level.bytes), grouped(level.prefix), bpv(level.prefix),
		     significant(level.error, 4)});
	}
	table.print();
}

void printJson(const Json& object)
{
	// Names from files may be in any encoding.
	std::puts(object.dump(1, '\t', false, Json::error_handler_t::replace).c_str());
}

} // namespace wavemesh::tool
