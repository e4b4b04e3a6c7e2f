// SPDX-License-Identifier: GPL-3.0-or-later
#include "level_slider.h"

#include <shared/plugin_support.h>

#include <algorithm>
#include <cmath>

namespace wavemesh {
namespace {

/// As wide as a digit.
constexpr QChar kFigureSpace(0x2007);

QString grouped(std::uint64_t count)
{
	QString digits = QString::number(count);
	for (int at = digits.size() - 3; at > 0; at -= 3)
		digits.insert(at, QChar::Nbsp);
	return digits;
}

/// As wide as `widest` would be: the label, and with it the slider beside it, keeps its place.
QString groupedAs(std::uint64_t count, std::uint64_t widest)
{
	return grouped(count).rightJustified(grouped(widest).size(), kFigureSpace);
}

const LevelInfo& rowOf(const StreamInfo& info, int level)
{
	return info.levels[std::size_t(std::clamp(level, 0, info.finestLevel()))];
}

int finestWithin(const StreamInfo& info, int finest, double bytes)
{
	int level = finest;
	while (level > 0 && double(rowOf(info, level).prefix) > bytes)
		--level;
	return level;
}

int coarsestWithin(const StreamInfo& info, int finest, double error)
{
	int level = 0;
	while (level < finest && rowOf(info, level).error > error)
		++level;
	return level;
}

QString tableOf(const LevelRange& range)
{
	if (range.info.levels.empty())
		return {};
	QString rows = "<table cellpadding=\"2\"><tr><th>level</th><th>vertices</th><th>faces</th>"
	               "<th>bytes</th><th>error</th></tr>";
	for (int level = 0; level <= range.finest; ++level) {
		const LevelInfo& row = rowOf(range.info, level);
		rows += "<tr align=\"right\">";
		for (const QString& cell :
		     {QString::number(level), grouped(row.vertices), grouped(row.faces),
		      grouped(row.prefix), QString::number(row.error, 'g', 3)})
			rows += "<td>" + cell + "</td>";
		rows += "</tr>";
	}
	return rows + "</table>";
}

} // namespace

QString levelCard(const LevelRange& range, int level)
{
	if (range.info.levels.empty())
		return "Level";
	const LevelInfo &row = rowOf(range.info, level), &last = rowOf(range.info, range.finest);
	return QString("Level %1 of %2\n%3 vertices\n%4 faces\n%5 bytes\nerror %6")
	    .arg(groupedAs(std::uint64_t(level), std::uint64_t(range.finest)))
	    .arg(range.finest)
	    .arg(groupedAs(row.vertices, last.vertices), groupedAs(row.faces, last.faces))
	    .arg(groupedAs(row.prefix, last.prefix))
	    .arg(row.error, 0, 'g', 3);
}

void addSliderParameters(RichParameterList& list, const LevelRange& range)
{
	list.addParam(RichDynamicFloat(
	    "level", Scalarm(range.shown), 0, Scalarm(std::max(range.finest, 1)),
	    levelCard(range, range.shown),
	    "0 is the base mesh, the coarsest; the largest value is the finest level, which is the "
	    "layer as it was. In scripts any larger number is the finest, and so is -1 (but for "
	    "PyMeshLab, which makes 0 of it). Tick <i>Preview</i> and drag. The "
	    "error is the file's own estimate, in model units.<br>" +
	        tableOf(range)));
	list.addParam(RichEnum(
	    "snap", int(Snap::Level), {"level", "bytes", "error"}, "Slider goes by",
	    "<b>level</b>: equally far from each level to the next. <b>bytes</b>: the size of the file "
	    "grows by equal factors along the way. <b>error</b>: the error falls by equal factors."));
	list.addParam(RichInt(
	    "max_bytes", 0, "At most so many bytes (0 = as many as needed)",
	    "If above 0, with the slider going by bytes: the finest level that so many bytes of the "
	    "file hold, in place of the slider.",
	    true));
	list.addParam(RichFloat(
	    "max_error", 0, "Error at most (model units, 0 = by the slider)",
	    "If above 0, with the slider going by error: the coarsest level with at most this error, "
	    "in place of the slider.",
	    true));
}

int levelAt(const StreamInfo& info, int finest, double way, Snap snap)
{
	way = std::clamp(way, 0., 1.);
	if (way >= 1 || finest == 0)
		return finest;
	const auto between = [way](double from, double to) { return from * std::pow(to / from, way); };
	if (snap == Snap::Bytes)
		return finestWithin(
		    info, finest,
		    between(double(rowOf(info, 0).prefix), double(rowOf(info, finest).prefix)));
	if (snap == Snap::Error) {
		// The finest level has error 0 and is at the end; the last but one is a step before it.
		const double from = rowOf(info, 0).error, to = rowOf(info, finest - 1).error;
		if (from > 0 && to > 0 && to < from) {
			const double last = double(finest - 1) / finest;
			return way > last + 0.5 / finest
			           ? finest
			           : coarsestWithin(
			                 info, finest,
			                 from * std::pow(to / from, std::min(way / last, 1.)) * (1 + 1e-9));
		}
	}
	return int(std::lround(way * finest));
}

int chosenLevel(const RichParameterList& list, const StreamInfo& info, int finest)
{
	const int snap = integerOf(list, "snap", int(Snap::Level));
	if (snap < 0 || snap > int(Snap::Error))
		throw MLException("Wavemesh: 'snap' has to be 0 to 2.");
	const double bytes = numberOf(list, "max_bytes", 0);
	const double error = numberOf(list, "max_error", 0);
	if (Snap(snap) == Snap::Bytes && bytes > 0)
		return finestWithin(info, finest, bytes);
	if (Snap(snap) == Snap::Error && error > 0)
		return coarsestWithin(info, finest, error);
	const double asked = numberOf(list, "level", kFinestLevel);
	if (std::isnan(asked))
		throw MLException("Wavemesh: 'level' has to be a number.");
	if (asked < 0)
		return finest;
	return levelAt(info, finest, asked / std::max(finest, 1), Snap(snap));
}

} // namespace wavemesh
