// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What PyMeshLab asks of plugins, where there is none: parameters are keyword arguments, results
/// become Python values, and a slider's value is cut to its range. pymeshlab_test.py runs the rest.
#include "test_host.h"

#include <common/globals.h>
#include <common/plugins/plugin_manager.h>

using namespace wavemesh;
using namespace wavemesh::test;

namespace {

const QStringList kFilters = {"Simplification: Wavemesh",     "Wavemesh: Browse Levels",
                              "Wavemesh: Layers from Levels", "Wavemesh: Rate-Distortion Report",
                              "Wavemesh: Colour by Detail",   "Wavemesh: Equalise Detail"};

const QStringList kKeywords = {
    "and",  "as",     "assert", "async",  "await",  "break",   "class",    "continue", "def",
    "del",  "elif",   "else",   "except", "false",  "finally", "for",      "from",     "global",
    "if",   "import", "in",     "is",     "lambda", "none",    "nonlocal", "not",      "or",
    "pass", "raise",  "return", "true",   "try",    "while",   "with",     "yield"};

void expectKeywordArguments(const RichParameterList& list)
{
	for (const RichParameter& parameter : list)
		EXPECT_FALSE(kKeywords.contains(parameter.pythonName()))
		    << qPrintable(parameter.name()) << " cannot be written in Python";
}

} // namespace

TEST(Python, NoParameterIsAKeyword)
{
	MeshLabHost& host = freshHost();
	host.open(sample("pebble.ply"));
	for (const QString& filter : kFilters)
		expectKeywordArguments(host.openDialog(filter));
	PluginManager& plugins = meshlab::pluginManagerInstance();
	expectKeywordArguments(plugins.inputMeshPlugin("wmc")->initPreOpenParameter("WMC"));
	expectKeywordArguments(plugins.outputMeshPlugin("wmc")->initSaveParameter("WMC", host.mesh()));
}

TEST(Python, ResultsAreNumbers)
{
	for (const QString& filter : kFilters) {
		SCOPED_TRACE(filter.toStdString());
		MeshLabHost& host = freshHost();
		host.open(sample("pebble.ply"));
		const auto results = host.apply(filter);
		EXPECT_FALSE(results.empty());
		for (const auto& [name, value] : results) {
			const auto type = QMetaType::Type(value.type());
			EXPECT_TRUE(
			    type == QMetaType::Int || type == QMetaType::Double || type == QMetaType::Bool)
			    << name << " is a " << value.typeName();
		}
	}
}

TEST(Python, ALevelPastTheLastIsTheFinestAndNoNumberIsRefused)
{
	constexpr char kBrowse[] = "Wavemesh: Browse Levels";
	MeshLabHost& host        = freshHost();
	host.open(sample("pebble.ply"));
	host.apply(kBrowse, {{"level", "0"}});
	const auto shown = host.apply(kBrowse, {{"level", "1000"}});
	EXPECT_EQ(shown.at("level"), shown.at("finest_level"));
	EXPECT_TRUE(messageOf([&] { host.apply(kBrowse, {{"level", "nan"}}); }).contains("'level'"));
}
