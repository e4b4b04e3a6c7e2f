// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Rate-distortion curves as a picture: error on a logarithmic scale over bits per vertex.
#pragma once

#include <QPointF>
#include <QString>
#include <QVector>

namespace wavemesh {

struct PlotCurve
{
	QString name; ///< in the legend
	/// By level: bits per vertex of the file up to it, and RMS error in % of the diagonal. Drawn as
	/// a staircase: whoever has more bits than one level needs, and fewer than the next, sees it.
	QVector<QPointF> levels;
};

/// Draws the curves in colours and with markers that the colour-blind can tell apart.
/// @param file   .png or .svg
/// @param width  of the picture in pixels, 100 or more; lines and letters grow with it
/// @throws MLException if the file cannot be written, or its name has another suffix
void plotCurves(
    const QString& file,
    const QString& title,
    const QString& subtitle,
    const QVector<PlotCurve>& curves,
    int width);

} // namespace wavemesh
