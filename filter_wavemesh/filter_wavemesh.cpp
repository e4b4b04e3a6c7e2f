// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_wavemesh.h"

#include "browsing_options.h"
#include "filter_card.h"
#include "layer_report.h"
#include "level_list.h"
#include "simplify_target.h"

#include <shared/encode_parameters.h>
#include <shared/plugin_support.h>

using namespace wavemesh;

namespace {

/// Scripts do not ask isFilterApplicable().
void requireFaces(const MeshModel* layer)
{
	if (layer == nullptr)
		throw MLException("Wavemesh: there is no layer to work on: open a mesh first.");
	if (layer->cm.vn == 0)
		throw MLException(
		    "Wavemesh: the layer " + layer->label() + " is empty: choose one with a mesh.");
	if (layer->cm.fn == 0)
		throw MLException(
		    "Wavemesh: the layer " + layer->label() +
		    " is a point cloud, and levels are made of faces. A filter such as 'Surface "
		    "Reconstruction: Ball Pivoting' makes faces from points.");
}

/// As precise as files usually are.
EncodeOptions reportOptions()
{
	EncodeOptions options;
	options.wgc = Wgc::Auto;
	return options;
}

} // namespace

FilterWavemeshPlugin::FilterWavemeshPlugin()
{
	typeList = {FP_SIMPLIFY, FP_BROWSE, FP_LAYERS, FP_REPORT, FP_COLOUR, FP_EQUALISE};
	for (ActionIDType filter : types())
		actionList.push_back(new QAction(filterName(filter), this));
}

QString FilterWavemeshPlugin::pluginName() const
{
	return "FilterWavemesh";
}

QString FilterWavemeshPlugin::vendor() const
{
	return "Wavemesh";
}

QString FilterWavemeshPlugin::filterName(ActionIDType filter) const
{
	return filterCard(filter).name;
}

QString FilterWavemeshPlugin::pythonFilterName(ActionIDType filter) const
{
	return filterCard(filter).pythonName;
}

QString FilterWavemeshPlugin::filterInfo(ActionIDType filter) const
{
	return filterCard(filter).info;
}

FilterPlugin::FilterClass FilterWavemeshPlugin::getClass(const QAction* action) const
{
	return FilterClass(filterCard(ID(action)).classes);
}

FilterPlugin::FilterArity FilterWavemeshPlugin::filterArity(const QAction*) const
{
	return SINGLE_MESH;
}

int FilterWavemeshPlugin::getPreConditions(const QAction*) const
{
	return MeshModel::MM_FACENUMBER;
}

int FilterWavemeshPlugin::postCondition(const QAction* action) const
{
	return filterCard(ID(action)).postCondition;
}

RichParameterList
FilterWavemeshPlugin::initParameterList(const QAction* action, const MeshDocument& document)
{
	const MeshModel none(-1, QString(), QString());
	const MeshModel& layer = document.mm() != nullptr ? *document.mm() : none;
	RichParameterList list;
	ahead_ = nullptr;
	switch (ID(action)) {
	case FP_SIMPLIFY:
		addTargetParameters(list, layer);
		addEncodeParameters(list, browsingOptions(), Offered::Method);
		break;
	case FP_BROWSE: {
		const LevelRange range = levelRange(layer);
		addSliderParameters(list, range);
		card_ = levelCard(range, range.shown);
		watchDialog();
		break;
	}
	case FP_LAYERS:
		addLevelListParameters(list);
		break;
	case FP_REPORT:
		addReportParameters(list, reportOptions(), findValidStream(layer.cm) != nullptr);
		break;
	case FP_COLOUR:
		addDetailParameters(list);
		break;
	case FP_EQUALISE:
		addEqualiserParameters(list, finestDetailLevel(layer));
		break;
	default:
		break;
	}
	return list;
}

std::map<std::string, QVariant> FilterWavemeshPlugin::applyFilter(
    const QAction* action,
    const RichParameterList& parameters,
    MeshDocument& document,
    unsigned int& postConditionMask,
    vcg::CallBackPos* cb)
{
	return guarded([&]() -> Results {
		requireFaces(document.mm());
		MeshModel& layer = *document.mm();
		// Whatever the layer had before and after may have changed with its mesh.
		postConditionMask = MeshModel::MM_GEOMETRY_AND_TOPOLOGY_CHANGE;
		switch (ID(action)) {
		case FP_SIMPLIFY:
			return simplify(layer, parameters, cb);
		case FP_BROWSE:
			return browse(layer, parameters, postConditionMask);
		case FP_LAYERS:
			postConditionMask = MeshModel::MM_NONE;
			return makeLayers(document, parameters);
		case FP_REPORT:
			postConditionMask = MeshModel::MM_NONE;
			return report(layer, parameters, cb);
		case FP_COLOUR:
			postConditionMask = MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR;
			return colour(layer, parameters);
		case FP_EQUALISE:
			return equalise(layer, parameters, postConditionMask);
		default:
			wrongActionCalled(action);
			return {};
		}
	});
}

FilterWavemeshPlugin::Results FilterWavemeshPlugin::report(
    MeshModel& layer, const RichParameterList& parameters, vcg::CallBackPos* cb)
{
	const auto levels = LayerLevels::find(layer);
	const LayerReport report(layer, levels.get(), parameters, reportOptions(), cb);
	for (const QString& line : report.table())
		log(line.toStdString());
	for (const QString& file : report.writeFiles())
		log(("Written: " + file).toStdString());
	return report.results();
}

FilterWavemeshPlugin::Results
FilterWavemeshPlugin::colour(MeshModel& layer, const RichParameterList& parameters)
{
	const Results results = colourByDetail(layer, parameters);
	const auto number     = [&](const char* name) {
        return QString::number(results.at(name).toDouble(), 'g', 3);
	};
	log(QString("Quality: %1 to %2, on average %3; the colours go from %4 to %5.")
	        .arg(number("min"), number("max"), number("mean"))
	        .arg(number("ramp_low"), number("ramp_high"))
	        .toStdString());
	return results;
}

FilterWavemeshPlugin::Results FilterWavemeshPlugin::equalise(
    MeshModel& layer, const RichParameterList& parameters, unsigned int& postConditionMask)
{
	// No progress bar, as when browsing: the sliders are alive.
	const DetailPyramid& pyramid = pyramid_.of(layer, criterionOf(parameters));
	const Results results        = equaliseDetail(layer, pyramid, parameters);
	postConditionMask =
	    MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_FACENORMAL;
	log(QString("Moved %1 of %2 vertices, by up to %3.")
	        .arg(results.at("moved").toInt())
	        .arg(layer.cm.vn)
	        .arg(results.at("largest_move").toDouble(), 0, 'g', 3)
	        .toStdString());
	return results;
}

MESHLAB_PLUGIN_NAME_EXPORTER(FilterWavemeshPlugin)
