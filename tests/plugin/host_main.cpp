// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// meshlab_host: takes meshes through Wavemesh in a headless MeshLab, as a user would: simplify by
/// a filter script, save as .wmc, reopen at every level, and compare with the original by MeshLab's
/// own Hausdorff Distance filter.
#include "meshlab_host.h"

#include <wavemesh/codec.h>

#include <common/mlexception.h>

#include <QApplication>
#include <QCommandLineParser>
#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QFileInfo>

#include <algorithm>
#include <cmath>
#include <cstdio>

using wavemesh::MeshLabHost;

namespace {

struct Distance
{
	double rms = 0; ///< relative to the bounding box' diagonal
	double max = 0; ///< model units
};

/// Both ways, the larger. Sampled over the faces, or at the vertices alone.
Distance distance(MeshLabHost& host, const MeshModel& a, const MeshModel& b, bool atVertices)
{
	Distance d;
	for (const auto& [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
		const auto results = host.apply(
		    "Hausdorff Distance", {{"SampledMesh", QString::number(from->id())},
		                           {"TargetMesh", QString::number(to->id())},
		                           {"SampleVert", "true"},
		                           {"SampleFace", atVertices ? "false" : "true"},
		                           {"SampleNum", QString::number(atVertices ? from->cm.vn : 5000)},
		                           {"MaxDist", QString::number(double(a.cm.bbox.Diag()))}});
		d.rms = std::max(d.rms, results.at("RMS").toDouble() / double(a.cm.bbox.Diag()));
		d.max = std::max(d.max, results.at("max").toDouble());
	}
	return d;
}

wavemesh::StreamInfo infoOf(const QString& file)
{
	QFile f(file);
	if (!f.open(QIODevice::ReadOnly))
		throw MLException("Cannot read " + file);
	const QByteArray bytes = f.readAll();
	auto info              = wavemesh::readInfo(
	                 reinterpret_cast<const std::uint8_t*>(bytes.constData()), std::size_t(bytes.size()));
	if (!info.ok())
		throw MLException(file + ": " + QString::fromStdString(info.status().what));
	return *info;
}

void simplify(MeshLabHost& host, const QString& input, const QString& script, const QString& output)
{
	host.clear();
	const int before = host.open(input).front()->cm.fn;
	for (const auto& step : host.run(script)) {
		std::printf("  %s: %d -> %d faces (", qPrintable(step.filter), before, host.mesh().cm.fn);
		const char* separator = "";
		for (const auto& [name, value] : step.results) {
			const bool isReal = value.type() == QVariant::Double;
			const QString text =
			    isReal ? QString::number(value.toDouble(), 'g', 3) : value.toString();
			std::printf("%s%s %s", separator, name.c_str(), qPrintable(text));
			separator = ", ";
		}
		std::printf(")\n");
	}
	host.save(output);
}

/// Prints the table of levels. @return is the finest level the original, within the lattice?
bool printLevels(MeshLabHost& host, const QString& input, const QString& output)
{
	host.clear();
	const MeshModel& original = *host.open(input).front();
	host.save(output);
	const wavemesh::StreamInfo info = infoOf(output);

	std::printf(
	    "  %5s %9s %9s %10s %10s %8s %15s\n", "level", "vertices", "faces", "bytes", "file up to",
	    "bpv", "RMS error");
	bool same = false;
	for (int level = 0; level <= info.finestLevel(); ++level) {
		const MeshModel& m = *host.open(output, {{"level", QString::number(level)}}).front();
		const auto& row    = info.levels[std::size_t(level)];
		std::printf(
		    "  %5d %9d %9d %10llu %10llu %8.2f %13.4f %%\n", level, m.cm.vn, m.cm.fn,
		    static_cast<unsigned long long>(row.bytes), static_cast<unsigned long long>(row.prefix),
		    8.0 * double(row.prefix) / double(info.vertices),
		    100 * distance(host, original, m, false).rms);
		if (level == info.finestLevel()) {
			// Half a step in each coordinate, and what float arithmetic adds to it.
			const double bound =
			    0.5 * std::sqrt(3.0) * info.step + 1e-6 * double(original.cm.bbox.Diag());
			same = m.cm.vn == original.cm.vn && m.cm.fn == original.cm.fn &&
			       distance(host, original, m, true).max <= bound;
		}
		host.document().delMesh(m.id());
	}
	std::printf(
	    "  %d bits per coordinate; the finest level %s the original (step %g)\n", info.bits,
	    same ? "is" : "IS NOT", info.step);
	return same;
}

/// Prints how fast the levels of a mesh follow the slider of Browse Levels: up from the base mesh
/// the first time, when they are decoded on the way, and again.
void printBrowsingSpeed(MeshLabHost& host, const QString& input, const QString& output)
{
	host.clear();
	host.open(input);
	host.save(output);
	host.clear();
	host.open(output, {{"level", "0"}});
	const int finest = infoOf(output).finestLevel();
	for (const char* round : {"first time", "again"}) {
		double slowest = 0, all = 0;
		for (int i = 1; i <= 2 * finest; ++i) { // up, and down again
			const int level = i <= finest ? i : 2 * finest - i;
			QElapsedTimer watch;
			watch.start();
			host.apply("Wavemesh: Browse Levels", {{"level", QString::number(level)}});
			const double seconds = 1e-9 * double(watch.nsecsElapsed());
			all += seconds;
			slowest = std::max(slowest, seconds);
		}
		std::printf(
		    "  %-10s  %d levels in %.2f s: %.1f levels/s; the slowest took %.2f s\n", round,
		    2 * finest, all, 2 * finest / all, slowest);
	}
}

} // namespace

int main(int argc, char** argv)
{
	if (qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM"))
		qputenv("QT_QPA_PLATFORM", "offscreen");
	qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
	QApplication app(argc, argv);
	QCommandLineParser options;
	options.setApplicationDescription(
	    "Takes meshes through Wavemesh in a headless MeshLab and prints a table of their levels.");
	options.addHelpOption();
	options.addPositionalArgument("mesh", "Mesh files that MeshLab opens.", "MESH...");
	options.addOption({"plugins", "Load a plugin, or all of a folder.", "path"});
	options.addOption({"script", "Run a filter script on each mesh first.", "file.mlx"});
	options.addOption({"out", "Where the .wmc files go.", "folder", "."});
	options.addOption({"browse", "Measure how fast Browse Levels follows its slider instead."});
	options.process(app);

	bool allSame = true;
	try {
		MeshLabHost host;
		for (const QString& path : options.values("plugins"))
			host.loadPlugins(path);
		QDir().mkpath(options.value("out"));
		for (const QString& input : options.positionalArguments()) {
			const QString name = options.value("out") + "/" + QFileInfo(input).completeBaseName();
			std::printf("\n%s\n", qPrintable(QFileInfo(input).fileName()));
			if (options.isSet("browse")) {
				printBrowsingSpeed(host, input, name + ".wmc");
				continue;
			}
			if (options.isSet("script"))
				simplify(host, input, options.value("script"), name + "_simplified.wmc");
			allSame = printLevels(host, input, name + ".wmc") && allSame;
			std::fflush(stdout);
		}
	}
	catch (const MLException& e) {
		std::fflush(stdout);
		std::fprintf(stderr, "meshlab_host: %s\n", e.what());
		return 1;
	}
	return allSame ? 0 : 1;
}
