// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "detail_filters.h"
#include "layer_levels.h"
#include "level_slider.h"

#include <common/plugins/interfaces/filter_plugin.h>

/// Simplification, levels, reports and details on the codec. Translates between MeshLab and the
/// libraries.
class FilterWavemeshPlugin : public QObject, public FilterPlugin
{
	Q_OBJECT
	MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
	Q_INTERFACES(FilterPlugin)

public:
	enum Filters { FP_SIMPLIFY, FP_BROWSE, FP_LAYERS, FP_REPORT, FP_COLOUR, FP_EQUALISE };

	FilterWavemeshPlugin();

	QString pluginName() const override;
	QString vendor() const override;

	QString filterName(ActionIDType filter) const override;
	QString pythonFilterName(ActionIDType filter) const override;
	QString filterInfo(ActionIDType filter) const override;
	FilterClass getClass(const QAction* action) const override;
	FilterArity filterArity(const QAction* action) const override;
	int getPreConditions(const QAction* action) const override;
	int postCondition(const QAction* action) const override;

	RichParameterList
	initParameterList(const QAction* action, const MeshDocument& document) override;

	std::map<std::string, QVariant> applyFilter(
	    const QAction* action,
	    const RichParameterList& parameters,
	    MeshDocument& document,
	    unsigned int& postConditionMask,
	    vcg::CallBackPos* cb) override;

	/// Of the dialog of Browse Levels: when it is closed, nobody needs what was decoded for it.
	bool eventFilter(QObject* dialog, QEvent* event) override;

private:
	using Results = std::map<std::string, QVariant>;

	Results simplify(MeshModel& layer, const RichParameterList& parameters, vcg::CallBackPos* cb);
	Results
	browse(MeshModel& layer, const RichParameterList& parameters, unsigned int& postConditionMask);
	Results makeLayers(MeshDocument& document, const RichParameterList& parameters);
	Results report(MeshModel& layer, const RichParameterList& parameters, vcg::CallBackPos* cb);
	Results colour(MeshModel& layer, const RichParameterList& parameters);
	Results equalise(
	    MeshModel& layer, const RichParameterList& parameters, unsigned int& postConditionMask);

	/// The levels of the layer: those it has, or those of a new encoding of its mesh.
	std::shared_ptr<wavemesh::LayerLevels> levelsOf(MeshModel& layer);
	/// @throws MLException if the mesh cannot be encoded
	wavemesh::SharedBytes encodeForBrowsing(const MeshModel& layer);
	/// What Browse Levels can offer. Never throws.
	wavemesh::LevelRange levelRange(const MeshModel& layer);
	/// Begins to decode all levels but the one that the layer shows if that is the finest.
	void decodeAhead(const MeshModel& layer, const wavemesh::SharedBytes& stream, int shown);
	/// Levels of the hierarchy for details, 0 if there is none. Never throws.
	int finestDetailLevel(const MeshModel& layer);
	/// Watches for the end of the dialog that MeshLab is about to make. It tells nobody, and keeps
	/// the dialog hidden.
	void watchDialog();
	/// Shows `card` where the dialog of Browse Levels, if there is one, shows that of another
	/// level.
	void showCard(const QString& card);

	/// The last mesh that was encoded for browsing. The dialog has to know the number of levels
	/// before the filter runs, when the layer may not be touched yet.
	struct Encoded
	{
		std::uint64_t fingerprint = 0;
		wavemesh::SharedBytes stream;
	};
	Encoded encoded_;
	/// While the dialog of Browse Levels waits for its user; then LayerLevels has it.
	std::shared_ptr<wavemesh::LevelDecoder> ahead_;
	wavemesh::PyramidCache pyramid_;
	QString card_; ///< what the dialog of Browse Levels shows
};
