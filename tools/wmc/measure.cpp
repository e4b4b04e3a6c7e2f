// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure.h"

#include "failure.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace wavemesh::tool {

namespace {

std::uint64_t residentBytes()
{
	unsigned long pages = 0, resident = 0;
	if (std::FILE* f = std::fopen("/proc/self/statm", "r")) {
		if (std::fscanf(f, "%lu %lu", &pages, &resident) != 2)
			resident = 0;
		std::fclose(f);
	}
	return std::uint64_t {resident} * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

std::uint64_t peakResidentBytes()
{
	struct rusage usage
	{
	};
	::getrusage(RUSAGE_SELF, &usage);
	return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

void giveBackFreeMemory()
{
#ifdef __GLIBC__
	::malloc_trim(0);
#endif
}

double processorSeconds()
{
	struct timespec t
	{
	};
	::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
	return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Measured
measureHere(int runs, const std::function<void()>& warmUp, const std::function<bool()>& work)
{
	Measured m;
	warmUp();
	giveBackFreeMemory(); // what was freed before must not be taken unseen
	const std::uint64_t before = residentBytes();
	for (int i = 0; i < runs; ++i) {
		const auto begin      = std::chrono::steady_clock::now();
		const double cpuBegin = processorSeconds();
		if (!work())
			return {};
		const double cpu = processorSeconds() - cpuBegin;
		const double s =
		    std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
		m.seconds    = i == 0 ? s : std::min(m.seconds, s);
		m.cpuSeconds = i == 0 ? cpu : std::min(m.cpuSeconds, cpu);
		if (i == 0)
			m.peakBytes = peakResidentBytes() - std::min(before, peakResidentBytes());
	}
	m.ok = true;
	return m;
}

} // namespace

Measured
measureInChild(int runs, const std::function<void()>& warmUp, const std::function<bool()>& work)
{
	int ends[2];
	if (::pipe(ends) != 0)
		throw Failure("cannot start a process to measure in");
	std::fflush(nullptr);
	giveBackFreeMemory(); // the child's peak begins with what it inherits
	const pid_t child = ::fork();
	if (child < 0)
		throw Failure("cannot start a process to measure in");
	if (child == 0) {
		const Measured m   = measureHere(runs, warmUp, work);
		const bool written = ::write(ends[1], &m, sizeof m) == sizeof m;
		::_exit(written ? 0 : 1);
	}
	::close(ends[1]);
	Measured m;
	const bool whole = ::read(ends[0], &m, sizeof m) == sizeof m;
	::close(ends[0]);
	::waitpid(child, nullptr, 0);
	return whole ? m : Measured {};
}

} // namespace wavemesh::tool
