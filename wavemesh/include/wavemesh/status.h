// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// How every function of the codec reports failure: a Status, or a Result that carries a value.
/// The codec throws nothing of its own and prints nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace wavemesh {

/// What went wrong, in ranges: 1.. the caller, 10.. not our file, 20.. a damaged file,
/// 30.. a resource, 40 the user, 90 ourselves. The numbers are stable.
enum class StatusCode : std::uint8_t {
	Ok = 0,
	/// an option out of range, or a mesh that is not a mesh (index out of range, NaN)
	InvalidArgument  = 1,
	Unsupported      = 2,  ///< well formed, but outside what this version handles
	NotWmc           = 10, ///< the data does not begin like a .wmc file
	VersionTooNew    = 11, ///< of a newer version of the format
	VersionTooOld    = 12, ///< of an older one that is not read any more
	Truncated        = 20, ///< the data ends early; what did arrive was decoded
	Corrupt          = 21, ///< the data contradicts itself
	ChecksumMismatch = 22, ///< a chunk or the finest mesh does not match its checksum
	LimitExceeded    = 30, ///< more than the format can hold, or than DecodeLimits allows
	OutOfMemory      = 31,
	Cancelled        = 40, ///< the progress callback asked to stop
	Internal         = 90, ///< a mistake of ours
};

/// Outcome of an operation. `what` is one line in a user's words; it names chunk, level and offset
/// where these are known.
struct [[nodiscard]] Status
{
	static constexpr std::uint64_t kNoOffset = ~std::uint64_t {0};

	StatusCode code          = StatusCode::Ok;
	std::uint64_t byteOffset = kNoOffset; ///< where in the file, in bytes, or kNoOffset
	std::string what;

	Status() = default;
	Status(StatusCode c, std::string message, std::uint64_t offset = kNoOffset) :
	        code(c), byteOffset(offset), what(std::move(message))
	{
	}

	bool ok() const { return code == StatusCode::Ok; }
};

/// A value, or the reason why there is none. A `Truncated` result may carry both: the mesh that the
/// bytes still describe, and the warning.
template <class T>
class [[nodiscard]] Result
{
public:
	Result(T value) : value_(std::move(value)) {}
	Result(Status status) : status_(std::move(status)) {}
	Result(T value, Status warning) : value_(std::move(value)), status_(std::move(warning)) {}

	/// True if there is a value and nothing to complain about.
	bool ok() const { return value_.has_value() && status_.ok(); }
	/// True if there is a value, complete or not.
	bool hasValue() const { return value_.has_value(); }
	const Status& status() const { return status_; }

	/// @pre hasValue()
	T& value() { return *value_; }
	const T& value() const { return *value_; }
	T* operator->() { return &*value_; }
	const T* operator->() const { return &*value_; }
	T& operator*() { return *value_; }
	const T& operator*() const { return *value_; }

private:
	std::optional<T> value_;
	Status status_;
};

} // namespace wavemesh
