// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Wavemesh: Rate-Distortion Report, measured against MeshLab's own Hausdorff Distance.
#include "test_host.h"

#include <wrap/io_trimesh/io_mask.h>

#include <wavemesh/codec.h>

#include <QFile>
#include <QFileInfo>
#include <QImage>
#include <QXmlStreamReader>

#include <cmath>
#include <set>

using namespace wavemesh;
using namespace wavemesh::test;

namespace {

constexpr char kReport[] = "Wavemesh: Rate-Distortion Report";

/// Lines and cells of a report's CSV, without quotes.
std::vector<QStringList> rowsOf(const QString& csv)
{
	std::vector<QStringList> rows;
	for (const QString& line : csv.trimmed().split('\n'))
		rows.push_back(QString(line).remove('"').split(','));
	return rows;
}

/// The table that the last report wrote.
QString writtenCsv()
{
	return QString::fromUtf8(contents(scratch("report.csv")));
}

/// One cell of the row of `configuration` and `level`.
double cell(const QString& csv, const QString& configuration, int level, const QString& column)
{
	const auto rows = rowsOf(csv);
	const int index = rows.front().indexOf(column);
	for (const QStringList& row : rows)
		if (row[0] == configuration && row[1] == QString::number(level))
			return row[index].toDouble();
	return -1;
}

} // namespace

TEST(WavemeshReport, AgreesWithMeshLabsHausdorffDistance)
{
	MeshLabHost& host      = freshHost();
	const MeshModel& layer = *host.open(sample("pretzel.ply")).front();
	const auto results =
	    host.apply(kReport, {{"samples", "40000"}, {"csv", scratch("report.csv")}});
	const QString csv     = writtenCsv();
	const double diagonal = results.at("diagonal").toDouble();
	EXPECT_NEAR(diagonal, double(layer.cm.bbox.Diag()), 1e-5 * diagonal);
	host.save(scratch("I.wmc"), {{"mode", "0"}, {"optimize", "0"}, {"lifting", "0"}, {"wgc", "0"}});
	for (int level : {0, 2, 4}) {
		SCOPED_TRACE(level);
		const MeshModel& m =
		    *host.open(scratch("I.wmc"), {{"level", QString::number(level)}}).front();
		EXPECT_EQ(cell(csv, "I", level, "vertices"), m.cm.vn);
		double rms = 0, max = 0;
		for (const auto& [from, to] : {std::pair(&layer, &m), std::pair(&m, &layer)}) {
			const auto measured = host.apply(
			    "Hausdorff Distance", {{"SampledMesh", QString::number(from->id())},
			                           {"TargetMesh", QString::number(to->id())},
			                           {"SampleFace", "true"},
			                           {"SampleNum", "40000"},
			                           {"MaxDist", QString::number(diagonal)}});
			rms = std::max(rms, measured.at("RMS").toDouble());
			max = std::max(max, measured.at("max").toDouble());
		}
		EXPECT_NEAR(cell(csv, "I", level, "rms_units"), rms, 0.05 * rms);
		EXPECT_NEAR(cell(csv, "I", level, "max_units"), max, 0.1 * max);
		EXPECT_NEAR(cell(csv, "I", level, "rms") * diagonal, rms, 0.05 * rms);
	}
}

TEST(WavemeshReport, CountsTheBytesOfTheFilesThatAreSavedWithoutAttributes)
{
	MeshLabHost& host = freshHost();
	host.open(sample("vase.ply"));
	const auto results =
	    host.apply(kReport, {{"samples", "1000"}, {"own", "false"}, {"config_iii", "false"}});
	EXPECT_EQ(results.count("iii_bytes"), 0u) << "what is not chosen is not reported";
	const struct
	{
		const char *key, *lifting;
	} files[] = {{"i_bytes", "0"}, {"ii_bytes", "1"}};
	for (const auto& file : files) {
		host.save(
		    scratch("vase.wmc"),
		    {{"mode", "0"}, {"optimize", "0"}, {"lifting", file.lifting}, {"wgc", "0"}},
		    vcg::tri::io::Mask::IOM_NONE);
		EXPECT_EQ(results.at(file.key).toLongLong(), QFileInfo(scratch("vase.wmc")).size());
	}
}

TEST(WavemeshReport, OfALayerFromAFileIsThatFiles)
{
	MeshLabHost& host = freshHost();
	host.open(sample("blob.ply"));
	host.save(scratch("own.wmc"), {{"bits", "9"}});
	const qint64 size = QFileInfo(scratch("own.wmc")).size();
	host.clear();
	for (const char* level : {"-1", "1"}) {
		host.open(scratch("own.wmc"), {{"level", level}});
		const auto results = host.apply(
		    kReport, {{"samples", "1000"},
		              {"csv", scratch("report.csv")},
		              {"config_i", "false"},
		              {"config_ii", "false"},
		              {"config_iii", "false"},
		              {"config_compact", "false"}});
		EXPECT_EQ(results.at("own_wmc_bytes").toLongLong(), size);
		EXPECT_LT(results.at("own_wmc_finest_rms").toDouble(), 1e-6)
		    << "it is its own finest level";
		const int levels  = results.at("own_wmc_levels").toInt();
		const QString csv = writtenCsv();
		EXPECT_EQ(rowsOf(csv).size(), std::size_t(levels) + 1);
		EXPECT_EQ(cell(csv, "own .wmc", levels - 1, "prefix"), double(size));
	}
}

TEST(WavemeshReport, WritesCsvAndPictures)
{
	MeshLabHost& host = freshHost();
	host.open(sample("pebble.ply"));
	for (const char* suffix : {"png", "svg"})
		host.apply(
		    kReport, {{"samples", "1000"},
		              {"csv", scratch("report.csv")},
		              {"picture", scratch(QString("report.") + suffix)},
		              {"picture_width", "600"}});
	EXPECT_GT(rowsOf(writtenCsv()).size(), 9u);

	const QImage image(scratch("report.png"));
	ASSERT_EQ(image.width(), 600);
	std::set<QRgb> colours;
	for (int y = 0; y < image.height(); ++y)
		for (int x = 0; x < image.width(); ++x)
			colours.insert(image.pixel(x, y));
	for (const QRgb curve :
	     {qRgb(0x00, 0x72, 0xb2), qRgb(0xd5, 0x5e, 0x00), qRgb(0x00, 0x9e, 0x73)})
		EXPECT_EQ(colours.count(curve), 1u);

	QXmlStreamReader svg(contents(scratch("report.svg")));
	int lines = 0, texts = 0;
	while (!svg.atEnd()) {
		svg.readNext();
		lines += svg.isStartElement() && svg.name() == QString("polyline");
		texts += svg.isStartElement() && svg.name() == QString("text");
	}
	EXPECT_FALSE(svg.hasError()) << qPrintable(svg.errorString());
	EXPECT_GT(lines, 10);
	EXPECT_GT(texts, 10);
}

TEST(WavemeshReport, SaysWhatIsWrongWithTheFilesNamed)
{
	MeshLabHost& host = freshHost();
	host.open(sample("pebble.ply"));
	const QString few = "100";
	EXPECT_TRUE(messageOf([&] {
		            host.apply(kReport, {{"samples", few}, {"picture", scratch("report.jpg")}});
	            }).contains(".svg"));
	EXPECT_TRUE(messageOf([&] {
		            host.apply(kReport, {{"samples", few}, {"csv", scratch("no/folder.csv")}});
	            }).contains("folder.csv"));
	EXPECT_NE(
	    messageOf([&] {
		    host.apply(
		        kReport, {{"own", "false"},
		                  {"config_i", "false"},
		                  {"config_ii", "false"},
		                  {"config_iii", "false"},
		                  {"config_compact", "false"}});
	    }),
	    QString());
}
