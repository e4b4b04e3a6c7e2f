// SPDX-License-Identifier: GPL-3.0-or-later
#include "layer_report.h"

#include "curve_plot.h"

#include <shared/encode_parameters.h>
#include <shared/plugin_support.h>

#include <wavemesh/vcg_wmc.h>

#include <QSaveFile>

#include <algorithm>

namespace wavemesh {
namespace {

constexpr int kLeastSamples = 25000;

/// What the paper's names mean; a configuration without a word here is shown by its name alone.
QString meaningOf(const std::string& name)
{
	if (name == "I")
		return "lazy";
	if (name == "II")
		return "lifting";
	if (name == "III")
		return "lifting and WGC";
	if (name == "compact")
		return "not in the paper";
	return {};
}

QString titleOf(const std::string& name)
{
	const QString meaning = meaningOf(name);
	return QString::fromStdString(name) + (meaning.isEmpty() ? "" : ": " + meaning);
}

QString switchOf(const std::string& name)
{
	return "config_" + QString::fromStdString(name).toLower();
}

/// A part of the whole progress.
Progress partOf(const Progress& whole, double from, double to)
{
	if (!whole)
		return {};
	return [whole, from, to](double fraction) { return whole(from + fraction * (to - from)); };
}

/// Columns as wide as their widest cell, right aligned, by spaces that do not collapse.
QStringList aligned(const std::vector<QStringList>& rows)
{
	QStringList lines;
	for (const QStringList& row : rows) {
		QString line;
		for (int i = 0; i < row.size(); ++i) {
			int width = 0;
			for (const QStringList& other : rows)
				width = std::max(width, other[i].size());
			line += QString(i == 0 ? 0 : 1, ' ') + row[i].rightJustified(width, ' ');
		}
		lines << line.replace(' ', QChar(0x00a0));
	}
	return lines;
}

/// "own .wmc" is own_wmc in a result map.
std::string keyOf(const std::string& name)
{
	std::string key;
	for (const char letter : name)
		if (letter != '.')
			key += letter == ' ' ? '_' : char(std::tolower(letter));
	return key;
}

} // namespace

void addReportParameters(RichParameterList& list, const EncodeOptions& defaults, bool ownStream)
{
	list.addParam(RichBool(
	    "own", ownStream, "The layer's own .wmc",
	    "Report on the .wmc that the layer was opened from (or that Browse Levels made), as it is. "
	    "Without one, the mesh is encoded with the options below."));
	for (const metrics::Configuration& c : metrics::comparedConfigurations(defaults))
		list.addParam(RichBool(
		    switchOf(c.name), true, "Configuration " + titleOf(c.name),
		    "Encode the mesh in this way and report on it too. The options below count, but "
		    "for the mode, and in I to III the aim and the criterion; II and III lift by the disc "
		    "below."));
	list.addParam(RichInt(
	    "samples", 0, "Samples (0 = as many as faces)",
	    "Points on each of the two surfaces from which distances are measured; at least 25000 if "
	    "0. The same points every time."));
	list.addParam(SaveFileParameter(
	    "csv", "", "*.csv", "Table as CSV file",
	    "Where to write the table, for other programs; empty: nowhere."));
	list.addParam(SaveFileParameter(
	    "picture", "", "*.png *.svg", "Picture (.png or .svg)",
	    "Where to draw the curves: error on a logarithmic scale over bits per vertex; empty: "
	    "nowhere."));
	list.addParam(RichInt(
	    "picture_width", 1200, "Width of the picture (pixels)",
	    "Lines and letters grow with it; 600 is still readable.", true));
	addEncodeParameters(list, defaults, Offered::Precision);
}

LayerReport::LayerReport(
    const MeshModel& layer,
    LayerLevels* levels,
    const RichParameterList& parameters,
    const EncodeOptions& defaults,
    vcg::CallBackPos* cb) :
        name_(plainLabel(layer.label())),
        csvFile_(textOf(parameters, "csv", "")), pictureFile_(textOf(parameters, "picture", "")),
        pictureWidth_(integerOf(parameters, "picture_width", 1200))
{
	if (pictureWidth_ < 100 || pictureWidth_ > 20000)
		throw MLException("Wavemesh: 'picture_width' has to be 100 to 20000.");
	const EncodeOptions options = encodeOptions(parameters, defaults);
	std::vector<metrics::Configuration> chosen;
	for (const metrics::Configuration& c : metrics::comparedConfigurations(options))
		if (flagOf(parameters, switchOf(c.name), true))
			chosen.push_back(c);
	const bool own = flagOf(parameters, "own", levels != nullptr);
	if (own && levels == nullptr)
		chosen.insert(chosen.begin(), {"as chosen", options});
	const std::size_t count = chosen.size() + (own && levels != nullptr);
	if (count == 0)
		throw MLException("Wavemesh: nothing is chosen to report on.");

	const MeshData original = levels != nullptr ? levels->finestMesh(layer) : toMeshData(layer.cm);
	const int wanted        = integerOf(parameters, "samples", 0);
	samples_                = wanted > 0 ? std::size_t(wanted)
	                                     : std::max<std::size_t>(kLeastSamples, original.triangles.size());
	const metrics::DistanceMeter meter(original, samples_);
	diagonal_ = meter.diagonal();

	const double share = 1.0 / double(count);
	const auto stage   = [&](const std::string& doing, double from, double to) {
        return partOf(progressBar(cb, doing + "..."), share * from, share * to);
	};
	const auto measure = [&](const std::string& name, const std::vector<std::uint8_t>& file,
	                         double from) {
		const double number = double(curves_.size());
		auto curve          = metrics::measureCurve(
		             file, meter, stage("Measuring levels of " + name, number + from, number + 1));
		require(curve.status(), "Cannot measure " + name_);
		curve->name = name;
		curves_.push_back(std::move(*curve));
	};
	if (own && levels != nullptr)
		measure("own .wmc", *levels->stream(), 0);
	for (const metrics::Configuration& c : chosen) {
		constexpr double kEncoding = 0.05; // of the time
		const double number        = double(curves_.size());
		EncodeOptions encoding     = c.options;
		encoding.progress          = stage("Encoding as " + c.name, number, number + kEncoding);
		const auto encoded         = encode(original, encoding);
		require(encoded.status(), "Cannot report on " + name_);
		measure(c.name, encoded->bytes, kEncoding);
	}
}

QStringList LayerReport::table() const
{
	QStringList lines;
	lines << QString(
	             "%1: %2 vertices, %3 faces; RMS and max are surface distances, %4 samples each "
	             "way; 1 % is %5 model units")
	             .arg(name_)
	             .arg(curves_[0].info.vertices)
	             .arg(curves_[0].info.faces)
	             .arg(samples_)
	             .arg(diagonal_ / 100, 0, 'g', 4);
	for (const metrics::Curve& c : curves_) {
		lines << titleOf(c.name);
		std::vector<QStringList> rows = {
		    {"level", "vertices", "faces", "bytes", "bpv", "conn.", "geom.", "RMS %", "max %"}};
		const auto bpv = [&c](std::uint64_t bytes) {
			return QString::number(metrics::bitsPerVertex(bytes, c.info.vertices), 'f', 2);
		};
		std::uint64_t connectivity = 0, geometry = 0;
		for (std::size_t i = 0; i < c.levels.size(); ++i) {
			const LevelInfo& l = c.info.levels[i];
			connectivity += l.connectivityBytes;
			geometry += l.geometryBytes;
			rows.push_back(
			    {QString::number(i), QString::number(l.vertices), QString::number(l.faces),
			     QString::number(l.prefix), bpv(l.prefix), bpv(connectivity), bpv(geometry),
			     QString::number(100 * c.levels[i].rms, 'f', 4),
			     QString::number(100 * c.levels[i].max, 'f', 4)});
		}
		lines << aligned(rows);
	}
	return lines;
}

std::map<std::string, QVariant> LayerReport::results() const
{
	std::map<std::string, QVariant> all;
	all["diagonal"] = diagonal_;
	all["samples"]  = countValue(samples_);
	for (const metrics::Curve& c : curves_) {
		const std::string key  = keyOf(c.name);
		const StreamInfo& info = c.info;
		all[key + "_levels"]   = int(c.levels.size());
		all[key + "_bytes"]    = countValue(info.bytes);
		all[key + "_bpv"]      = metrics::bitsPerVertex(info.bytes, info.vertices);
		all[key + "_bpv_connectivity"] =
		    metrics::bitsPerVertex(info.connectivityBytes, info.vertices);
		all[key + "_bpv_geometry"] = metrics::bitsPerVertex(info.geometryBytes, info.vertices);
		all[key + "_finest_rms"]   = 100 * c.levels.back().rms;
		for (const int rate : {1, 2, 4, 8})
			if (const auto* best = metrics::bestWithin(c, rate))
				all[key + "_rms_within_" + std::to_string(rate) + "_bpv"] = 100 * best->rms;
	}
	return all;
}

QStringList LayerReport::writeFiles() const
{
	QStringList written;
	if (!csvFile_.isEmpty()) {
		const QByteArray bytes = QByteArray::fromStdString(metrics::asCsv(curves_, diagonal_));
		QSaveFile file(csvFile_);
		if (!file.open(QIODevice::WriteOnly) || file.write(bytes) != bytes.size() || !file.commit())
			throw MLException("Cannot write " + csvFile_ + ": " + file.errorString() + ".");
		written << csvFile_;
	}
	if (!pictureFile_.isEmpty()) {
		QVector<PlotCurve> curves;
		for (const metrics::Curve& c : curves_) {
			PlotCurve curve;
			curve.name = QString("%1 (%2 bpv)")
			                 .arg(titleOf(c.name))
			                 .arg(metrics::bitsPerVertex(c.info.bytes, c.info.vertices), 0, 'f', 2);
			for (std::size_t i = 0; i < c.levels.size(); ++i)
				curve.levels << QPointF(
				    metrics::bitsPerVertex(c.info.levels[i].prefix, c.info.vertices),
				    100 * c.levels[i].rms);
			curves << curve;
		}
		const QString subtitle =
		    QString("%1 vertices, %2 faces, %3 bits per coordinate; diagonal %4 model units")
		        .arg(curves_[0].info.vertices)
		        .arg(curves_[0].info.faces)
		        .arg(curves_.back().info.bits)
		        .arg(diagonal_, 0, 'g', 4);
		plotCurves(pictureFile_, name_ + ": rate and distortion", subtitle, curves, pictureWidth_);
		written << pictureFile_;
	}
	return written;
}

} // namespace wavemesh
