// SPDX-License-Identifier: GPL-3.0-or-later
#include "run_wmc.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace wavemesh::test {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void becomeProgram(const std::vector<std::string>& command, const RunLimits& limits)
{
	if (limits.fileBytes > 0) {
		const struct rlimit limit = {limits.fileBytes, limits.fileBytes};
		::setrlimit(RLIMIT_FSIZE, &limit);
	}
	std::vector<char*> argv;
	for (const std::string& word : command)
		argv.push_back(const_cast<char*>(word.c_str()));
	argv.push_back(nullptr);
	::execv(argv[0], argv.data());
	::_exit(127);
}

/// Reads both until both are closed.
void drain(int out, int err, RunResult& result)
{
	struct pollfd ends[2] = {{out, POLLIN, 0}, {err, POLLIN, 0}};
	std::string* texts[2] = {&result.out, &result.err};
	while (ends[0].fd >= 0 || ends[1].fd >= 0) {
		::poll(ends, 2, -1);
		for (int i = 0; i < 2; ++i) {
			if (ends[i].fd < 0 || ends[i].revents == 0)
				continue;
			char buffer[4096];
			const ssize_t n = ::read(ends[i].fd, buffer, sizeof buffer);
			if (n > 0)
				texts[i]->append(buffer, static_cast<std::size_t>(n));
			else // a terminal ends with an error
				ends[i].fd = -1;
		}
	}
}

} // namespace

RunResult runProgram(const std::vector<std::string>& command, const RunLimits& limits)
{
	int out[2], err[2];
	if (::pipe(out) != 0 ||
	    (limits.terminal ? ::openpty(&err[0], &err[1], nullptr, nullptr, nullptr) : ::pipe(err)) !=
	        0)
		return {};
	const pid_t child = ::fork();
	if (child == 0) {
		::dup2(out[1], STDOUT_FILENO);
		::dup2(err[1], STDERR_FILENO);
		for (int fd : {out[0], out[1], err[0], err[1]})
			::close(fd);
		becomeProgram(command, limits);
	}
	::close(out[1]);
	::close(err[1]);
	RunResult result;
	drain(out[0], err[0], result);
	::close(out[0]);
	::close(err[0]);
	int status = 0;
	::waitpid(child, &status, 0);
	result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
	return result;
}

RunResult runWmc(std::vector<std::string> arguments, const RunLimits& limits)
{
	arguments.insert(arguments.begin(), WMC_PROGRAM);
	return runProgram(arguments, limits);
}

FileBytes readAll(const std::string& path)
{
	std::ifstream file(path, std::ios::binary);
	return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void writeAll(const std::string& path, const FileBytes& bytes)
{
	std::ofstream(path, std::ios::binary)
	    .write(
	        reinterpret_cast<const char*>(bytes.data()),
	        static_cast<std::streamsize>(bytes.size()));
}

void writeAll(const std::string& path, const std::string& text)
{
	writeAll(path, FileBytes(text.begin(), text.end()));
}

void writeObj(const std::string& path, const MeshData& mesh)
{
	std::string text;
	for (const auto& p : mesh.positions) {
		text += "v";
		for (double x : p) {
			char digits[40];
			text += " ";
			text.append(digits, std::to_chars(digits, digits + sizeof digits, x).ptr);
		}
		text += "\n";
	}
	for (const auto& t : mesh.triangles)
		text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
		        std::to_string(t[2] + 1) + "\n";
	writeAll(path, text);
}

void WmcTest::SetUp()
{
	std::string name = (fs::temp_directory_path() / "wmc_test.XXXXXX").string();
	ASSERT_NE(::mkdtemp(name.data()), nullptr);
	folder_ = name;
}

void WmcTest::TearDown()
{
	std::error_code ignored;
	fs::remove_all(folder_, ignored);
}

std::vector<std::string> WmcTest::files() const
{
	std::vector<std::string> names;
	for (const auto& entry : fs::directory_iterator(folder_))
		names.push_back(entry.path().filename().string());
	std::sort(names.begin(), names.end());
	return names;
}

std::string WmcTest::encoded(
    const std::string& name, const MeshData& mesh, const std::vector<std::string>& options) const
{
	writeObj(path(name + ".obj"), mesh);
	std::vector<std::string> arguments {"encode", path(name + ".obj"), path(name + ".wmc")};
	arguments.insert(arguments.end(), options.begin(), options.end());
	const RunResult r = runWmc(arguments);
	EXPECT_EQ(r.code, 0) << r.err;
	return path(name + ".wmc");
}

} // namespace wavemesh::test
