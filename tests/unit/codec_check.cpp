// SPDX-License-Identifier: GPL-3.0-or-later
#include "codec_check.h"

#include "isomorphism.h"

#include <cmath>
#include <cstring>

namespace wavemesh::test {

std::vector<Level> levelsOf(const std::vector<std::uint8_t>& file)
{
	std::vector<Level> levels;
	auto decoder = Decoder::open(file.data(), file.size());
	if (!decoder.ok())
		return {{{}, decoder.status()}};
	while (decoder->level() < decoder->info().finestLevel()) {
		const int before = decoder->level();
		Status s         = decoder->advance();
		const bool good  = s.ok();
		levels.push_back({decoder->level() > before ? decoder->mesh() : MeshData {}, std::move(s)});
		if (!good)
			break;
	}
	return levels;
}

std::vector<std::array<std::int64_t, 3>> latticeOf(const MeshData& mesh, const StreamInfo& info)
{
	std::vector<std::array<std::int64_t, 3>> points;
	points.reserve(mesh.positions.size());
	for (const auto& p : mesh.positions) {
		points.emplace_back();
		for (std::size_t k = 0; k < 3; ++k)
			points.back()[k] =
			    static_cast<std::int64_t>(std::round((p[k] - info.origin[k]) / info.step));
	}
	return points;
}

std::string whatIsLost(const MeshData& original, const MeshData& decoded, const StreamInfo& info)
{
	const tool::LabelledMesh a {latticeOf(original, info), original.triangles};
	const tool::LabelledMesh b {latticeOf(decoded, info), decoded.triangles};
	const std::int64_t limit = std::int64_t {1} << info.bits;
	for (std::size_t v = 0; v < b.labels.size(); ++v)
		for (std::size_t k = 0; k < 3; ++k) {
			const std::int64_t x = b.labels[v][k];
			if (x < 0 || x >= limit)
				return "vertex " + std::to_string(v) + " is outside the lattice";
			if (decoded.positions[v][k] != info.origin[k] + info.step * static_cast<double>(x))
				return "vertex " + std::to_string(v) + " is not on the lattice";
		}
	return tool::whatDiffers(a, b);
}

namespace {

/// Without lifting a vertex never moves by more than its precision grows: it is in the cell where
/// the finest mesh has it, whose width is one lattice step at full precision.
std::string whatLeftItsCell(
    const MeshData& level, const MeshData& finest, const StreamInfo& info, std::size_t j)
{
	const auto cell = static_cast<double>(std::int64_t {1} << (info.bits - info.levels[j].bits));
	for (std::size_t v = 0; v < level.positions.size(); ++v)
		for (std::size_t k = 0; k < 3; ++k) {
			const double truth = std::round((finest.positions[v][k] - info.origin[k]) / info.step);
			const double low   = std::floor(truth / cell) * cell;
			// Where a whole lattice point is, told as Lattice tells it.
			const double x = level.positions[v][k], o = info.origin[k];
			if (x < o + info.step * low || x > o + info.step * (low + cell - 1))
				return "vertex " + std::to_string(v) + " is not in its cell";
		}
	return {};
}

std::string
compareTopology(const Topology& expected, const Topology& found, const std::string& where)
{
	if (found.euler != expected.euler)
		return where + " has another Euler characteristic";
	if (found.components != expected.components)
		return where + " has another number of components";
	if (found.boundaryLoops != expected.boundaryLoops)
		return where + " has another number of boundary loops";
	return {};
}

} // namespace

std::string whatIsWrongWithLevels(const MeshData& original, const std::vector<std::uint8_t>& file)
{
	Topology expected;
	if (std::string s = whatIsNotManifold(original, &expected); !s.empty())
		return "the original: " + s;
	const auto info = readInfo(file.data(), file.size());
	if (!info.ok())
		return info.status().what;
	const std::vector<Level> levels = levelsOf(file);
	if (levels.size() != info->levels.size())
		return "not all levels came: " + levels.back().status.what;
	for (std::size_t j = 0; j < levels.size(); ++j) {
		const std::string where = "level " + std::to_string(j);
		const Level& level      = levels[j];
		if (!level.status.ok())
			return where + ": " + level.status.what;
		if (level.mesh.positions.size() != info->levels[j].vertices ||
		    level.mesh.triangles.size() != info->levels[j].faces)
			return where + " does not have the size that the head declares";
		Topology found;
		if (std::string s = whatIsNotManifold(level.mesh, &found); !s.empty())
			return where + ": " + s;
		if (std::string s = compareTopology(expected, found, where); !s.empty())
			return s;
		if (info->lifting != kLiftingOff)
			continue;
		if (std::string s = whatLeftItsCell(level.mesh, levels.back().mesh, *info, j); !s.empty())
			return where + ": " + s;
		const LevelInfo& row = info->levels[j];
		if (!(row.error >= 0) || (j + 1 == levels.size() && row.error != 0))
			return where + " has a wrong error figure";
	}
	return {};
}

std::string nameOf(const EncodeOptions& o)
{
	const char* wgc[]      = {"off", "on", "auto"};
	const char* optimize[] = {"size", "balanced", "levels"};
	return (o.step > 0 ? "step " + std::to_string(o.step) : std::to_string(o.bits) + " bits") +
	       ", lifting " + (o.lifting == kLiftingOff ? "off" : std::to_string(o.lifting)) +
	       ", wgc " + wgc[static_cast<std::size_t>(o.wgc)] + ", optimize " +
	       optimize[static_cast<std::size_t>(o.optimize)] + ", effort " + std::to_string(o.effort) +
	       (o.mode == Mode::Classic ? ", classic" : ", compact");
}

namespace {

class Fnv
{
public:
	void add(const void* data, std::size_t size)
	{
		for (std::size_t i = 0; i < size; ++i)
			hash_ = (hash_ ^ static_cast<const std::uint8_t*>(data)[i]) * 0x100000001b3u;
	}
	std::uint64_t value() const { return hash_; }

private:
	std::uint64_t hash_ = 0xcbf29ce484222325u;
};

} // namespace

std::uint64_t fingerprint(const MeshData& mesh)
{
	Fnv fnv;
	for (const auto& p : mesh.positions)
		fnv.add(p.data(), sizeof p);
	for (const auto& t : mesh.triangles)
		fnv.add(t.data(), sizeof t);
	for (const Attribute& a : mesh.attributes)
		fnv.add(a.values.data(), a.values.size() * sizeof a.values[0]);
	for (const std::string& name : mesh.textures)
		fnv.add(name.data(), name.size());
	return fnv.value();
}

std::uint64_t fingerprint(const std::vector<std::uint8_t>& bytes)
{
	Fnv fnv;
	fnv.add(bytes.data(), bytes.size());
	return fnv.value();
}

} // namespace wavemesh::test
