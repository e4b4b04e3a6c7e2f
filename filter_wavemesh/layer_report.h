// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The rate-distortion report of a layer: what is asked, measuring, and the forms of the answer.
#pragma once

#include "layer_levels.h"

#include <metrics/rate_distortion.h>

#include <common/parameters/rich_parameter_list.h>

#include <wrap/callback.h>

#include <QStringList>
#include <QVariant>

#include <map>
#include <string>
#include <vector>

namespace wavemesh {

/// One switch for each of metrics::comparedConfigurations(), one for the layer's own stream, what
/// to encode with, and the files to write.
/// @param ownStream  has the layer a `.wmc` that still fits it?
void addReportParameters(RichParameterList& list, const EncodeOptions& defaults, bool ownStream);

class LayerReport
{
public:
	/// Encodes and measures. `levels` may be null: the layer has no stream that fits it.
	/// @throws MLException if nothing is chosen, or the mesh cannot be encoded
	LayerReport(
	    const MeshModel& layer,
	    LayerLevels* levels,
	    const RichParameterList& parameters,
	    const EncodeOptions& defaults,
	    vcg::CallBackPos* cb);

	/// Lines of equal columns, for a log that shows HTML in a fixed font: padded with spaces that
	/// do not collapse.
	QStringList table() const;

	/// Of each configuration, under its name: levels, bytes, bits per vertex, and RMS error within
	/// 1, 2, 4 and 8 bits per vertex (% of the diagonal). Numbers only: PyMeshLab drops texts.
	std::map<std::string, QVariant> results() const;

	/// Writes the CSV file and the picture, if they are asked for.
	/// @return the files written
	/// @throws MLException if one cannot be written
	QStringList writeFiles() const;

private:
	std::vector<metrics::Curve> curves_;
	QString name_; ///< of the layer
	QString csvFile_, pictureFile_;
	int pictureWidth_    = 0;
	std::size_t samples_ = 0;
	double diagonal_     = 1; ///< model units
};

} // namespace wavemesh
