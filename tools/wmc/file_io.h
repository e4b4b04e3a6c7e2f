// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Files read whole, and files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace wavemesh::tool {

using Bytes = std::vector<std::uint8_t>;

/// Reads up to `most` bytes. Throws Failure.
Bytes readFile(const std::string& path, std::size_t most = ~std::size_t {0});
std::uint64_t fileSize(const std::string& path); ///< throws Failure

/// A file being written: a temporary beside the target, renamed onto it by commit(). Without
/// commit(), and when the program is interrupted, the temporary is removed and what was at the
/// target stays. Targets that are no regular files (a pipe, /dev/null) are written directly.
/// One at a time.
class OutputFile
{
public:
	/// Throws Failure if the folder cannot be written.
	explicit OutputFile(const std::string& target);
	~OutputFile();
	OutputFile(const OutputFile&)            = delete;
	OutputFile& operator=(const OutputFile&) = delete;

	/// Where to write until commit().
	const std::string& path() const { return temporary_; }
	void write(const void* data, std::size_t size); ///< appends to path(); throws Failure
	void commit();                                  ///< throws Failure

private:
	[[noreturn]] void fail(const std::string& why);
	void removeTemporary();

	std::string target_;
	std::string temporary_;
	bool special_ = false; ///< the target is no regular file
	int fd_       = -1;
};

} // namespace wavemesh::tool
