// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_io.h"

#include "failure.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <memory>
#include <sys/stat.h>
#include <unistd.h>

namespace wavemesh::tool {

namespace fs = std::filesystem;

namespace {

std::string reason()
{
	return std::strerror(errno);
}

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File openToRead(const std::string& path)
{
	std::error_code ignored;
	if (fs::is_directory(path, ignored))
		throw Failure(path + ": is a folder");
	File f(std::fopen(path.c_str(), "rb"), &std::fclose);
	if (!f)
		throw Failure(path + ": cannot be read: " + reason());
	return f;
}

// What a signal must clean up. Only what a handler may touch.
char temporaryInUse[4096];
volatile std::sig_atomic_t isTemporaryInUse = 0;

extern "C" void removeTemporaryAndDie(int signal)
{
	if (isTemporaryInUse)
		::unlink(temporaryInUse);
	std::signal(signal, SIG_DFL);
	std::raise(signal);
}

void guardTemporary(const std::string& path)
{
	if (path.size() >= sizeof temporaryInUse)
		return;
	std::strcpy(temporaryInUse, path.c_str());
	isTemporaryInUse = 1;
	for (int s : {SIGINT, SIGTERM, SIGHUP})
		if (std::signal(s, removeTemporaryAndDie) == SIG_IGN)
			std::signal(s, SIG_IGN);
}

/// The permissions that open() would have given a new file, or those of the file replaced.
mode_t permissionsFor(const std::string& target)
{
	struct stat s;
	if (::stat(target.c_str(), &s) == 0)
		return s.st_mode & 0777;
	const mode_t mask = ::umask(0);
	::umask(mask);
	return 0666 & ~mask;
}

} // namespace

Bytes readFile(const std::string& path, std::size_t most)
{
	const File f = openToRead(path);
	Bytes bytes;
	std::size_t have = 0;
	do {
		bytes.resize(std::min(most, std::max<std::size_t>(have * 2, 1 << 16)));
		have += std::fread(bytes.data() + have, 1, bytes.size() - have, f.get());
	} while (have == bytes.size() && have < most);
	if (std::ferror(f.get()))
		throw Failure(path + ": cannot be read: " + reason());
	bytes.resize(have);
	return bytes;
}

std::uint64_t fileSize(const std::string& path)
{
	std::error_code error;
	const auto size = fs::file_size(path, error);
	if (error)
		throw Failure(path + ": cannot be read: " + error.message());
	return size;
}

OutputFile::OutputFile(const std::string& target) : target_(target)
{
	std::error_code ignored;
	if (fs::is_symlink(target, ignored)) { // replace what it points to, not the link
		const fs::path real = fs::weakly_canonical(target, ignored);
		if (!ignored)
			target_ = real.string();
	}
	if (fs::is_directory(target_, ignored))
		throw Failure(target + ": is a folder");
	special_ = fs::exists(target_, ignored) && !fs::is_regular_file(target_, ignored);

	const fs::path folder = special_ ? fs::temp_directory_path() : fs::path(target_).parent_path();
	const fs::path name   = "." + fs::path(target_).filename().string() + ".XXXXXX";
	temporary_            = (folder / name).string();
	fd_                   = ::mkstemp(temporary_.data());
	if (fd_ < 0)
		throw Failure(target + ": cannot be written: " + reason());
	guardTemporary(temporary_);
	::fchmod(fd_, permissionsFor(target_));
}

OutputFile::~OutputFile()
{
	removeTemporary();
}

void OutputFile::removeTemporary()
{
	if (fd_ >= 0)
		::close(fd_);
	fd_ = -1;
	if (!temporary_.empty())
		::unlink(temporary_.c_str());
	temporary_.clear();
	isTemporaryInUse = 0;
}

void OutputFile::fail(const std::string& why)
{
	removeTemporary();
	throw Failure(target_ + ": cannot be written: " + why);
}

void OutputFile::write(const void* data, std::size_t size)
{
	const auto* from = static_cast<const char*>(data);
	while (size > 0) {
		const ssize_t n = ::write(fd_, from, size);
		if (n < 0 && errno == EINTR)
			continue;
		if (n <= 0)
			fail(reason());
		from += n;
		size -= static_cast<std::size_t>(n);
	}
}

void OutputFile::commit()
{
	if (special_) {
		const Bytes whole = readFile(temporary_);
		const File f(std::fopen(target_.c_str(), "wb"), &std::fclose);
		if (!f || std::fwrite(whole.data(), 1, whole.size(), f.get()) != whole.size() ||
		    std::fflush(f.get()) != 0)
			fail(reason());
		removeTemporary();
		return;
	}
	// The name must not outlive the contents when the machine stops.
	if (::fsync(fd_) != 0 && errno != EINVAL)
		fail(reason());
	if (::rename(temporary_.c_str(), target_.c_str()) != 0)
		fail(reason());
	temporary_.clear();
	removeTemporary();
}

} // namespace wavemesh::tool
