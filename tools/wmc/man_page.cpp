// SPDX-License-Identifier: GPL-3.0-or-later
#include "man_page.h"

namespace wavemesh::tool {

namespace {

/// Text that roff takes as it is.
std::string plain(const std::string& text)
{
	std::string out;
	for (const char c : text) {
		if (c == '\\' || c == '-')
			out += '\\';
		if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n'))
			out += "\\&";
		out += c;
	}
	return out;
}

/// "--bits INT (default 12)" and what it does.
std::string optionEntry(const CLI::Option& option)
{
	std::string entry =
	    ".TP\n\\fB" + plain(option.get_name(option.get_positional(), true)) + "\\fR";
	// CLI11's type names go on with a range after a colon; a flag has none.
	const std::string type = option.get_type_name();
	if (!type.empty() && !option.get_positional())
		entry += " \\fI" + plain(type.substr(0, type.find(':'))) + "\\fR";
	const std::string fallback = option.get_default_str();
	entry += "\n" + plain(option.get_description());
	if (!fallback.empty())
		entry += " (default: " + plain(fallback) + ")";
	return entry + "\n";
}

/// @param common  footer of all commands: not told here
std::string commandEntry(const CLI::App& command, const std::string& common)
{
	std::string entry = ".SS wmc " + plain(command.get_name());
	std::string options;
	for (const CLI::Option* option : command.get_options()) {
		if (option->get_positional())
			entry += " " + plain(option->get_name(true));
		if (option->get_name(false, true) != "-h,--help")
			options += optionEntry(*option);
	}
	if (const std::string footer = command.get_footer(); footer != common)
		options += ".PP\n" + plain(footer) + "\n";
	return entry + "\n" + plain(command.get_description()) + ".\n" + options;
}

} // namespace

std::string manPage(const CLI::App& app, const std::string& version)
{
	std::string page = ".TH WMC 1 \"\" \"wmc " + version +
	                   "\" \"Wavemesh\"\n"
	                   ".SH NAME\nwmc \\- " +
	                   plain(app.get_description()) +
	                   "\n"
	                   ".SH SYNOPSIS\n.B wmc\n.I COMMAND\n[\\fIoptions\\fR] \\fIfiles\\fR\n"
	                   ".SH DESCRIPTION\n"
	                   "A .wmc file holds a triangle mesh as a coarse base mesh and a sequence of "
	                   "refinements that ends in the original, exact on the lattice of its "
	                   "coordinates or bit for bit. "
	                   "Every prefix of it that holds the base mesh is a mesh.\n"
	                   ".SH COMMANDS\n";
	for (const CLI::App* command : app.get_subcommands({}))
		page += commandEntry(*command, app.get_footer());
	page += ".SH NOTES\n" + plain(app.get_footer()) + "\n";
	page += ".SH EXAMPLES\n.nf\n"
	        "wmc encode horse.obj horse.wmc \\-\\-bits 12\n"
	        "wmc info horse.wmc\n"
	        "wmc decode horse.wmc coarse.ply \\-\\-level 8\n"
	        "wmc verify horse.obj horse.wmc\n"
	        ".fi\n.SH SEE ALSO\n.BR meshlab (1)\n";
	return page;
}

} // namespace wavemesh::tool
