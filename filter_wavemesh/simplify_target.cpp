// SPDX-License-Identifier: GPL-3.0-or-later
#include "simplify_target.h"

#include <shared/plugin_support.h>

#include <algorithm>
#include <cmath>

namespace wavemesh {
namespace {

/// A power of ten, twice or five times one, close to `x`: a default that reads well.
double roundNumber(double x)
{
	if (!(x > 0))
		return 0;
	const double ten  = std::pow(10., std::floor(std::log10(x)));
	const double lead = x / ten;
	return ten * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

template <class Reached>
ChosenLevel finestThat(const StreamInfo& info, Reached reached)
{
	for (int level = info.finestLevel(); level >= 0; --level)
		if (reached(info.levels[std::size_t(level)]))
			return {level, true};
	return {0, false};
}

} // namespace

void addTargetParameters(RichParameterList& list, const MeshModel& layer)
{
	list.addParam(RichEnum(
	    "target", SimplifyTarget::LevelsRemoved,
	    {"levels removed", "level", "vertices", "percentage", "bytes", "error"}, "Simplify to",
	    "Which of the values below is the target; the others are not used."));
	list.addParam(RichInt(
	    "levels_removed", 1, "Levels to remove",
	    "How many times the mesh is made coarser. Most levels have a third to two thirds of the "
	    "faces of the next finer one."));
	list.addParam(RichInt("level", 0, "Level", "0 is the base mesh, the coarsest there is."));
	list.addParam(RichInt(
	    "vertices", std::max(1, layer.cm.vn / 4), "Vertices",
	    "The finest level that has at most so many vertices."));
	list.addParam(RichFloat(
	    "percentage", 25, "Percentage (% of the vertices)",
	    "The finest level that has at most so many percent of the vertices."));
	list.addParam(RichInt(
	    "bytes", 10000, "Size (bytes)",
	    "The finest level that fits into a .wmc file of at most so many bytes, encoded as below."));
	list.addParam(RichFloat(
	    "error", Scalarm(roundNumber(double(layer.cm.bbox.Diag()) / 1000)),
	    "Maximum error (model units)",
	    "The coarsest level whose error, in the units of the coordinates, is at most this. It is "
	    "estimated from the details that are left out; it is no exact surface distance."));
}

SimplifyTarget simplifyTarget(const RichParameterList& list, const MeshModel& layer)
{
	RichParameterList defaults;
	addTargetParameters(defaults, layer);
	SimplifyTarget target;
	const int kind = integerOf(list, "target", SimplifyTarget::LevelsRemoved);
	if (kind < SimplifyTarget::LevelsRemoved || kind > SimplifyTarget::Error)
		throw MLException("Wavemesh: 'target' has to be 0 to 5.");
	target.kind = SimplifyTarget::Kind(kind);

	static const char* const names[] = {"levels_removed", "level", "vertices",
	                                    "percentage",     "bytes", "error"};
	target.value = numberOf(list, names[kind], numberOf(defaults, names[kind], 0));
	if (!(target.value >= 0) && target.kind != SimplifyTarget::Level)
		throw MLException(QString("Wavemesh: '%1' must not be negative.").arg(names[kind]));
	return target;
}

ChosenLevel chooseLevel(const StreamInfo& info, const SimplifyTarget& target)
{
	const double finest = info.finestLevel();
	switch (target.kind) {
	case SimplifyTarget::LevelsRemoved:
		return {int(finest - std::min(target.value, finest)), target.value <= finest};
	case SimplifyTarget::Level:
		if (target.value < 0)
			return {info.finestLevel(), true};
		return {int(std::min(target.value, finest)), target.value <= finest};
	case SimplifyTarget::Vertices:
		return finestThat(info, [&](const LevelInfo& l) { return l.vertices <= target.value; });
	case SimplifyTarget::Percentage: {
		const double most = target.value / 100 * info.vertices;
		return finestThat(info, [&](const LevelInfo& l) { return l.vertices <= most; });
	}
	case SimplifyTarget::Bytes:
		return finestThat(
		    info, [&](const LevelInfo& l) { return double(l.prefix) <= target.value; });
	case SimplifyTarget::Error:
		for (int level = 0; level < info.finestLevel(); ++level)
			if (info.levels[std::size_t(level)].error <= target.value)
				return {level, true};
		return {info.finestLevel(), true};
	}
	return {info.finestLevel(), false};
}

} // namespace wavemesh
