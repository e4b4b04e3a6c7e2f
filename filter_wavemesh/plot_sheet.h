// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A sheet to draw a diagram on, in two kinds: a bitmap, and SVG text. Qt's own SVG module is not
/// among what every MeshLab brings along.
#pragma once

#include <QColor>
#include <QPointF>
#include <QPolygonF>
#include <QRectF>
#include <QSizeF>
#include <QString>
#include <QVector>

#include <memory>

namespace wavemesh {

struct Stroke
{
	QColor colour;
	double width = 1;
	QVector<double> dashes; ///< lengths of dash and gap in turn; empty: a solid line
};

enum class TextAnchor { Left, Middle, Right };

/// All lengths in units of the sheet; (0, 0) is its upper left corner.
class PlotSheet
{
public:
	virtual ~PlotSheet() = default;

	virtual void fill(const QRectF& area, const QColor& colour)                       = 0;
	virtual void polyline(const QVector<QPointF>& points, const Stroke& stroke)       = 0;
	virtual void marker(const QPolygonF& outline, const QColor& fill, double contour) = 0;
	/// One line of text; `at` is on its base line. `upwards`: turned by a quarter to the left.
	virtual void text(
	    const QPointF& at,
	    const QString& line,
	    double size,
	    TextAnchor anchor,
	    bool bold    = false,
	    bool upwards = false) = 0;

	/// Writes the sheet to its file.
	/// @throws MLException if that is not possible
	virtual void finish() = 0;
};

/// @param file    .png or .svg; another suffix is an MLException, as is a .png in a program without
///                Qt's fonts (no QGuiApplication)
/// @param size    of the sheet in its units
/// @param width   of the picture in pixels
std::unique_ptr<PlotSheet> openPlotSheet(const QString& file, const QSizeF& size, int width);

} // namespace wavemesh
