// SPDX-License-Identifier: GPL-3.0-or-later
#include "coarse_level.h"

#include <algorithm>
#include <fstream>

namespace wavemesh {
namespace {

/// The head of a file with some hundred levels.
constexpr std::size_t kHead = 16 * 1024;

std::vector<std::uint8_t> readPrefix(const std::string& file, std::size_t size)
{
	std::ifstream in(file, std::ios::binary);
	std::vector<std::uint8_t> bytes(size);
	in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
	bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
	return bytes;
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
	options.level   = info->finestLevel();
	const auto fits = [&](const LevelInfo& level) {
		return level.prefix <= limits.bytes && level.faces <= limits.faces;
	};
	while (options.level > 0 && !fits(info->levels[std::size_t(options.level)]))
		--options.level;
	const std::uint64_t needed = info->levels[std::size_t(options.level)].prefix;
	if (needed > bytes.size())
		bytes = readPrefix(file, static_cast<std::size_t>(needed));
	auto decoded = decode(bytes.data(), bytes.size(), options);
	if (!decoded.hasValue())
		return decoded.status();
	return CoarseLevel {std::move(decoded->mesh), decoded->level, bytes.size()};
}

} // namespace wavemesh
