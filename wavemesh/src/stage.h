// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Progress of a part of the work within the whole.
#pragma once

#include <wavemesh/codec.h>

namespace wavemesh {

/// Maps the progress of one stage, 0..1, into its part of the whole.
class Stage
{
public:
	Stage(const Progress& progress, double from, double to) :
	        progress_(progress), from_(from), to_(to)
	{
	}
	/// False: the user wants to stop.
	bool operator()(double fraction) const
	{
		return !progress_ || progress_(at(fraction));
	}
	Stage part(double from, double to) const { return {progress_, at(from), at(to)}; }

private:
	/// Exact at both ends, so that the next stage never begins before this one's end.
	double at(double fraction) const { return (1 - fraction) * from_ + fraction * to_; }

	const Progress& progress_;
	double from_, to_;
};

/// Asks now and then, in a long loop, whether to go on.
class Watch
{
public:
	Watch() = default; ///< never asks
	explicit Watch(const Stage& stage) : stage_(&stage) {}
	/// False: the user wants to stop. Not to be called again then.
	bool goesOn(std::size_t done, std::size_t all)
	{
		constexpr std::size_t kBetween = 1024;
		if (stage_ != nullptr && done % kBetween == 0)
			stopped_ = !(*stage_)(double(done) / double(all));
		return !stopped_;
	}
	bool stopped() const { return stopped_; }

private:
	const Stage* stage_ = nullptr;
	bool stopped_       = false;
};

inline Status cancelled()
{
	return {StatusCode::Cancelled, "cancelled"};
}

} // namespace wavemesh
