// SPDX-License-Identifier: GPL-3.0-or-later
#include "curve_plot.h"

#include "plot_sheet.h"

#include <algorithm>
#include <cmath>

namespace wavemesh {
namespace {

// In units of which the sheet is 600 wide: letters are readable if the picture has as many pixels.
constexpr double kWidth = 600;
constexpr double kLeft = 92, kRight = 18, kBottom = 56;
constexpr double kDiagram    = 306; ///< height
constexpr double kLegendLeft = 24, kLegendTop = 54, kLegendLine = 20, kLegendColumn = 266;
constexpr int kLegendColumns = 2;
constexpr double kTitle = 17, kText = 14, kSmall = 12.5;

const QColor kAxisColour(0x30, 0x30, 0x30);
const QColor kGridColour(0xdd, 0xdd, 0xdd);
const QColor kFineGridColour(0xf0, 0xf0, 0xf0);

/// Okabe & Ito's colours, which differ in lightness too, each with its own marker and dashes.
struct Look
{
	QColor colour;
	int corners; ///< of the marker; 0 for a disc
	double turn; ///< of the marker, in turns
	QVector<double> dashes;
};
const QVector<Look>& looks()
{
	static const QVector<Look> all = {
	    {QColor(0x00, 0x72, 0xb2), 0, 0, {}},
	    {QColor(0xd5, 0x5e, 0x00), 4, 0.125, {9, 3}},
	    {QColor(0x00, 0x9e, 0x73), 3, 0.75, {2.5, 2.5}},
	    {QColor(0x00, 0x00, 0x00), 4, 0, {9, 3, 2.5, 3}},
	    {QColor(0xcc, 0x79, 0xa7), 5, 0.75, {14, 4}},
	    {QColor(0x56, 0xb4, 0xe9), 6, 0, {5, 5}},
	};
	return all;
}

QPolygonF markerAt(const QPointF& at, const Look& look)
{
	const int corners   = look.corners == 0 ? 24 : look.corners;
	const double radius = look.corners == 0 ? 4.4 : look.corners == 3 ? 5.6 : 5;
	QPolygonF outline;
	for (int i = 0; i < corners; ++i) {
		const double angle = 2 * M_PI * (look.turn + double(i) / corners);
		outline << at + radius * QPointF(std::cos(angle), std::sin(angle));
	}
	return outline;
}

/// 1, 2 or 5 times a power of ten: about `count` of them in `range`.
double niceStep(double range, int count)
{
	const double raw  = range / count;
	const double ten  = std::pow(10., std::floor(std::log10(raw)));
	const double lead = raw / ten;
	return ten * (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
}

/// Where values are on the sheet: below the legend.
class Axes
{
public:
	explicit Axes(const QVector<PlotCurve>& curves) :
	        top_(
	            kLegendTop + 10 +
	            kLegendLine * ((curves.size() + kLegendColumns - 1) / kLegendColumns))
	{
		double low = 1e300, high = 0;
		for (const PlotCurve& curve : curves)
			for (const QPointF& p : curve.levels) {
				rate_ = std::max(rate_, p.x());
				if (p.y() > 0) {
					low  = std::min(low, p.y());
					high = std::max(high, p.y());
				}
			}
		if (!(high > 0))
			low = high = 1;
		// Five decades at most: what is below is as good as exact.
		low   = std::max(low, high * 1e-5);
		low_  = std::log10(low) - 0.1;
		high_ = std::log10(high) + 0.1;
		rate_ = (rate_ > 0 ? rate_ : 1) * 1.03;
	}

	double top() const { return top_; }
	double bottom() const { return top_ + kDiagram; }
	double rate() const { return rate_; }
	double low() const { return low_; } ///< decades
	double high() const { return high_; }
	double x(double rate) const { return kLeft + rate / rate_ * (kWidth - kLeft - kRight); }
	double y(double error) const
	{
		const double decades = std::log10(std::max(error, 1e-300));
		const double part    = (std::max(decades, low_) - low_) / (high_ - low_);
		return bottom() - part * kDiagram;
	}

private:
	double top_;
	double rate_ = 0, low_ = 0, high_ = 1;
};

void drawAxes(PlotSheet& sheet, const Axes& axes)
{
	const double left = axes.x(0), right = kWidth - kRight;
	const double top = axes.top(), bottom = axes.bottom();
	const auto rule = [&](double error, const QColor& colour) {
		sheet.polyline(
		    {QPointF(left, axes.y(error)), QPointF(right, axes.y(error))}, {colour, 1, {}});
	};
	const bool few = axes.high() - axes.low() < 1.6;
	for (int decade = int(std::floor(axes.low())); decade <= int(std::ceil(axes.high())); ++decade)
		for (int lead = 1; lead < 10; ++lead) {
			const double error   = lead * std::pow(10., decade);
			const double decades = std::log10(error);
			if (decades < axes.low() || decades > axes.high())
				continue;
			const bool labelled = lead == 1 || (few && (lead == 2 || lead == 5));
			rule(error, labelled ? kGridColour : kFineGridColour);
			if (labelled)
				sheet.text(
				    {left - 7, axes.y(error) + 0.35 * kText}, QString::number(error, 'g', 3) + " %",
				    kText, TextAnchor::Right);
		}
	const double step = niceStep(axes.rate(), 8);
	for (int i = 0; i * step <= axes.rate(); ++i) {
		const double x = axes.x(i * step);
		sheet.polyline({QPointF(x, top), QPointF(x, bottom)}, {kGridColour, 1, {}});
		sheet.text({x, bottom + 18}, QString::number(i * step), kText, TextAnchor::Middle);
	}
	sheet.polyline(
	    {QPointF(left, top), QPointF(left, bottom), QPointF(right, bottom)},
	    {kAxisColour, 1.5, {}});
	sheet.text(
	    {(left + right) / 2, bottom + kBottom - 14},
	    "bits per vertex of the original (whole file up to the level)", kText, TextAnchor::Middle);
	sheet.text(
	    {14, (top + bottom) / 2}, "RMS error, % of the diagonal", kText, TextAnchor::Middle, false,
	    true);
}

void drawCurve(PlotSheet& sheet, const Axes& axes, const PlotCurve& curve, const Look& look)
{
	QPolygonF stairs;
	for (const QPointF& level : curve.levels) {
		const QPointF at(axes.x(level.x()), axes.y(level.y()));
		if (!stairs.isEmpty())
			stairs << QPointF(at.x(), stairs.back().y());
		stairs << at;
	}
	sheet.polyline(stairs, {look.colour, 2.2, look.dashes});
	for (const QPointF& level : curve.levels)
		sheet.marker(markerAt({axes.x(level.x()), axes.y(level.y())}, look), look.colour, 1);
}

/// Above the diagram, where no curve goes.
void drawLegend(PlotSheet& sheet, const QVector<PlotCurve>& curves)
{
	constexpr double sample = 32;
	for (int i = 0; i < curves.size(); ++i) {
		const Look& look = looks()[i % looks().size()];
		const double x   = kLegendLeft + i % kLegendColumns * kLegendColumn;
		const double y   = kLegendTop + kLegendLine * (i / kLegendColumns + 0.5);
		sheet.polyline({QPointF(x, y), QPointF(x + sample, y)}, {look.colour, 2.2, look.dashes});
		sheet.marker(markerAt({x + sample / 2, y}, look), look.colour, 1);
		sheet.text({x + sample + 7, y + 0.35 * kSmall}, curves[i].name, kSmall, TextAnchor::Left);
	}
}

} // namespace

void plotCurves(
    const QString& file,
    const QString& title,
    const QString& subtitle,
    const QVector<PlotCurve>& curves,
    int width)
{
	const Axes axes(curves);
	const QSizeF size(kWidth, axes.bottom() + kBottom);
	const auto sheet = openPlotSheet(file, size, std::max(width, 100));
	sheet->text({kLegendLeft, 24}, title, kTitle, TextAnchor::Left, true);
	sheet->text({kLegendLeft, 45}, subtitle, kSmall, TextAnchor::Left);
	drawAxes(*sheet, axes);
	for (int i = 0; i < curves.size(); ++i)
		drawCurve(*sheet, axes, curves[i], looks()[i % looks().size()]);
	drawLegend(*sheet, curves);
	sheet->finish();
}

} // namespace wavemesh
