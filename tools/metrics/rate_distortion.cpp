// SPDX-License-Identifier: GPL-3.0-or-later
#include "rate_distortion.h"

#include <cstdio>

namespace wavemesh::metrics {

namespace {

std::string number(double x)
{
	char text[40];
	std::snprintf(text, sizeof text, "%.9g", x);
	return text;
}

} // namespace

std::vector<Configuration> comparedConfigurations(const EncodeOptions& base)
{
	const int disc = base.lifting == kLiftingOff ? 0 : base.lifting;
	std::vector<Configuration> all;
	const auto add = [&](const char* name, int lifting, Wgc wgc) {
		all.push_back({name, base});
		all.back().options.mode     = Mode::Classic;
		all.back().options.lifting  = lifting;
		all.back().options.wgc      = wgc;
		all.back().options.optimize = Optimize::Size; // as in the paper
	};
	add("I", kLiftingOff, Wgc::Off);
	add("II", disc, Wgc::Off);
	add("III", disc, Wgc::On);
	all.push_back({"compact", base});
	all.back().options.mode = Mode::Compact;
	return all;
}

Result<Curve> measureCurve(
    const std::vector<std::uint8_t>& file, const DistanceMeter& meter, const Progress& progress)
{
	auto decoder = Decoder::open(file.data(), file.size(), DecodeLimits::none());
	if (!decoder.ok())
		return decoder.status();
	Curve curve;
	curve.info = decoder->info();
	// A coarse level takes longer: its points are further from the surface, and the closest one is
	// harder to find. This is what was measured, by the part of the levels that are done.
	const auto evenly  = [](double part) { return part * (1.5 - 0.5 * part); };
	const double share = 1 / double(curve.info.levels.size());
	double done        = 0;
	for (const LevelInfo& level : curve.info.levels) {
		if (level.prefix > file.size() && !curve.levels.empty())
			break;
		if (const Status s = decoder->advance(); !s.ok())
			return s;
		bool running      = true;
		SurfaceDistance d = meter.measure(decoder->mesh(), [&](double fraction) {
			if (progress && running)
				running = progress(evenly(done + share * fraction));
		});
		if (!running)
			return Status(StatusCode::Cancelled, "cancelled");
		d.rms /= meter.diagonal();
		d.max /= meter.diagonal();
		curve.levels.push_back(d);
		done += share;
	}
	return curve;
}

double bitsPerVertex(std::uint64_t bytes, std::uint64_t vertices)
{
	return vertices == 0 ? 0 : 8.0 * static_cast<double>(bytes) / static_cast<double>(vertices);
}

const SurfaceDistance* bestWithin(const Curve& curve, double bpv)
{
	const SurfaceDistance* best = nullptr;
	for (std::size_t i = 0; i < curve.levels.size(); ++i)
		if (bitsPerVertex(curve.info.levels[i].prefix, curve.info.vertices) <= bpv &&
		    (!best || curve.levels[i].rms < best->rms))
			best = &curve.levels[i];
	return best;
}

double rateFor(const Curve& curve, double rms)
{
	for (std::size_t i = 0; i < curve.levels.size(); ++i)
		if (curve.levels[i].rms <= rms)
			return bitsPerVertex(curve.info.levels[i].prefix, curve.info.vertices);
	return -1;
}

std::string nameOf(LevelKind kind)
{
	switch (kind) {
	case LevelKind::Base:
		return "base";
	case LevelKind::Split:
		return "split";
	case LevelKind::Precise:
		return "precise";
	}
	return "unknown";
}

std::string asCsv(const std::vector<Curve>& curves, double diagonal)
{
	std::string text =
	    "configuration,level,kind,vertices,faces,bytes,prefix,bits_per_vertex,rms,max,error,"
	    "connectivity_bytes,geometry_bytes,rms_units,max_units\n";
	for (const Curve& c : curves)
		for (std::size_t i = 0; i < c.levels.size(); ++i) {
			const LevelInfo& l       = c.info.levels[i];
			const SurfaceDistance& d = c.levels[i];
			text += "\"" + c.name + "\"," + std::to_string(i) + "," + nameOf(l.kind) + "," +
			        std::to_string(l.vertices) + "," + std::to_string(l.faces) + "," +
			        std::to_string(l.bytes) + "," + std::to_string(l.prefix) + "," +
			        number(bitsPerVertex(l.prefix, c.info.vertices)) + "," + number(d.rms) + "," +
			        number(d.max) + "," + number(l.error) + "," +
			        std::to_string(l.connectivityBytes) + "," + std::to_string(l.geometryBytes) +
			        "," + number(d.rms * diagonal) + "," + number(d.max * diagonal) + "\n";
		}
	return text;
}

} // namespace wavemesh::metrics
