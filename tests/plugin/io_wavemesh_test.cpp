// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// io_wavemesh, opened and saved through MeshLab's own loading and saving.
#include "test_host.h"

#include <wavemesh/codec.h>

#include <QDir>
#include <QFile>
#include <QFileInfo>

#include <array>
#include <cmath>
#include <cstring>
#include <set>

using namespace wavemesh;
using namespace wavemesh::test;

namespace {

/// A sample saved as .wmc by the plugin, and what its head says.
struct SavedSample
{
	QString original = sample("pretzel.ply");
	QString file     = scratch("sample.wmc");
	QByteArray bytes;
	StreamInfo info;

	SavedSample()
	{
		MeshLabHost& host = freshHost();
		host.open(original);
		host.save(file);
		bytes = contents(file);
		info  = *readInfo(
		     reinterpret_cast<const std::uint8_t*>(bytes.constData()), std::size_t(bytes.size()));
		host.clear();
	}

	/// The first `size` bytes, as a file.
	QString prefix(std::uint64_t size) const
	{
		writeFile(scratch("prefix.wmc"), bytes.left(int(size)));
		return scratch("prefix.wmc");
	}
};

QString openingMessage(const QByteArray& bytes)
{
	writeFile(scratch("bad.wmc"), bytes);
	return messageOf([] { freshHost().open(scratch("bad.wmc")); });
}

double hausdorffAtVertices(MeshLabHost& host, const MeshModel& from, const MeshModel& to)
{
	return host
	    .apply(
	        "Hausdorff Distance", {{"SampledMesh", QString::number(from.id())},
	                               {"TargetMesh", QString::number(to.id())},
	                               {"SampleVert", "true"},
	                               {"SampleNum", QString::number(from.cm.vn)}})
	    .at("max")
	    .toDouble();
}

} // namespace

TEST(IoWavemesh, FinestLevelIsTheOriginalWithinHalfAStep)
{
	const SavedSample saved;
	MeshLabHost& host         = freshHost();
	const MeshModel& original = *host.open(saved.original).front();
	const MeshModel& finest   = *host.open(saved.file).front();
	EXPECT_EQ(finest.cm.vn, original.cm.vn);
	EXPECT_EQ(finest.cm.fn, original.cm.fn);
	const double bound = 0.5 * std::sqrt(3.0) * saved.info.step * 1.001;
	EXPECT_LE(hausdorffAtVertices(host, original, finest), bound);
	EXPECT_LE(hausdorffAtVertices(host, finest, original), bound);
}

TEST(IoWavemesh, EveryLevelHasTheCountsOfTheHeadAndTheTopologyOfTheOriginal)
{
	const SavedSample saved;
	MeshLabHost& host = freshHost();
	ASSERT_GT(saved.info.finestLevel(), 1);
	host.open(saved.original);
	const auto expected = host.apply("Compute Topological Measures");
	for (int level = 0; level <= saved.info.finestLevel(); ++level) {
		SCOPED_TRACE(level);
		const MeshModel& m = *host.open(saved.file, {{"level", QString::number(level)}}).front();
		EXPECT_EQ(std::uint32_t(m.cm.vn), saved.info.levels[std::size_t(level)].vertices);
		EXPECT_EQ(std::uint32_t(m.cm.fn), saved.info.levels[std::size_t(level)].faces);
		const auto measured = host.apply("Compute Topological Measures");
		EXPECT_TRUE(measured.at("is_mesh_two_manifold").toBool());
		for (const char* name : {"genus", "number_holes", "connected_components_number"})
			EXPECT_EQ(measured.at(name).toInt(), expected.at(name).toInt()) << name;
	}
}

TEST(IoWavemesh, ALevelPastTheFinestAndMinusOneMeanTheFinest)
{
	const SavedSample saved;
	for (const char* level : {"-1", "1000"})
		EXPECT_EQ(
		    std::uint32_t(freshHost().open(saved.file, {{"level", level}}).front()->cm.vn),
		    saved.info.vertices);
}

TEST(IoWavemesh, ATruncatedFileOpensWithAWarning)
{
	const SavedSample saved;
	const int level = saved.info.finestLevel() - 1;
	for (const std::uint64_t more : {0, 1, 40}) {
		SCOPED_TRACE(more);
		MeshLabHost& host    = freshHost();
		const LevelInfo& row = saved.info.levels[std::size_t(level)];
		const MeshModel& m   = *host.open(saved.prefix(row.prefix + more)).front();
		const QString warned = host.takeWarnings();
		EXPECT_GE(std::uint32_t(m.cm.vn), row.vertices);
		EXPECT_FALSE(warned.isEmpty());
	}
	MeshLabHost& host = freshHost();
	host.open(saved.file);
	EXPECT_EQ(host.takeWarnings(), QString()) << "a whole file opens without one";
}

TEST(IoWavemesh, CorruptForeignAndEmptyFilesAreRefusedWithoutALayer)
{
	const SavedSample saved;
	QByteArray flipped          = saved.bytes;
	flipped[flipped.size() / 2] = char(flipped[flipped.size() / 2] ^ 0x10);
	const QByteArray bad[]      = {
	         {},
	         "x",
	         "ply\nformat ascii 1.0\nend_header\n",
	         QByteArray(4096, '\0'),
	         saved.bytes.left(40),
	         flipped,
	         saved.bytes.mid(1)};
	for (const QByteArray& bytes : bad) {
		SCOPED_TRACE(bytes.size());
		EXPECT_NE(openingMessage(bytes), QString());
		EXPECT_EQ(freshHost().document().meshNumber(), 0u);
		EXPECT_EQ(std::uint32_t(freshHost().open(saved.file).front()->cm.vn), saved.info.vertices)
		    << "MeshLab goes on";
	}
}

TEST(IoWavemesh, EveryPrefixOpensOrIsRefused)
{
	const SavedSample saved;
	const int stride = std::max(1, saved.bytes.size() / 300);
	for (int size = 0; size < saved.bytes.size(); size += stride) {
		SCOPED_TRACE(size);
		MeshLabHost& host   = freshHost();
		const QString error = messageOf([&] { host.open(saved.prefix(std::uint64_t(size))); });
		if (std::uint64_t(size) >= saved.info.levels[0].prefix) {
			EXPECT_EQ(error, QString());
			EXPECT_GE(std::uint32_t(host.mesh().cm.vn), saved.info.levels[0].vertices);
		}
		else
			EXPECT_NE(error, QString());
	}
}

TEST(IoWavemesh, SavingWithFewerBitsGivesASmallerFile)
{
	const SavedSample saved;
	MeshLabHost& host = freshHost();
	host.open(saved.original);
	host.save(scratch("coarse.wmc"), {{"bits", "8"}});
	EXPECT_LT(contents(scratch("coarse.wmc")).size(), saved.bytes.size());
}

TEST(IoWavemesh, APresetSetsWhatItIsAboutAndKeepsThePrecision)
{
	MeshLabHost& host = freshHost();
	host.open(sample("pebble.ply"));
	const auto saved = [&](const char* preset) {
		host.save(
		    scratch("preset.wmc"),
		    {{"preset", preset}, {"bits", "11"}, {"mode", "0"}, {"lifting", "3"}});
		const QByteArray bytes = contents(scratch("preset.wmc"));
		return *readInfo(
		    reinterpret_cast<const std::uint8_t*>(bytes.constData()), std::size_t(bytes.size()));
	};
	EXPECT_EQ(saved("0").lifting, 2) << "as set below";
	EXPECT_EQ(saved("0").mode, Mode::Classic);
	for (const char* preset : {"1", "2", "3", "4"}) {
		SCOPED_TRACE(preset);
		const StreamInfo info = saved(preset);
		EXPECT_EQ(info.lifting, kLiftingOff);
		EXPECT_EQ(info.bits, 11);
		EXPECT_EQ(info.features.exact, preset[0] == '4');
	}
	EXPECT_LE(saved("1").bytes, saved("2").bytes);
	EXPECT_NE(messageOf([&] { host.save(scratch("preset.wmc"), {{"preset", "9"}}); }), QString());
}

TEST(IoWavemesh, ExactCoordinatesComeBackBitForBit)
{
	const auto coordinates = [](const MeshModel& m) {
		std::multiset<std::array<std::uint32_t, 3>> all;
		for (const auto& v : m.cm.vert) {
			std::array<std::uint32_t, 3> bits;
			std::memcpy(bits.data(), v.cP().V(), sizeof bits);
			all.insert(bits);
		}
		return all;
	};
	MeshLabHost& host     = freshHost();
	const MeshModel& from = *host.open(sample("island.ply")).front();
	host.save(scratch("exact.wmc"), {{"exact", "true"}, {"bits", "9"}});
	EXPECT_TRUE(coordinates(*host.open(scratch("exact.wmc")).front()) == coordinates(from));
}

TEST(IoWavemesh, TheOrderOfVerticesAndFacesComesBackIfAsked)
{
	MeshLabHost& host     = freshHost();
	const MeshModel& from = *host.open(sample("island.ply")).front();
	host.save(scratch("order.wmc"), {{"exact", "true"}, {"keep_order", "true"}});
	const MeshModel& back = *host.open(scratch("order.wmc")).front();
	ASSERT_EQ(back.cm.vn, from.cm.vn);
	ASSERT_EQ(back.cm.fn, from.cm.fn);
	for (std::size_t v = 0; v < from.cm.vert.size(); ++v)
		ASSERT_EQ(back.cm.vert[v].cP(), from.cm.vert[v].cP()) << v;
	for (std::size_t f = 0; f < from.cm.face.size(); ++f)
		for (int k = 0; k < 3; ++k)
			ASSERT_EQ(
			    vcg::tri::Index(back.cm, back.cm.face[f].cV(k)),
			    vcg::tri::Index(from.cm, from.cm.face[f].cV(k)));
}

TEST(IoWavemesh, AProjectComesBackWithEveryLevelAsALayer)
{
	const SavedSample saved;
	const QString folder = scratch("project");
	QDir().mkpath(folder);
	QFile::copy(saved.file, folder + "/whole.wmc");
	MeshLabHost& host = freshHost();
	host.open(folder + "/whole.wmc", {{"all_levels", "true"}});
	struct Layer
	{
		QString label;
		int vertices, faces;
		bool operator==(const Layer& o) const
		{
			return label == o.label && vertices == o.vertices && faces == o.faces;
		}
	};
	const auto layers = [&] {
		std::vector<Layer> all;
		for (const MeshModel& m : host.document().meshIterator())
			all.push_back({m.label(), m.cm.vn, m.cm.fn});
		return all;
	};
	const auto before = layers();
	ASSERT_EQ(int(before.size()), saved.info.finestLevel() + 1);
	EXPECT_TRUE(before[1].label.contains("level 1 of")) << qPrintable(before[1].label);
	const qint64 size = QFileInfo(folder + "/whole.wmc").size();

	for (const bool layersToo : {false, true}) {
		host.saveProject(folder + "/levels.mlp", layersToo);
		EXPECT_NEAR(
		    double(QFileInfo(folder + "/whole.wmc").size()), double(size), 0.02 * double(size))
		    << "a coarse level must not be saved over the whole file";
		EXPECT_EQ(QDir(folder).exists("whole@1.wmc"), layersToo);
		host.clear();
		host.openProject(folder + "/levels.mlp");
		EXPECT_TRUE(layers() == before);
	}
}

TEST(IoWavemesh, AProjectAndReloadingKeepTheLevelOfALayer)
{
	const SavedSample saved;
	const QString folder = scratch("coarse-project");
	QDir().mkpath(folder);
	QFile::copy(saved.file, folder + "/whole.wmc");
	MeshLabHost& host   = freshHost();
	MeshModel* layer    = host.open(folder + "/whole.wmc", {{"level", "1"}}).front();
	const int vertices  = layer->cm.vn;
	const QString label = layer->label();
	EXPECT_LT(std::uint32_t(vertices), saved.info.vertices);
	host.saveProject(folder + "/coarse.mlp", false);
	host.clear();
	host.openProject(folder + "/coarse.mlp");
	layer = host.document().mm();
	EXPECT_EQ(layer->cm.vn, vertices);
	EXPECT_EQ(layer->label(), label);
	host.reload(*layer);
	EXPECT_EQ(layer->cm.vn, vertices);

	// Browsed to the end, the layer has the name of the whole file again.
	host.apply("Wavemesh: Browse Levels", {{"level", "-1"}});
	EXPECT_EQ(layer->shortName(), "whole.wmc");
	host.reload(*layer);
	EXPECT_EQ(std::uint32_t(layer->cm.vn), saved.info.vertices);

	// A file of such a name is what it is.
	host.apply("Wavemesh: Browse Levels", {{"level", "0"}});
	const int coarsest = layer->cm.vn;
	host.save(folder + "/whole@1.wmc");
	EXPECT_EQ(host.open(folder + "/whole@1.wmc").front()->cm.vn, coarsest);
	EXPECT_THROW(host.open(folder + "/none@1.wmc"), MLException);
}
