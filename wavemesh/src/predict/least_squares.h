// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Linear prediction that learns its weights from what it saw last: weighted least squares with
/// exponential forgetting, in integers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace wavemesh {

/// Features and targets are integers of at most kLargest; weights are in 1/16384.
template <std::size_t N>
class LeastSquares
{
public:
	using Features                         = std::array<std::int32_t, N>;
	static constexpr std::int32_t kLargest = 1 << 13;

	LeastSquares()
	{
		for (std::size_t i = 0; i < N; ++i)
			gram_[i][i] = 1 << 20;
	}

	std::int32_t predict(const Features& f) const
	{
		std::int64_t sum = 0;
		for (std::size_t i = 0; i < N; ++i)
			sum += std::int64_t(weight_[i]) * f[i];
		return static_cast<std::int32_t>(sum >> 14);
	}

	/// Adds observations. @pre |f|, |targets| <= kLargest, importances 1..1024; at most three
	/// between two calls of endOfVertex()
	template <std::size_t Count>
	void observe(
	    const std::array<Features, Count>& f,
	    const std::array<std::int32_t, Count>& targets,
	    const std::array<std::int32_t, Count>& importances)
	{
		for (std::size_t i = 0; i < N; ++i) {
			std::array<std::int64_t, Count> scaled;
			for (std::size_t n = 0; n < Count; ++n)
				scaled[n] = std::int64_t(importances[n]) * f[n][i];
			for (std::size_t k = i; k < N; ++k) {
				std::int64_t sum = 0;
				for (std::size_t n = 0; n < Count; ++n)
					sum += (scaled[n] * f[n][k]) >> 6;
				gram_[i][k] += sum;
			}
			for (std::size_t n = 0; n < Count; ++n)
				moment_[i] += (scaled[n] * targets[n]) >> 6;
		}
	}

	/// Every second time: forgets a little, and takes the weights one sweep of Gauss-Seidel closer
	/// to the solution. |gram| stays below 2^40, so all sums below 2^60.
	void endOfVertex()
	{
		odd_ = !odd_;
		if (odd_)
			return;
		for (std::size_t i = 0; i < N; ++i) {
			for (std::size_t k = i; k < N; ++k)
				gram_[i][k] -= gram_[i][k] >> 7;
			moment_[i] -= moment_[i] >> 7;
		}
		for (std::size_t i = 0; i < N; ++i) {
			std::int64_t rest = moment_[i] * 16384;
			for (std::size_t k = 0; k < i; ++k)
				rest -= gram_[k][i] * weight_[k];
			for (std::size_t k = i + 1; k < N; ++k)
				rest -= gram_[i][k] * weight_[k];
			weight_[i] = static_cast<std::int32_t>(std::clamp<std::int64_t>(
			    rest / (gram_[i][i] + 4096), -kLargestWeight, kLargestWeight));
		}
	}

private:
	static constexpr std::int64_t kLargestWeight = 4 * 16384;

	std::array<std::array<std::int64_t, N>, N> gram_ {}; ///< upper half
	std::array<std::int64_t, N> moment_ {};
	std::array<std::int32_t, N> weight_ {};
	bool odd_ = false;
};

} // namespace wavemesh
