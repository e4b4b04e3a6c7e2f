// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.h"
#include "console.h"
#include "failure.h"
#include "man_page.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

namespace {

using namespace wavemesh::tool;

/// CLI11's own message in one line.
int reportUsage(const CLI::App& app, const CLI::ParseError& error)
{
	if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) // --help, --version
		return app.exit(error);
	std::string line = error.what();
	for (char& c : line)
		c = c == '\n' ? ' ' : c;
	std::string command;
	for (const CLI::App* sub : app.get_subcommands())
		command = " " + sub->get_name();
	printError(line + "; see wmc" + command + " --help");
	return kUsage;
}

int run(int argc, char** argv)
{
	CLI::App app("Progressive, lossless compression of triangle meshes (.wmc)", "wmc");
	Command chosen;
	app.set_version_flag("--version", "wmc " WAVEMESH_VERSION);
	app.require_subcommand(1);
	app.footer(
	    "Exit codes: 0 fine; 1 refused input, corrupt file, or output that cannot be written; "
	    "2 usage.\n'wmc COMMAND --help' tells each command's options, with units and defaults.\n"
	    "Bits per vertex (bpv) count the whole file and the vertices of the original.\n"
	    "Work of more than a second shows its progress on a terminal; the environment's "
	    "WMC_PROGRESS_AFTER gives another time, in milliseconds.");
	addEncode(app, chosen);
	addDecode(app, chosen);
	addInfo(app, chosen);
	addVerify(app, chosen);
	addReport(app, chosen);
	addBench(app, chosen);
	app.add_flag_callback(
	       "--man",
	       [&app] {
		       std::fputs(manPage(app, WAVEMESH_VERSION).c_str(), stdout);
		       throw CLI::Success();
	       },
	       "Print the manual page")
	    ->trigger_on_parse() // before a command is asked for
	    ->group("");         // for those who build packages
	const auto isCommand = [&](CLI::App* command) { return command->get_name() == argv[1]; };
	if (argc > 1 && argv[1][0] != '-' && app.get_subcommands(isCommand).empty())
		throw UsageError("'" + std::string(argv[1]) + "' is no command; see wmc --help");
	try {
		app.parse(argc, argv);
	}
	catch (const CLI::ParseError& error) {
		return reportUsage(app, error);
	}
	const int code = chosen();
	if (std::fflush(stdout) != 0)
		throw Failure("the output cannot be written");
	return code;
}

} // namespace

int main(int argc, char** argv)
{
	std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow: write() fails, and we clean up
	try {
		return run(argc, argv);
	}
	catch (const UsageError& error) {
		printError(error.what());
		return kUsage;
	}
	catch (const std::bad_alloc&) {
		printError("out of memory");
	}
	catch (const std::exception& error) {
		printError(error.what());
	}
	return kRefused;
}
