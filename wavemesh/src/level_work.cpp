// SPDX-License-Identifier: GPL-3.0-or-later
#include "level_work.h"

namespace wavemesh {

std::vector<double> decodingShares(const StreamInfo& info, int target)
{
	std::vector<double> shares;
	double all = 0;
	for (int l = 0; l <= target; ++l) {
		const LevelInfo* level = &info.levels[std::size_t(l)];
		all += levelWork(info.mode, *level, l == 0 ? nullptr : level - 1);
		shares.push_back(all);
	}
	if (target == info.finestLevel())
		for (const double work : featureWork(info))
			all += work;
	for (double& share : shares)
		share = all > 0 ? share / all : 1; // a mesh of nothing takes no time
	return shares;
}

} // namespace wavemesh
