// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Wavemesh: Colour by Detail and Wavemesh: Equalise Detail.
#include "test_host.h"

#include <wavemesh/multiresolution.h>
#include <wavemesh/vcg_wmc.h>

#include <cmath>
#include <cstring>
#include <random>

using namespace wavemesh;
using namespace wavemesh::test;

namespace {

constexpr char kColour[]   = "Wavemesh: Colour by Detail";
constexpr char kEqualise[] = "Wavemesh: Equalise Detail";

/// Coordinates, normals, colours, quality and faces of a layer, as bytes.
struct Everything
{
	QByteArray coordinates, faces, others;

	explicit Everything(const CMeshO& m)
	{
		const auto add = [](QByteArray& bytes, const auto& value) {
			bytes.append(reinterpret_cast<const char*>(&value), int(sizeof value));
		};
		for (const auto& v : m.vert) {
			add(coordinates, v.cP());
			add(others, v.cC());
			add(others, v.cQ());
			add(others, v.IsS());
		}
		for (const auto& f : m.face)
			for (int k = 0; k < 3; ++k) {
				add(faces, vcg::tri::Index(m, f.cV(k)));
				if (vcg::tri::HasPerWedgeTexCoord(m))
					add(others, f.cWT(k).P());
			}
	}
};

/// Of whole details, in all bands.
MeshLabHost::Settings gains(double gain)
{
	MeshLabHost::Settings settings {{"normal_only", "false"}};
	for (int band = 1; band <= 5; ++band)
		settings[QString("band_%1").arg(band)] = QString::number(gain);
	return settings;
}

double rms(MeshLabHost& host, const MeshModel& from, const MeshModel& to)
{
	return host
	    .apply(
	        "Hausdorff Distance", {{"SampledMesh", QString::number(from.id())},
	                               {"TargetMesh", QString::number(to.id())},
	                               {"SampleFace", "true"},
	                               {"SampleNum", "20000"},
	                               {"MaxDist", QString::number(double(to.cm.bbox.Diag()))}})
	    .at("RMS")
	    .toDouble();
}

} // namespace

TEST(ColourByDetail, QualityIsTheDetailAndMeshLabsStatisticsAgree)
{
	for (const char* measure : {"0", "1", "2"}) {
		SCOPED_TRACE(measure);
		MeshLabHost& host  = freshHost();
		MeshModel& layer   = *host.open(sample("pretzel.ply")).front();
		const auto results = host.apply(kColour, {{"measure", measure}});
		const auto stats   = host.apply("Per Vertex Quality Stat");
		EXPECT_FLOAT_EQ(results.at("min").toFloat(), stats.at("min").toFloat());
		EXPECT_FLOAT_EQ(results.at("max").toFloat(), stats.at("max").toFloat());
		EXPECT_NEAR(
		    results.at("mean").toDouble(), stats.at("avg").toDouble(),
		    1e-4 * results.at("max").toDouble());

		const MeshData mesh = toMeshData(layer.cm);
		const auto levels   = Multiresolution::of(mesh);
		ASSERT_TRUE(levels.ok());
		const auto expected =
		    measureDetails(*levels, mesh.positions, DetailMeasure(QString(measure).toInt()));
		for (std::size_t v = 0; v < expected.size(); ++v)
			ASSERT_FLOAT_EQ(float(layer.cm.vert[v].cQ()), float(expected[v]));
	}
}

TEST(ColourByDetail, ColoursFollowMeshLabsRampFromRedToBlue)
{
	MeshLabHost& host  = freshHost();
	MeshModel& layer   = *host.open(sample("blob.ply")).front();
	const auto results = host.apply(kColour);
	EXPECT_TRUE(layer.hasDataMask(MeshModel::MM_VERTCOLOR));
	EXPECT_TRUE(layer.hasDataMask(MeshModel::MM_VERTQUALITY));
	const auto low = results.at("ramp_low").toFloat(), high = results.at("ramp_high").toFloat();
	ASSERT_LT(low, high);
	for (const auto& v : layer.cm.vert) {
		vcg::Color4b expected;
		expected.SetColorRamp(low, high, float(v.cQ()));
		ASSERT_EQ(v.cC(), expected);
	}
}

TEST(ColourByDetail, GreenIsNeitherInsideNorOutside)
{
	MeshLabHost& host  = freshHost();
	MeshModel& layer   = *host.open(sample("blob.ply")).front();
	const auto results = host.apply(kColour, {{"measure", "1"}});
	const auto low = results.at("ramp_low").toFloat(), high = results.at("ramp_high").toFloat();
	ASSERT_GT(high, 0);
	EXPECT_EQ(low, -high);
	vcg::Color4b neither;
	neither.SetColorRamp(low, high, 0.f);
	EXPECT_EQ(neither, vcg::Color4b(0, 255, 0, 255));
	for (const auto& v : layer.cm.vert) {
		vcg::Color4b expected;
		expected.SetColorRamp(low, high, float(v.cQ()));
		ASSERT_EQ(v.cC(), expected);
	}
}

TEST(EqualiseDetail, GainsOfOneLeaveTheLayerBitForBit)
{
	for (const char* name : {"pretzel.ply", "island.ply", "pieces.ply"}) {
		SCOPED_TRACE(name);
		MeshLabHost& host       = freshHost();
		MeshModel& layer        = *host.open(sample(name)).front();
		layer.cm.vert[0].P()[0] = Scalarm(-0.0);
		const Everything before(layer.cm);
		const auto results = host.apply(kEqualise, gains(1));
		EXPECT_EQ(results.at("moved").toInt(), 0);
		const Everything after(layer.cm);
		EXPECT_EQ(before.coordinates, after.coordinates);
		EXPECT_EQ(before.faces, after.faces);
		EXPECT_EQ(before.others, after.others);
	}
}

TEST(EqualiseDetail, MovesVerticesAndChangesNothingElse)
{
	MeshLabHost& host = freshHost();
	MeshModel& layer  = *host.open(sample("blob.ply")).front();
	layer.updateDataMask(
	    MeshModel::MM_VERTCOLOR | MeshModel::MM_VERTQUALITY | MeshModel::MM_WEDGTEXCOORD);
	std::mt19937 random(5);
	for (auto& v : layer.cm.vert) {
		v.C() = vcg::Color4b(random() % 256, random() % 256, random() % 256, 255);
		v.Q() = Scalarm(random() % 1000);
		if (random() % 2)
			v.SetS();
	}
	for (auto& f : layer.cm.face)
		for (int k = 0; k < 3; ++k)
			f.WT(k).P() = {float(random() % 100), float(random() % 100)};
	const Everything before(layer.cm);
	const auto results = host.apply(kEqualise, gains(1.5));
	EXPECT_GT(results.at("moved").toInt(), layer.cm.vn / 2);
	EXPECT_GT(results.at("largest_move").toDouble(), 0);
	const Everything after(layer.cm);
	EXPECT_NE(before.coordinates, after.coordinates);
	EXPECT_EQ(before.faces, after.faces);
	EXPECT_EQ(before.others, after.others);
}

TEST(EqualiseDetail, DetailsTakeUpSurface)
{
	MeshLabHost& host = freshHost();
	const auto area   = [&](double gain) {
        host.clear();
        host.open(sample("blob.ply"));
        host.apply(kEqualise, gains(gain));
        return host.apply("Compute Geometric Measures").at("surface_area").toDouble();
	};
	const double original = area(1);
	EXPECT_LT(area(0), 0.98 * original);
	EXPECT_GT(area(1.5), 1.02 * original);
}

TEST(EqualiseDetail, AThresholdBringsANoisyMeshCloserToTheCleanOne)
{
	MeshLabHost& host      = freshHost();
	const MeshModel& clean = *host.open(sample("blob.ply")).front();
	MeshModel& noisy       = *host.open(sample("blob.ply")).front();
	std::mt19937 random(9);
	std::uniform_real_distribution<double> noise(-0.003, 0.003);
	for (auto& v : noisy.cm.vert)
		v.P() += v.cN().normalized() * Scalarm(noise(random) * double(clean.cm.bbox.Diag()));
	noisy.updateBoxAndNormals();
	const double before = rms(host, noisy, clean);
	host.apply(kEqualise, {{"threshold", "0.25"}});
	EXPECT_LT(rms(host, noisy, clean), 0.85 * before);
}

TEST(EqualiseDetail, AnEqualisedLayerFromAFileIsBrowsedAsItIs)
{
	MeshLabHost& host = freshHost();
	host.open(sample("pretzel.ply"));
	host.save(scratch("equalised.wmc"));
	for (const bool browsedBefore : {false, true}) {
		SCOPED_TRACE(browsedBefore);
		host.clear();
		MeshModel& layer  = *host.open(scratch("equalised.wmc")).front();
		const auto browse = [&](const char* level) {
			host.apply("Wavemesh: Browse Levels", {{"level", level}});
		};
		if (browsedBefore) {
			browse("0");
			browse("-1");
		}
		host.apply(kEqualise, gains(0));
		const Everything smooth(layer.cm);
		browse("0");
		browse("-1");
		EXPECT_EQ(Everything(layer.cm).coordinates, smooth.coordinates);
		EXPECT_EQ(Everything(layer.cm).faces, smooth.faces);
	}
}

TEST(EqualiseDetail, GainsByLevelAreThoseOfTheirBands)
{
	MeshLabHost& host = freshHost();
	MeshModel& layer  = *host.open(sample("pretzel.ply")).front();
	const int finest  = host.apply(kEqualise).at("finest_level").toInt();
	host.apply(kEqualise, gains(0.5));
	const Everything byBands(layer.cm);
	QStringList all;
	for (int level = 1; level <= finest; ++level)
		all << "0.5";
	MeshModel& other = *host.open(sample("pretzel.ply")).front();
	host.apply(kEqualise, {{"gains", all.join(", ")}, {"normal_only", "false"}});
	EXPECT_EQ(Everything(other.cm).coordinates, byBands.coordinates);
	EXPECT_NE(messageOf([&] { host.apply(kEqualise, {{"gains", "1, x"}}); }), QString());
}
