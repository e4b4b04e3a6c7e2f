// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How far off predictions are expected to be, from how far off they were around.
#pragma once

#include "predict/neighbourhood.h"

namespace wavemesh {

/// A function, so that the loop is no inner one, which compilers unroll and not vectorise.
template <std::size_t Errors>
void addErrors(const VertexRecord& record, std::array<std::uint16_t, kErrors>& sums)
{
	for (std::size_t i = 0; i < Errors; ++i)
		sums[i] = static_cast<std::uint16_t>(sums[i] + record.error[i]);
}

/// Expected errors: mean of the logarithms around, and of what is usual for this length.
template <std::size_t Errors>
void expectErrors(
    const PositionModels& models,
    const Neighbourhood& around,
    const std::vector<VertexRecord>& records,
    VertexView& view)
{
	std::array<std::uint16_t, kErrors> sums {}; // 24 neighbours at most: below 2^13
	std::size_t count = 1;
	for (std::size_t j = 0; j < view.size; ++j) {
		const Index u = view.ring[j];
		if (around.isNew(u) && around.known(u)) {
			addErrors<Errors>(records[u], sums);
			++count;
		}
	}
	const std::int32_t length  = log2Eighths(static_cast<std::uint64_t>(view.length));
	const std::int32_t inverse = kInverses.of[count] / 4;
	std::array<std::int32_t, kErrors> mean; // times 2^16
	for (std::size_t i = 0; i < Errors; ++i)
		mean[i] = 4 * (std::max(0, length + models.ratio[i] / 16) + sums[i]) * inverse;
	for (std::size_t i = kSurfaceErrors; i < Errors; ++i)
		view.scale[3 * kSmooth + i - kSurfaceErrors] = std::min(mean[i] >> 17, kScaleClasses - 1);
	view.across = mean[kErrorAcross] >> 16;
	view.along  = mean[kErrorAlong] >> 16;
	if (view.hasNoNormal())
		view.across = view.along;
}

inline std::uint8_t logError(std::int64_t e)
{
	const std::uint64_t x = std::min<std::uint64_t>(magnitude(e) + 8, 0xffffffff);
	return static_cast<std::uint8_t>(log2OfWord(static_cast<std::uint32_t>(x)) >> 9);
}

inline void surfaceErrors(const VertexView& view, const Vector& offset, VertexRecord& record)
{
	const Vector e            = offset - view.offset;
	const std::int64_t height = along(e, view.normal);
	std::uint64_t squares     = 0;
	for (const std::int64_t x : e)
		squares += magnitude(x) * magnitude(x);
	const std::uint64_t across = magnitude(height) * magnitude(height);
	const std::uint64_t along2 = squares > across ? (squares - across) / 2 : 0;
	record.error[kErrorAcross] = logError(height);
	record.error[kErrorAlong] =
	    static_cast<std::uint8_t>(std::min(log2Eighths(along2 + 64) / 2, 255));
}

/// Of the surface only where there is one.
template <std::size_t Errors>
void learnRatios(PositionModels& models, const VertexView& view, const VertexRecord& record)
{
	const std::int32_t length = log2Eighths(static_cast<std::uint64_t>(view.length));
	const std::size_t first   = view.hasNoNormal() ? std::size_t(kSurfaceErrors) : 0;
	for (std::size_t i = first; i < Errors; ++i)
		models.ratio[i] += ((record.error[i] - length) * 16 - models.ratio[i]) / 32;
}

} // namespace wavemesh
