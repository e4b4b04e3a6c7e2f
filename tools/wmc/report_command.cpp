// SPDX-License-Identifier: GPL-3.0-or-later
// report: rate and distortion of every level.
#include "codec_options.h"
#include "commands.h"
#include "console.h"
#include "failure.h"
#include "info_json.h"
#include "mesh_files.h"
#include "surface_distance.h"

#include <chrono>
#include <cmath>
#include <memory>

namespace wavemesh::tool {

namespace {

/// One way of encoding, and what every level of it costs and is worth.
struct Curve
{
	std::string name;
	EncodeOptions options;
	StreamInfo info;
	double encodeSeconds = 0, decodeSeconds = 0;
	std::vector<SurfaceDistance> levels; ///< relative to the bounding box' diagonal
};

/// The best level within `bpv` bits per vertex; null if not even the base mesh fits.
const SurfaceDistance* bestWithin(const Curve& c, double bpv)
{
	const SurfaceDistance* best = nullptr;
	for (std::size_t i = 0; i < c.levels.size(); ++i)
		if (bitsPerVertex(c.info.levels[i].prefix, c.info.vertices) <= bpv &&
		    (!best || c.levels[i].rms < best->rms))
			best = &c.levels[i];
	return best;
}

/// Bits per vertex of the first level with an RMS of at most `rms`; negative if there is none.
double rateFor(const Curve& c, double rms)
{
	for (std::size_t i = 0; i < c.levels.size(); ++i)
		if (c.levels[i].rms <= rms)
			return bitsPerVertex(c.info.levels[i].prefix, c.info.vertices);
	return -1;
}

struct Report
{
	std::string in, csv;
	CodecOptions codec;
	std::size_t samples = 0;
	bool configs = false, json = false;

	std::vector<Curve> curves() const
	{
		std::vector<Curve> all;
		const EncodeOptions base = codec.toEncodeOptions();
		auto add                 = [&](const std::string& name, int lifting, Wgc wgc) {
            Curve c;
            c.name            = name;
            c.options         = base;
            c.options.lifting = lifting;
            c.options.wgc     = wgc;
            all.push_back(c);
		};
		if (!configs) {
			add(nameOf(base), base.lifting, base.wgc);
			return all;
		}
		const int k = base.lifting == kLiftingOff ? 0 : base.lifting;
		add("I", kLiftingOff, Wgc::Off);
		add("II", k, Wgc::Off);
		add("III", k, Wgc::On);
		return all;
	}

	static void
	measure(Curve& curve, const std::string& path, const MeshData& mesh, const DistanceMeter& meter)
	{
		const EncodedMesh file = encodeMesh(path, mesh, curve.options, &curve.encodeSeconds);
		const auto whole       = decodeBytes(path, file.bytes, {}, &curve.decodeSeconds);
		if (!whole.ok())
			throw Failure(messageOf(path, whole.status()));
		curve.info   = file.info;
		auto decoder = Decoder::open(file.bytes.data(), file.bytes.size());
		if (!decoder.ok())
			throw Failure(messageOf(path, decoder.status()));
		ProgressLine line("measuring " + path + " (" + curve.name + ")");
		const auto n = static_cast<double>(file.info.levels.size());
		for (std::size_t i = 0; i < file.info.levels.size(); ++i) {
			if (const Status s = decoder->advance(); !s.ok())
				throw Failure(messageOf(path, s));
			SurfaceDistance d = meter.measure(
			    decoder->mesh(), [&](double f) { line.show((static_cast<double>(i) + f) / n); });
			d.rms /= meter.diagonal();
			d.max /= meter.diagonal();
			curve.levels.push_back(d);
		}
	}

	int run() const
	{
		const MeshData mesh = loadMesh(in);
		if (mesh.triangles.empty())
			throw Failure(in + ": there are no faces in it to measure distances from");
		const std::size_t n =
		    samples ? samples : std::max<std::size_t>(100000, mesh.triangles.size());
		const DistanceMeter meter(mesh, n);
		std::vector<Curve> all = curves();
		for (Curve& curve : all)
			measure(curve, in, mesh, meter);
		if (!csv.empty())
			writeCsv(all);
		if (json)
			printJson(asJson(all, n, meter.diagonal()));
		else
			print(all, n, meter.diagonal());
		return kFine;
	}

	static Json curveAsJson(const Curve& c)
	{
		Json j = toJson(c.info);
		for (std::size_t i = 0; i < c.levels.size(); ++i) {
			j["levels"][i]["bits_per_vertex"] =
			    bitsPerVertex(c.info.levels[i].prefix, c.info.vertices);
			j["levels"][i]["rms"] = c.levels[i].rms;
			j["levels"][i]["max"] = c.levels[i].max;
		}
		j["encode_seconds"] = c.encodeSeconds;
		j["decode_seconds"] = c.decodeSeconds;
		for (double bpv : {1.0, 2.0, 4.0, 8.0}) {
			const auto* best = bestWithin(c, bpv);
			j["rms_at_bpv"][std::to_string(static_cast<int>(bpv))] =
			    best ? Json(best->rms) : Json();
		}
		const double permille = rateFor(c, 0.001), tenth = rateFor(c, 0.0001);
		j["bpv_for_rms"] = {
		    {"0.001", permille < 0 ? Json() : Json(permille)},
		    {"0.0001", tenth < 0 ? Json() : Json(tenth)}};
		return j;
	}

	Json asJson(const std::vector<Curve>& all, std::size_t n, double diagonal) const
	{
		Json j = {{"file", in}, {"samples", n}, {"diagonal", diagonal}};
		if (!configs) {
			j.update(curveAsJson(all[0]));
			return j;
		}
		// The smallest of them stands for the mesh.
		const Curve* smallest = &all[0];
		for (const Curve& c : all)
			if (c.info.bytes < smallest->info.bytes)
				smallest = &c;
		j["smallest"] = smallest->name;
		j.update(curveAsJson(*smallest));
		j["configurations"] = Json::array();
		for (const Curve& c : all) {
			Json one = {{"configuration", c.name}};
			one.update(curveAsJson(c));
			j["configurations"].push_back(one);
		}
		return j;
	}

	void writeCsv(const std::vector<Curve>& all) const
	{
		std::string text =
		    "configuration,level,kind,vertices,faces,bytes,prefix,bits_per_vertex,rms,max,error\n";
		for (const Curve& c : all)
			for (std::size_t i = 0; i < c.levels.size(); ++i) {
				const LevelInfo& l = c.info.levels[i];
				text += "\"" + c.name + "\"," + std::to_string(i) + "," + nameOf(l.kind) + "," +
				        std::to_string(l.vertices) + "," + std::to_string(l.faces) + "," +
				        std::to_string(l.bytes) + "," + std::to_string(l.prefix) + "," +
				        significant(bitsPerVertex(l.prefix, c.info.vertices), 9) + "," +
				        significant(c.levels[i].rms, 9) + "," + significant(c.levels[i].max, 9) +
				        "," + significant(l.error, 9) + "\n";
			}
		OutputFile out(csv);
		out.write(text.data(), text.size());
		out.commit();
	}

	void print(const std::vector<Curve>& all, std::size_t n, double diagonal) const
	{
		std::printf(
		    "%s: %s vertices, %s faces\n"
		    "RMS and max: symmetric surface distance in %% of the bounding box' diagonal (%s),\n"
		    "the larger of the two directions, %s samples each\n",
		    in.c_str(), grouped(all[0].info.vertices).c_str(), grouped(all[0].info.faces).c_str(),
		    significant(diagonal, 6).c_str(), grouped(n).c_str());
		for (const Curve& c : all) {
			std::printf(
			    "\n%s\n",
			    configs ? (c.name + " (" + nameOf(c.options) + ")").c_str() : c.name.c_str());
			Table table(
			    {"level", "kind", "vertices", "faces", "bytes", "up to here", "bpv", "RMS %",
			     "max %"});
			for (std::size_t i = 0; i < c.levels.size(); ++i) {
				const LevelInfo& l = c.info.levels[i];
				table.add(
				    {std::to_string(i), nameOf(l.kind), grouped(l.vertices), grouped(l.faces),
				     grouped(l.bytes), grouped(l.prefix),
				     fixed(bitsPerVertex(l.prefix, c.info.vertices), 3),
				     fixed(100 * c.levels[i].rms, 4), fixed(100 * c.levels[i].max, 4)});
			}
			table.print();
		}
		printSummary(all);
	}

	static void printSummary(const std::vector<Curve>& all)
	{
		std::printf("\nRMS %% within a rate, and the rate for an RMS\n");
		Table table(
		    {"", "1 bpv", "2 bpv", "4 bpv", "8 bpv", "bpv for 0.1 %", "for 0.01 %", "whole file"});
		for (const Curve& c : all) {
			std::vector<std::string> row {all.size() == 1 ? "" : c.name};
			for (double bpv : {1.0, 2.0, 4.0, 8.0}) {
				const auto* best = bestWithin(c, bpv);
				row.push_back(best ? fixed(100 * best->rms, 4) : "-");
			}
			for (double rms : {0.001, 0.0001}) {
				const double rate = rateFor(c, rms);
				row.push_back(rate < 0 ? "-" : fixed(rate, 2));
			}
			row.push_back(fixed(bitsPerVertex(c.info.bytes, c.info.vertices), 2));
			table.add(row);
		}
		table.print();
	}
};

} // namespace

void addReport(CLI::App& app, Command& chosen)
{
	auto c        = std::make_shared<Report>();
	auto* command = app.add_subcommand("report", "Rate and distortion of every level of a mesh");
	command->add_option("IN", c->in, "Mesh to read: .ply, .obj, .off or .stl")->required();
	c->codec.addTo(*command);
	command->add_flag(
	    "--configs", c->configs,
	    "The paper's three configurations in one report: I (lazy), II (lifting), III (lifting and "
	    "wgc). --wgc is ignored; --lifting gives the k of II and III");
	command
	    ->add_option(
	        "--samples", c->samples,
	        "Points on each surface to measure at (default: as many as faces, at least 100000)")
	    ->check(CLI::Range(std::size_t {1}, std::size_t {1000000000}));
	command->add_option("--csv", c->csv, "Also write the table to this file");
	command->add_flag("--json", c->json, "Print one JSON object on stdout and nothing else");
	command->footer(
	    "rms and max are fractions of the bounding box' diagonal in JSON and CSV, and % of it in\n"
	    "the table; error is the file's own estimate, in model units.");
	command->callback([&chosen, c] { chosen = [c] { return c->run(); }; });
}

} // namespace wavemesh::tool
