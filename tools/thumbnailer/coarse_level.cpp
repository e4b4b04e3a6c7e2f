// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse_level.h"

#include <algorithm>
#include <fstream>

namespace wavemesh {
namespace {

/// The head of a file with some hundred levels.
constexpr std::size_t kHead = 16 * 1024;

/// @param most  bytes; the file may well have fewer
std::vector<std::uint8_t> readPrefix(const std::string& file, std::uint64_t most)
{
	std::ifstream in(file, std::ios::binary | std::ios::ate);
	const auto end = static_cast<std::streamoff>(in.tellg());
	if (!in || end <= 0)
		return {};
	std::vector<std::uint8_t> bytes(
	    static_cast<std::size_t>(std::min(most, static_cast<std::uint64_t>(end))));
	in.seekg(0);
	in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
	bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
	return bytes;
}

/// Numbers in the attributes of a level.
double attributeNumbers(const StreamInfo& info, const LevelInfo& level)
{
	const double rows[] = {double(level.vertices), double(level.faces), 3.0 * level.faces, 1};
	double numbers      = 0;
	for (const AttributeInfo& a : info.attributes)
		numbers += rows[std::size_t(a.of)] * a.components;
	return numbers;
}

/// Is this level, times `share`, within the limits?
bool isWithin(
    const CoarseLimits& limits, double share, const StreamInfo& info, const LevelInfo& level)
{
	// Vertices outside all faces, of which there may be any number, belong to the finest level.
	return double(level.prefix) <= share * double(limits.bytes) &&
	       level.faces <= share * limits.faces && level.vertices <= 3 * share * limits.faces &&
	       attributeNumbers(info, level) <= share * double(limits.numbers);
}

/// The finest level within the limits, or 0.
int levelWithin(const CoarseLimits& limits, const StreamInfo& info)
{
	int best     = 0;
	double faces = 0; // up to the level
	for (int l = 0; l <= info.finestLevel(); ++l) {
		const LevelInfo& level = info.levels[std::size_t(l)];
		faces += level.faces;
		if (isWithin(limits, 1, info, level) && faces <= double(limits.levelShare) * limits.faces)
			best = l;
	}
	return best;
}

} // namespace

Result<CoarseLevel> readCoarseLevel(const std::string& file, const CoarseLimits& limits)
{
	std::vector<std::uint8_t> bytes = readPrefix(file, kHead);
	if (bytes.empty())
		return Status(StatusCode::NotWmc, "the file cannot be read, or is empty");
	const auto info = readInfo(bytes.data(), bytes.size());
	if (!info.ok())
		return info.status();
	DecodeOptions options;
	options.level          = levelWithin(limits, *info);
	const LevelInfo& level = info->levels[std::size_t(options.level)];
	if (!isWithin(limits, limits.baseShare, *info, level))
		return Status(StatusCode::LimitExceeded, "its base mesh is too large for a small picture");
	// The decoder's own are about finer levels, too, which may be of any size.
	options.limits = DecodeLimits::none();
	if (level.prefix > bytes.size())
		bytes = readPrefix(file, level.prefix);
	auto decoded = decode(bytes.data(), bytes.size(), options);
	if (!decoded.hasValue())
		return decoded.status();
	return CoarseLevel {std::move(decoded->mesh), decoded->level, bytes.size()};
}

} // namespace wavemesh
