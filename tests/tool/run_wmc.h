// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Runs wmc as a program and looks at what a user sees of it.
#pragma once

#include <wavemesh/mesh_data.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace wavemesh::test {

struct RunResult
{
	int code = -1; ///< exit code; 128 + signal if it died
	std::string out, err;

	nlohmann::json json() const { return nlohmann::json::parse(out); } ///< throws if it is none
	/// Lines on stderr.
	std::size_t errorLines() const
	{
		std::size_t n = 0;
		for (char c : err)
			n += c == '\n';
		return n;
	}
};

struct RunLimits
{
	std::uint64_t fileBytes = 0;     ///< files cannot grow beyond this: a full disk. 0: no limit
	bool terminal           = false; ///< stderr is a terminal
};

RunResult runProgram(const std::vector<std::string>& command, const RunLimits& limits = {});
RunResult runWmc(std::vector<std::string> arguments, const RunLimits& limits = {});

using FileBytes = std::vector<std::uint8_t>;
FileBytes readAll(const std::string& path);
void writeAll(const std::string& path, const FileBytes& bytes);
void writeAll(const std::string& path, const std::string& text);
void writeObj(const std::string& path, const MeshData& mesh);

/// A folder of its own for each test, removed afterwards.
class WmcTest : public ::testing::Test
{
protected:
	void SetUp() override;
	void TearDown() override;

	std::string path(const std::string& name) const { return folder_ + "/" + name; }
	/// Names in the folder, hidden ones too, sorted.
	std::vector<std::string> files() const;
	/// Writes `mesh` as name.obj and encodes it to name.wmc. Returns the .wmc's path.
	std::string encoded(
	    const std::string& name,
	    const MeshData& mesh,
	    const std::vector<std::string>& options = {}) const;

	std::string folder_;
};

} // namespace wavemesh::test
