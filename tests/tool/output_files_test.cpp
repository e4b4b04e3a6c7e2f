// SPDX-License-Identifier: GPL-3.0-or-later
// Files appear whole or not at all, and nothing is left behind.
#include "mesh_families.h"
#include "run_wmc.h"

#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace wavemesh::test {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

TEST_F(WmcTest, AMissingFolderIsRefusedInOneLine)
{
	const std::string wmc = encoded("a", makeTorus(8, 8));
	for (const RunResult& r :
	     {runWmc({"encode", path("a.obj"), path("no/a.wmc")}),
	      runWmc({"decode", wmc, path("no/a.ply")}),
	      runWmc({"report", path("a.obj"), "--csv", path("no/a.csv"), "--samples", "100"})}) {
		EXPECT_EQ(r.code, 1);
		EXPECT_EQ(r.errorLines(), 1u) << r.err;
		EXPECT_NE(r.err.find("cannot be written"), std::string::npos) << r.err;
		EXPECT_EQ(r.out, "");
	}
	EXPECT_EQ(files(), (Names {"a.obj", "a.wmc"}));
}

TEST_F(WmcTest, AFolderWithoutWritePermissionIsRefused)
{
	if (::geteuid() == 0)
		GTEST_SKIP() << "root may write anywhere";
	const std::string wmc = encoded("a", makeTorus(8, 8));
	fs::create_directory(path("locked"));
	fs::permissions(path("locked"), fs::perms::owner_read | fs::perms::owner_exec);
	const RunResult r = runWmc({"decode", wmc, path("locked/a.ply")});
	EXPECT_EQ(r.code, 1);
	EXPECT_EQ(r.errorLines(), 1u);
}

TEST_F(WmcTest, AFullDiskLeavesTheOldFileAndNoTemporary)
{
	const std::string wmc = encoded("a", makeBumpySphere(3000, 1));
	RunLimits full;
	full.fileBytes = 1500;
	for (const std::string format : {"ply", "obj", "off", "stl"}) {
		const std::string out = path("out." + format);
		writeAll(out, std::string("precious"));
		const RunResult r = runWmc({"decode", wmc, out}, full);
		EXPECT_EQ(r.code, 1) << format;
		EXPECT_EQ(r.errorLines(), 1u) << r.err;
		EXPECT_EQ(readAll(out).size(), 8u) << format;
		fs::remove(out);
		EXPECT_EQ(runWmc({"decode", wmc, out}, full).code, 1);
	}
	writeAll(path("old.wmc"), std::string("precious"));
	EXPECT_EQ(runWmc({"encode", path("a.obj"), path("old.wmc")}, full).code, 1);
	EXPECT_EQ(readAll(path("old.wmc")).size(), 8u);
	EXPECT_EQ(files(), (Names {"a.obj", "a.wmc", "old.wmc"}));
}

TEST_F(WmcTest, AFileOverALimitIsRefusedWithItsNameAndTheOptionsThatRaiseIt)
{
	const std::string wmc = encoded("a", makeTorus(8, 8));
	for (const std::string limit : {"vertices", "faces"}) {
		const RunResult r = runWmc({"decode", wmc, path("out.ply"), "--max-" + limit, "63"});
		EXPECT_EQ(r.code, 1);
		EXPECT_EQ(r.errorLines(), 1u) << r.err;
		EXPECT_NE(r.err.find(limit + ", more than the limit of 63"), std::string::npos) << r.err;
		EXPECT_NE(r.err.find("--max-"), std::string::npos) << r.err;
	}
	EXPECT_EQ(files(), (Names {"a.obj", "a.wmc"}));
}

TEST_F(WmcTest, AFileThatIsCutWhileItIsReadIsToldToBeCut)
{
	const std::string wmc = encoded("a", makeBumpySphere(3000, 1));
	const auto size       = std::to_string(fs::file_size(wmc) / 2);
	// A pipe that ends early looks like a file that got shorter.
	const RunResult r = runProgram(
	    {"/bin/sh", "-c", "head -c \"$3\" \"$1\" | \"$0\" decode /dev/stdin \"$2\"", WMC_PROGRAM,
	     wmc, path("out.ply"), size});
	EXPECT_EQ(r.code, 0) << r.err;
	EXPECT_NE(r.err.find("the file ends"), std::string::npos) << r.err;
	EXPECT_EQ(files(), (Names {"a.obj", "a.wmc", "out.ply"}));
}

TEST_F(WmcTest, AFileThatIsReplacedWhileItIsReadIsReadAsItWasOrRefused)
{
	const std::string wmc    = encoded("a", makeBumpySphere(3000, 1));
	const FileBytes original = readAll(wmc);
	FileBytes mixed          = original; // the beginning of one, the end of another
	const std::string other  = encoded("b", makeBumpySphere(3000, 2));
	const FileBytes second   = readAll(other);
	const std::size_t half   = std::min(original.size(), second.size()) / 2;
	mixed.resize(half);
	mixed.insert(mixed.end(), second.begin() + std::ptrdiff_t(half), second.end());
	writeAll(path("mixed.wmc"), mixed);
	const RunResult r = runWmc({"decode", path("mixed.wmc"), path("out.ply")});
	EXPECT_EQ(r.code, 1);
	EXPECT_EQ(r.errorLines(), 1u) << r.err;
	EXPECT_FALSE(fs::exists(path("out.ply")));
}

TEST_F(WmcTest, AFailedCommandLeavesTheOldFile)
{
	writeAll(path("bad.wmc"), std::string("this is no wmc"));
	writeAll(path("out.ply"), std::string("precious"));
	EXPECT_EQ(runWmc({"decode", path("bad.wmc"), path("out.ply")}).code, 1);
	writeAll(path("out.wmc"), std::string("precious"));
	EXPECT_EQ(runWmc({"encode", path("bad.wmc"), path("out.wmc")}).code, 1);
	EXPECT_EQ(readAll(path("out.ply")).size(), 8u);
	EXPECT_EQ(readAll(path("out.wmc")).size(), 8u);
	EXPECT_EQ(files(), (Names {"bad.wmc", "out.ply", "out.wmc"}));
}

TEST_F(WmcTest, AFolderIsNoFile)
{
	fs::create_directory(path("folder.wmc"));
	fs::create_directory(path("folder.ply"));
	writeObj(path("a.obj"), makeTorus(8, 8));
	EXPECT_EQ(runWmc({"encode", path("a.obj"), path("folder.wmc")}).code, 1);
	EXPECT_EQ(runWmc({"encode", path("folder.ply"), path("b.wmc")}).code, 1);
	EXPECT_EQ(runWmc({"info", path("folder.wmc")}).code, 1);
	EXPECT_EQ(files(), (Names {"a.obj", "folder.ply", "folder.wmc"}));
}

TEST_F(WmcTest, DevicesArePassedDataAndNotReplaced)
{
	writeObj(path("a.obj"), makeTorus(8, 8));
	fs::create_symlink("/dev/null", path("null.wmc"));
	EXPECT_EQ(runWmc({"encode", path("a.obj"), path("null.wmc")}).code, 0);
	EXPECT_EQ(runWmc({"encode", path("a.obj"), "/dev/full"}).code, 1);
	EXPECT_TRUE(fs::is_symlink(path("null.wmc")));
	EXPECT_TRUE(fs::is_character_file("/dev/null"));
	EXPECT_TRUE(fs::is_character_file("/dev/full"));
	EXPECT_EQ(files(), (Names {"a.obj", "null.wmc"}));
}

TEST_F(WmcTest, ALinkStaysALinkAndItsTargetIsReplaced)
{
	writeObj(path("a.obj"), makeTorus(8, 8));
	writeAll(path("target.wmc"), std::string("old"));
	fs::create_symlink("target.wmc", path("link.wmc"));
	EXPECT_EQ(runWmc({"encode", path("a.obj"), path("link.wmc")}).code, 0);
	EXPECT_TRUE(fs::is_symlink(path("link.wmc")));
	EXPECT_EQ(runWmc({"info", path("target.wmc")}).code, 0);
}

TEST_F(WmcTest, NewFilesHaveOrdinaryPermissions)
{
	const mode_t mask     = ::umask(022);
	const std::string wmc = encoded("a", makeTorus(8, 8));
	::umask(mask);
	struct stat s;
	ASSERT_EQ(::stat(wmc.c_str(), &s), 0);
	EXPECT_EQ(s.st_mode & 0777, 0644u);
}

TEST_F(WmcTest, StandardOutputThatCannotBeWrittenIsNotSilent)
{
	const std::string wmc = encoded("a", makeTorus(8, 8));
	const RunResult r     = runProgram(
	        {"/bin/sh", "-c", "exec \"$0\" info \"$1\" --json >/dev/full", WMC_PROGRAM, wmc});
	EXPECT_EQ(r.code, 1);
	EXPECT_EQ(r.errorLines(), 1u) << r.err;
}

TEST_F(WmcTest, ProgressIsShownOnATerminalOnly)
{
	writeObj(path("a.obj"), makeBumpySphere(1500, 1));
	const std::vector<std::string> work = {"/usr/bin/env", "WMC_PROGRESS_AFTER=0", WMC_PROGRAM,
	                                       "report",       path("a.obj"),          "--samples",
	                                       "1000"};
	RunLimits terminal;
	terminal.terminal    = true;
	const RunResult seen = runProgram(work, terminal);
	EXPECT_EQ(seen.code, 0);
	EXPECT_NE(seen.err.find("%"), std::string::npos) << seen.err;
	// The line is wiped in the end.
	EXPECT_GE(seen.err.rfind("\r\033[K") + 4, seen.err.size());
	const RunResult quiet = runProgram(work);
	EXPECT_EQ(quiet.code, 0);
	EXPECT_EQ(quiet.err, "");
}

} // namespace wavemesh::test
