// SPDX-License-Identifier: GPL-3.0-or-later
#include "predict/offset_prediction.h"

namespace wavemesh {
namespace {

/// Observations count less the worse they were predicted, and none more than its rounding
/// allows.
std::int32_t importance(const VertexView& view, std::int64_t error)
{
	const auto e = static_cast<std::int32_t>(std::min<std::uint64_t>(magnitude(error), 4096));
	const std::int32_t rounding = 22369621 >> std::min(2 * view.lengthBits, 31);
	return (1 << 20) / (1024 + (e * e >> 4) + rounding) + 1;
}

} // namespace

void predictOffset(const PositionModels& models, VertexView& view)
{
	constexpr std::int32_t kMost = static_cast<std::int32_t>(kFurthest) * 4096;
	Vector& plain                = view.plainOffset;
	for (std::size_t k = 0; k < 3; ++k)
		plain[k] = std::clamp(
		    models.offset[view.leastSquaresClass].predict(view.features[k]), -kMost, kMost);
	view.height = std::clamp(
	    models.height[view.leastSquaresClass].predict(view.heightFeatures), -kMost, kMost);
	const std::int64_t lift = view.height - along(plain, view.normal);
	for (std::size_t k = 0; k < 3; ++k)
		view.offset[k] = view.unscaled(plain[k] + ((lift * view.normal[k]) >> 14));
}

void learnOffset(PositionModels& models, const VertexView& view, const Vector& offset)
{
	auto& plain  = models.offset[view.leastSquaresClass];
	auto& height = models.height[view.leastSquaresClass];
	std::array<std::int32_t, 3> target, importances;
	for (std::size_t k = 0; k < 3; ++k) {
		target[k]      = view.feature(offset[k]);
		importances[k] = importance(view, target[k] - view.plainOffset[k]);
	}
	plain.observe(view.features, target, importances);
	plain.endOfVertex();
	if (view.hasNoNormal())
		return;
	const auto up = static_cast<std::int32_t>(std::clamp<std::int64_t>(
	    along({target[0], target[1], target[2]}, view.normal), -8192, 8192));
	height.template observe<1>({view.heightFeatures}, {up}, {importance(view, up - view.height)});
	height.endOfVertex();
}

} // namespace wavemesh
