// SPDX-License-Identifier: GPL-3.0-or-later
// verify: holds a file's promises against the original.
#include "any_isomorphism.h"
#include "attribute_check.h"
#include "attribute_options.h"
#include "codec_options.h"
#include "commands.h"
#include "console.h"
#include "failure.h"
#include "info_json.h"
#include "isomorphism.h"
#include "level_check.h"
#include "mesh_files.h"

#include <wavemesh/vcg_attributes.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>

namespace wavemesh::tool {

namespace {

struct Promise
{
	std::string name, broken; ///< `broken` is empty if it holds
};

/// Lattice points of model coordinates, worked out here and not by the codec: (x - origin) / step,
/// to the nearest, ties away from zero.
LabelledMesh onLattice(const MeshData& mesh, const StreamInfo& info)
{
	LabelledMesh out;
	out.triangles = mesh.triangles;
	out.labels.reserve(mesh.positions.size());
	for (const auto& p : mesh.positions) {
		std::array<std::int64_t, 3> q;
		for (std::size_t k = 0; k < 3; ++k)
			q[k] = std::llround((p[k] - info.origin[k]) / info.step);
		out.labels.push_back(q);
	}
	return out;
}

/// Every coordinate of the finest mesh must be origin + step * integer.
std::string offLattice(const MeshData& mesh, const StreamInfo& info)
{
	for (std::size_t v = 0; v < mesh.positions.size(); ++v)
		for (std::size_t k = 0; k < 3; ++k) {
			const double x = mesh.positions[v][k];
			const double n = std::round((x - info.origin[k]) / info.step);
			if (!(n >= 0 && n < 16777216) || x != info.origin[k] + info.step * n)
				return "vertex " + std::to_string(v) + " of the finest level is off the lattice";
		}
	return {};
}

std::string checkTable(const StreamInfo& info, std::uint64_t size)
{
	if (info.levels.empty())
		return "the level table is empty";
	if (size != info.bytes)
		return "the file has " + std::to_string(size) + " bytes and declares " +
		       std::to_string(info.bytes);
	std::uint64_t sum = 0;
	for (std::size_t i = 0; i < info.levels.size(); ++i) {
		const LevelInfo& l     = info.levels[i];
		const LevelInfo& last  = info.levels[i == 0 ? 0 : i - 1];
		const std::string name = "level " + std::to_string(i);
		sum += l.bytes;
		if (l.prefix > size || l.prefix < last.prefix)
			return name + " declares an impossible prefix";
		const bool restored = i + 1 == info.levels.size() && info.features.restored;
		if (!restored &&
		    (l.vertices < last.vertices || l.faces < last.faces || l.faces / 4 > last.faces))
			return name + " declares impossible counts";
		if (!std::isfinite(l.error) || l.error < 0)
			return name + " declares an impossible error";
	}
	if (sum != size)
		return "the levels' bytes do not add up to the file's";
	if (info.levels.back().vertices != info.vertices || info.levels.back().faces != info.faces)
		return "the finest level's counts are not the original's";
	if (info.levels.back().error != 0)
		return "the finest level declares an error";
	return {};
}

/// With the lazy filter bank a vertex never moves.
bool hasMoved(const MeshData& coarse, const MeshData& fine)
{
	return !std::equal(
	    coarse.positions.begin(), coarse.positions.end(), fine.positions.begin(),
	    fine.positions.begin() + static_cast<std::ptrdiff_t>(coarse.positions.size()));
}

/// By bit patterns: not-a-numbers too.
template <class T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b)
{
	return a.size() == b.size() &&
	       (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same(const MeshData& a, const MeshData& b)
{
	return sameBits(a.positions, b.positions) && a.triangles == b.triangles &&
	       std::equal(
	           a.attributes.begin(), a.attributes.end(), b.attributes.begin(), b.attributes.end(),
	           [](const Attribute& x, const Attribute& y) { return sameBits(x.values, y.values); });
}

/// Every level decodes, as declared, manifold, with the topology of all others.
std::string checkLevels(const Bytes& file, MeshData& finest)
{
	auto decoder = Decoder::open(file.data(), file.size(), DecodeLimits::none());
	if (!decoder.ok())
		return decoder.status().what;
	const StreamInfo& info = decoder->info();
	ProgressLine line("checking levels");
	MeshData last;
	Topology first;
	for (int i = 0; i <= info.finestLevel(); ++i) {
		line.show(double(i) / double(info.levels.size()));
		const LevelInfo& level = info.levels[static_cast<std::size_t>(i)];
		const std::string name = "level " + std::to_string(i) + ": ";
		if (const Status s = decoder->advance(); !s.ok())
			return name + s.what;
		if (decoder->level() != i)
			return name + "the decoder went to level " + std::to_string(decoder->level());
		const MeshData mesh = decoder->mesh();
		if (mesh.positions.size() != level.vertices || mesh.triangles.size() != level.faces)
			return name + "not as many vertices and faces as declared";
		// The finest may be anything, and in any order.
		const StreamFeatures& f = info.features;
		const bool finished     = i == info.finestLevel() && (f.restored || f.orderKept || f.exact);
		if ((finished && f.restored) || (info.vertices == 0 && info.faces == 0)) {
			last = mesh;
			continue;
		}
		if (mesh.triangles.empty())
			return name + "no faces";
		Topology topology;
		if (const std::string wrong = whatVcgFindsWrong(mesh, topology); !wrong.empty())
			return name + wrong;
		if (i == 0)
			first = topology;
		if (!(topology == first))
			return name + "other components, boundaries or genus than level 0";
		if (i > 0 && !finished && info.mode == Mode::Classic && info.lifting == kLiftingOff &&
		    hasMoved(last, mesh))
			return name + "a vertex moved although lifting is off";
		last = mesh;
	}
	finest = std::move(last);
	return {};
}

/// The declared prefix of every level holds that level whole.
std::string checkPrefixes(const Bytes& file, const StreamInfo& info)
{
	ProgressLine line("checking prefixes");
	auto decoder = Decoder::open(file.data(), file.size(), DecodeLimits::none());
	if (!decoder.ok())
		return decoder.status().what;
	for (int i = 0; i <= info.finestLevel(); ++i) {
		line.show(double(i) / double(info.levels.size()));
		const std::string name     = "level " + std::to_string(i) + ": ";
		const std::uint64_t prefix = info.levels[static_cast<std::size_t>(i)].prefix;
		DecodeOptions options      = ofOwnFile();
		options.level              = i;
		if (const Status s = decoder->advance(); !s.ok())
			return name + s.what;
		const MeshData whole = decoder->mesh();
		// In a buffer of its own, so that reading past it is not reading the rest of the file.
		const Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(prefix));
		const auto part = decode(cut.data(), cut.size(), options);
		if (!part.ok() || part->level != i || !same(whole, part->mesh))
			return name + "is not whole in the prefix declared";
		// A byte less may be told to be cut, or do as well; but it gives no other mesh silently.
		options.maxBytes   = prefix - 1;
		const auto shorter = decode(file.data(), file.size(), options);
		if (shorter.ok() ? !same(whole, shorter->mesh)
		                 : shorter.status().code != StatusCode::Truncated)
			return name + "without its last byte it is another mesh, and nothing tells";
	}
	return {};
}

/// Bit patterns of the coordinates.
LabelledMesh bitForBit(const MeshData& mesh)
{
	LabelledMesh out;
	out.triangles = mesh.triangles;
	out.labels.resize(mesh.positions.size());
	for (std::size_t v = 0; v < mesh.positions.size(); ++v)
		std::memcpy(out.labels[v].data(), mesh.positions[v].data(), sizeof mesh.positions[v]);
	return out;
}

/// What the file promises of the finest mesh, each by its own comparison.
void checkMesh(
    const MeshData& original,
    const MeshData& decoded,
    const StreamInfo& info,
    std::vector<Promise>& promises)
{
	const auto compare = [&](const LabelledMesh& a, const LabelledMesh& b) {
		return info.features.restored ? whatDiffersInAnyMesh(a, b) : whatDiffers(a, b);
	};
	if (info.features.exact)
		promises.push_back({"float-lossless", compare(bitForBit(original), bitForBit(decoded))});
	else {
		promises.push_back({"lattice-lossless", offLattice(decoded, info)});
		if (promises.back().broken.empty())
			promises.back().broken = compare(onLattice(original, info), onLattice(decoded, info));
	}
	if (info.features.attributes) {
		const auto labelled = [&](const MeshData& m) {
			return info.features.exact ? bitForBit(m) : onLattice(m, info);
		};
		promises.push_back(
		    {"attributes", promises.back().broken.empty()
		                       ? whatDiffersInAttributes(
		                             original, labelled(original), decoded, labelled(decoded), info)
		                       : "the vertices differ already"});
	}
	if (!info.features.orderKept)
		return;
	promises.push_back({"order-preserving", ""});
	if (original.triangles != decoded.triangles)
		promises.back().broken = "faces, or their first corners, come in another order";
	else if (
	    info.features.exact ? bitForBit(original).labels != bitForBit(decoded).labels
	                        : onLattice(original, info).labels != onLattice(decoded, info).labels)
		promises.back().broken = "vertices come in another order";
}

/// Attributes of the original that the file was not given.
std::vector<std::string> leftOut(const MeshData& original, const MeshData& decoded)
{
	std::vector<std::string> names;
	for (const Attribute& a : original.attributes) {
		const auto isIt = [&](const Attribute& b) {
			return a.of == b.of && a.kind == b.kind && a.name == b.name;
		};
		if (std::none_of(decoded.attributes.begin(), decoded.attributes.end(), isIt))
			names.push_back(nameOf(a.of, a.kind, a.name));
	}
	return names;
}

struct Verify
{
	std::string original, in;
	bool json = false;

	int run() const
	{
		const Bytes file = readFile(in);
		const auto info  = readInfo(file.data(), file.size());
		if (!info.ok())
			throw Failure(messageOf(in, info.status()));
		const MeshData mesh = loadMesh(original, kAllChannels);

		std::vector<Promise> promises;
		promises.push_back({"level table", checkTable(*info, file.size())});
		double seconds = 0;
		DecodedMesh decoded;
		Status status;
		try {
			auto result = decodeBytes(in, file, ofOwnFile(), &seconds);
			status      = result.status();
			decoded     = std::move(*result);
		}
		catch (const Failure& failure) {
			status = Status(StatusCode::Corrupt, failure.what());
		}
		promises.push_back({"decodes whole", status.ok() ? "" : status.what});
		if (status.ok()) {
			MeshData finest;
			promises.push_back({"levels manifold and as declared", checkLevels(file, finest)});
			if (promises.back().broken.empty() && !same(finest, decoded.mesh))
				promises.back().broken = "level by level the finest mesh is another";
			promises.push_back({"prefixes", checkPrefixes(file, *info)});
			checkMesh(mesh, decoded.mesh, *info, promises);
		}
		const auto left = status.ok() ? leftOut(mesh, decoded.mesh) : std::vector<std::string> {};
		return report(promises, left, *info, seconds);
	}

	int report(
	    const std::vector<Promise>& promises,
	    const std::vector<std::string>& left,
	    const StreamInfo& info,
	    double seconds) const
	{
		const Promise* broken = nullptr;
		for (const Promise& p : promises)
			if (!p.broken.empty() && !broken)
				broken = &p;
		if (json) {
			Json j        = {{"file", in}, {"original", original}, {"ok", !broken}};
			j["promises"] = Json::array();
			for (const Promise& p : promises)
				j["promises"].push_back(
				    {{"name", p.name},
				     {"ok", p.broken.empty()},
				     {"broken", p.broken.empty() ? Json() : Json(p.broken)}});
			j["not_in_file"] = left;
			j.update(toJson(info));
			j["decode_seconds"] = seconds;
			printJson(j);
		}
		else {
			for (const Promise& p : promises)
				std::printf("%-7s %s\n", p.broken.empty() ? "ok" : "BROKEN", p.name.c_str());
			for (const std::string& name : left)
				std::printf(
				    "absent  %s: in the original, not in the file\n", visible(name).c_str());
		}
		if (broken)
			printError(in + ": " + broken->name + ": " + broken->broken);
		return broken ? kRefused : kFine;
	}
};

} // namespace

void addVerify(CLI::App& app, Command& chosen)
{
	auto c        = std::make_shared<Verify>();
	auto* command = app.add_subcommand(
	    "verify", "Check every promise of a .wmc against the mesh that it was made of");
	command->add_option("ORIGINAL", c->original, "The mesh: .ply, .obj, .off or .stl")->required();
	command->add_option("IN", c->in, "The file, .wmc")->required();
	command->add_flag("--json", c->json, "Print one JSON object on stdout and nothing else");
	command->footer(
	    "Exit code 0 only if the finest level is the original on the file's lattice up to the\n"
	    "numbering of vertices and faces, every level decodes, is manifold and as declared, and\n"
	    "every declared prefix holds its level whole. 1 otherwise. Attributes must be the "
	    "original's,\n"
	    "bit for bit, or within half the step that the file states. Those that the file was not\n"
	    "given are named (not_in_file in JSON) and break nothing.");
	command->callback([&chosen, c] { chosen = [c] { return c->run(); }; });
}

} // namespace wavemesh::tool
