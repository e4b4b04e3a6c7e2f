// SPDX-License-Identifier: GPL-3.0-or-later
#include "detail_filters.h"

#include <shared/layer_stream.h>
#include <shared/plugin_support.h>

#include <wavemesh/vcg_wmc.h>

#include <vcg/complex/algorithms/stat.h>

#include <QStringList>

#include <algorithm>
#include <cmath>

namespace wavemesh {
namespace {

constexpr int kThresholdLevels = 2;

/// Positions of the vertices that are not deleted, in their order.
std::vector<Vec3> positionsOf(const CMeshO& m)
{
	std::vector<Vec3> positions;
	positions.reserve(std::size_t(m.vn));
	for (const CVertexO& v : m.vert)
		if (!v.IsD())
			positions.push_back({double(v.cP()[0]), double(v.cP()[1]), double(v.cP()[2])});
	return positions;
}

QString bandParameter(int band)
{
	return QString("band_%1").arg(band + 1);
}

/// "levels 3 to 5", "level 2" or "no level".
QString levelsOfBand(int band, int finest)
{
	int first = 0, last = 0;
	for (int level = 1; level <= finest; ++level)
		if (bandOf(level, finest) == band) {
			first = first == 0 ? level : first;
			last  = level;
		}
	if (first == 0)
		return "no level";
	return first == last ? QString("level %1").arg(first)
	                     : QString("levels %1 to %2").arg(first).arg(last);
}

/// By level, [0] unused.
std::vector<double> gainsOf(const RichParameterList& list, int finest)
{
	std::vector<double> gains(std::size_t(finest) + 1, 1);
	for (int level = 1; level <= finest; ++level)
		gains[std::size_t(level)] = numberOf(list, bandParameter(bandOf(level, finest)), 1);
	const QString text = textOf(list, "gains", "").simplified();
	if (!text.isEmpty()) {
		const QStringList words = text.split(text.contains(',') ? ',' : ' ');
		for (int i = 0; i < words.size() && i < finest; ++i) {
			bool isNumber             = false;
			gains[std::size_t(i) + 1] = words[i].trimmed().toDouble(&isNumber);
			if (!isNumber)
				throw MLException(
				    "Wavemesh: '" + words[i] + "' in the list of gains is no number.");
		}
	}
	for (const double gain : gains)
		if (!(std::fabs(gain) <= 1000))
			throw MLException("Wavemesh: a gain has to be -1000 to 1000.");
	return gains;
}

} // namespace

const DetailPyramid& PyramidCache::of(const MeshModel& layer, Wgc wgc)
{
	const std::uint64_t now = fingerprint(layer.cm, Extent::Shape);
	if (!pyramid_ || now != fingerprint_ || wgc != wgc_) {
		pyramid_.reset();
		MultiresolutionOptions options;
		options.wgc = wgc;
		auto made   = DetailPyramid::of(toMeshData(layer.cm), options);
		require(made.status(), "Cannot make levels of " + layer.label());
		pyramid_     = std::move(*made);
		fingerprint_ = now;
		wgc_         = wgc;
	}
	return *pyramid_;
}

static void addCriterionParameter(RichParameterList& list)
{
	list.addParam(RichEnum(
	    "wgc", int(Wgc::On), {"off", "on"}, "Geometrical criterion (WGC)",
	    "Keep the vertices of sharp edges and corners in the coarse levels.", true));
}

Wgc criterionOf(const RichParameterList& list)
{
	return integerOf(list, "wgc", int(Wgc::On)) == 0 ? Wgc::Off : Wgc::On;
}

void addDetailParameters(RichParameterList& list)
{
	list.addParam(RichEnum(
	    "measure", int(DetailMeasure::Length),
	    {"length of the detail", "normal component", "level of birth"}, "Quality",
	    "What becomes the quality of a vertex. <b>length</b> of its detail, the wavelet "
	    "coefficient: how far, in model units, it lies from where its parents predict it. "
	    "<b>normal component</b>: how far it lies outside (above 0, towards blue) or inside "
	    "(below 0, towards red) of the coarser surface; green is neither. <b>level of birth</b>: "
	    "the coarsest level that has it, 0 is the base mesh."));
	list.addParam(RichEnum(
	    "lifting", -kLiftingOff, {"off", "0-disc", "1-disc", "2-disc"}, "Lifting",
	    "Coarse vertices are moved to make the coarse levels smoother and closer to the original, "
	    "using the details around them. <b>off</b>: coarse vertices are vertices of the original.",
	    true));
	addCriterionParameter(list);
}

std::map<std::string, QVariant> colourByDetail(MeshModel& layer, const RichParameterList& list)
{
	const int choice = integerOf(list, "measure", int(DetailMeasure::Length));
	if (choice < 0 || choice > int(DetailMeasure::Birth))
		throw MLException("Wavemesh: 'measure' has to be 0 to 2.");
	const auto measure = DetailMeasure(choice);
	MultiresolutionOptions options;
	options.wgc         = criterionOf(list);
	options.lifting     = kLiftingOff + integerOf(list, "lifting", -kLiftingOff);
	const MeshData mesh = toMeshData(layer.cm);
	const auto levels   = Multiresolution::of(mesh, options);
	require(levels.status(), "Cannot make levels of " + layer.label());
	const std::vector<double> measured = measureDetails(*levels, mesh.positions, measure);

	layer.updateDataMask(MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR);
	std::size_t row = 0;
	double sum      = 0;
	for (CVertexO& v : layer.cm.vert)
		if (!v.IsD()) {
			sum += measured[row];
			v.Q() = Scalarm(measured[row++]);
		}
	// The ramp of MeshLab's own filters leaves out a tenth at either end, which levels have not.
	vcg::Histogram<Scalarm> histogram;
	vcg::tri::Stat<CMeshO>::ComputePerVertexQualityHistogram(layer.cm, histogram);
	const auto range = vcg::tri::Stat<CMeshO>::ComputePerVertexQualityMinMax(layer.cm);
	Scalarm low = range.first, high = range.second;
	if (measure != DetailMeasure::Birth &&
	    histogram.Percentile(0.9f) > histogram.Percentile(0.1f)) {
		low  = histogram.Percentile(0.1f);
		high = histogram.Percentile(0.9f);
	}
	if (measure == DetailMeasure::Normal) { // the same colour for "neither in nor out" everywhere
		high = std::max(std::fabs(low), std::fabs(high));
		low  = -high;
	}
	vcg::tri::UpdateColor<CMeshO>::PerVertexQualityRamp(layer.cm, low, high);
	return {{"min", double(range.first)}, {"max", double(range.second)},
	        {"mean", sum / double(row)},  {"ramp_low", double(low)},
	        {"ramp_high", double(high)},  {"finest_level", levels->finestLevel()}};
}

int bandOf(int level, int finest)
{
	return (level * kBands - 1) / std::max(finest, 1);
}

void addEqualiserParameters(RichParameterList& list, int finest)
{
	static const char* const kinds[kBands] = {"coarsest", "coarse", "middle", "fine", "finest"};
	for (int band = 0; band < kBands; ++band)
		list.addParam(RichDynamicFloat(
		    bandParameter(band), 1, 0, 2,
		    QString("Gain, %1 (%2)").arg(kinds[band], levelsOfBand(band, finest)),
		    "0 removes the details of these levels, 1 keeps them, 2 doubles them. Level 1 has the "
		    "details next to the base mesh, which stays as it is."));
	list.addParam(RichDynamicFloat(
	    "threshold", 0, 0, 1, "Threshold (% of the diagonal)",
	    "Against noise: the part of a detail along the normal vanishes if it is shorter than this, "
	    "and hardly changes if it is much longer. In % of the bounding box' diagonal."));
	list.addParam(RichInt(
	    "threshold_levels", kThresholdLevels, "Threshold for the finest levels",
	    "How many levels, from the finest down, the threshold acts on. Most of the noise is in the "
	    "finest two or three; the details of coarser ones may be as short where the surface is "
	    "merely curved."));
	list.addParam(RichBool(
	    "normal_only", true, "Along the normal only",
	    "Gains act on the part of a detail that is normal to the coarser surface, which is its "
	    "shape: vertices hardly move along the surface. Without this they act on the other part "
	    "too, which is how the vertices are spread: gains above 1 then fold the surface soon."));
	list.addParam(RichString(
	    "gains", "", "Gains by level",
	    "For single levels: a list such as <i>1, 1, 0.5, 0</i>, from level 1, the coarsest, on, in "
	    "place of the gains by band. Levels past its end have those.",
	    true));
	addCriterionParameter(list);
}

std::map<std::string, QVariant>
equaliseDetail(MeshModel& layer, const DetailPyramid& pyramid, const RichParameterList& list)
{
	Equaliser equaliser;
	equaliser.gains           = gainsOf(list, pyramid.finestLevel());
	equaliser.normalOnly      = flagOf(list, "normal_only", true);
	equaliser.thresholdLevels = integerOf(list, "threshold_levels", kThresholdLevels);
	const double percent      = numberOf(list, "threshold", 0);
	if (!(percent >= 0))
		throw MLException("Wavemesh: 'threshold' must not be negative.");
	const std::vector<Vec3> before = positionsOf(layer.cm);
	Box3m box;
	for (const CVertexO& v : layer.cm.vert)
		if (!v.IsD())
			box.Add(v.cP());
	equaliser.threshold           = percent / 100 * double(box.Diag());
	const std::vector<Vec3> after = pyramid.equalise(equaliser);

	std::size_t row = 0;
	int moved       = 0;
	double farthest = 0;
	for (CVertexO& v : layer.cm.vert) {
		if (v.IsD())
			continue;
		double squares = 0;
		for (int k = 0; k < 3; ++k) {
			squares += std::pow(after[row][std::size_t(k)] - before[row][std::size_t(k)], 2);
			v.P()[k] = Scalarm(after[row][std::size_t(k)]);
		}
		moved += squares > 0;
		farthest = std::max(farthest, std::sqrt(squares));
		++row;
	}
	if (moved > 0)
		layer.updateBoxAndNormals();
	return {{"moved", moved}, {"largest_move", farthest}, {"finest_level", pyramid.finestLevel()}};
}

} // namespace wavemesh
