// SPDX-License-Identifier: GPL-3.0-or-later
// report: rate and distortion of every level.
#include "attribute_options.h"
#include "codec_options.h"
#include "commands.h"
#include "console.h"
#include "failure.h"
#include "info_json.h"
#include "mesh_files.h"

#include <metrics/rate_distortion.h>

#include <cmath>
#include <memory>

namespace wavemesh::tool {

using metrics::Curve;
using metrics::DistanceMeter;

namespace {

/// One way of encoding, measured.
struct Run
{
	Curve curve;
	EncodeOptions options;
	double encodeSeconds = 0, decodeSeconds = 0;
};

struct Report
{
	std::string in, csv;
	CodecOptions codec;
	AttributeOptions attributes {"none", ""};
	std::size_t samples = 0;
	bool configs = false, json = false;

	std::vector<metrics::Configuration> configurations() const
	{
		if (!configs) {
			const EncodeOptions base = codec.toEncodeOptions();
			return {{nameOf(base), base}};
		}
		CodecOptions ofAll = codec;
		ofAll.mode         = "classic"; // of three of them
		return metrics::comparedConfigurations(ofAll.toEncodeOptions());
	}

	static Run measure(
	    const metrics::Configuration& configuration,
	    const std::string& path,
	    const MeshData& mesh,
	    const DistanceMeter& meter)
	{
		Run run;
		run.options            = configuration.options;
		const EncodedMesh file = encodeMesh(path, mesh, run.options, &run.encodeSeconds);
		const auto whole       = decodeBytes(path, file.bytes, {}, &run.decodeSeconds);
		if (!whole.ok())
			throw Failure(messageOf(path, whole.status()));
		ProgressLine line("measuring " + path + " (" + configuration.name + ")");
		auto curve = metrics::measureCurve(file.bytes, meter, line.callback());
		if (!curve.ok())
			throw Failure(messageOf(path, curve.status()));
		run.curve      = std::move(curve.value());
		run.curve.name = configuration.name;
		return run;
	}

	int run() const
	{
		const auto wanted = configurations();
		MeshData mesh     = loadMesh(in, attributes.channels());
		attributes.setBits(mesh, codec.exact);
		for (std::size_t v = 0; v < mesh.positions.size(); ++v)
			for (const double x : mesh.positions[v])
				if (!std::isfinite(x))
					throw Failure(
					    in + ": vertex " + std::to_string(v) +
					    " has a coordinate that is not finite: there are no distances to measure");
		if (mesh.triangles.empty())
			throw Failure(in + ": there are no faces in it to measure distances from");
		const std::size_t n =
		    samples ? samples : std::max<std::size_t>(100000, mesh.triangles.size());
		const DistanceMeter meter(mesh, n);
		std::vector<Run> all;
		for (const auto& configuration : wanted)
			all.push_back(measure(configuration, in, mesh, meter));
		if (!csv.empty())
			writeCsv(all, meter.diagonal());
		if (json)
			printJson(asJson(all, n, meter.diagonal()));
		else
			print(all, n, meter.diagonal());
		return kFine;
	}

	static Json curveAsJson(const Run& run)
	{
		const Curve& c = run.curve;
		Json j         = toJson(c.info);
		for (std::size_t i = 0; i < c.levels.size(); ++i) {
			j["levels"][i]["bits_per_vertex"] =
			    bitsPerVertex(c.info.levels[i].prefix, c.info.vertices);
			j["levels"][i]["rms"] = c.levels[i].rms;
			j["levels"][i]["max"] = c.levels[i].max;
		}
		j["encode_seconds"] = run.encodeSeconds;
		j["decode_seconds"] = run.decodeSeconds;
		for (double bpv : {1.0, 2.0, 4.0, 8.0}) {
			const auto* best = metrics::bestWithin(c, bpv);
			j["rms_at_bpv"][std::to_string(static_cast<int>(bpv))] =
			    best ? Json(best->rms) : Json();
		}
		const double permille = metrics::rateFor(c, 0.001), tenth = metrics::rateFor(c, 0.0001);
		j["bpv_for_rms"] = {
		    {"0.001", permille < 0 ? Json() : Json(permille)},
		    {"0.0001", tenth < 0 ? Json() : Json(tenth)}};
		return j;
	}

	Json asJson(const std::vector<Run>& all, std::size_t n, double diagonal) const
	{
		Json j = {{"file", in}, {"samples", n}, {"diagonal", diagonal}};
		if (!configs) {
			j.update(curveAsJson(all[0]));
			return j;
		}
		// The smallest of them stands for the mesh.
		const Run* smallest = &all[0];
		for (const Run& r : all)
			if (r.curve.info.bytes < smallest->curve.info.bytes)
				smallest = &r;
		j["smallest"] = smallest->curve.name;
		j.update(curveAsJson(*smallest));
		j["configurations"] = Json::array();
		for (const Run& r : all) {
			Json one = {{"configuration", r.curve.name}};
			one.update(curveAsJson(r));
			j["configurations"].push_back(one);
		}
		return j;
	}

	void writeCsv(const std::vector<Run>& all, double diagonal) const
	{
		std::vector<Curve> curves;
		for (const Run& r : all)
			curves.push_back(r.curve);
		const std::string text = metrics::asCsv(curves, diagonal);
		OutputFile out(csv);
		out.write(text.data(), text.size());
		out.commit();
	}

	void print(const std::vector<Run>& all, std::size_t n, double diagonal) const
	{
		std::printf(
		    "%s: %s vertices, %s faces\n"
		    "RMS and max: symmetric surface distance in %% of the bounding box' diagonal (%s),\n"
		    "the larger of the two directions, %s samples each\n",
		    in.c_str(), grouped(all[0].curve.info.vertices).c_str(),
		    grouped(all[0].curve.info.faces).c_str(), significant(diagonal, 6).c_str(),
		    grouped(n).c_str());
		for (const Run& r : all) {
			const Curve& c = r.curve;
			std::printf(
			    "\n%s\n",
			    configs ? (c.name + " (" + nameOf(r.options) + ")").c_str() : c.name.c_str());
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

	static void printSummary(const std::vector<Run>& all)
	{
		std::printf("\nRMS %% within a rate, and the rate for an RMS\n");
		Table table(
		    {"", "1 bpv", "2 bpv", "4 bpv", "8 bpv", "bpv for 0.1 %", "for 0.01 %", "whole file"});
		for (const Run& r : all) {
			const Curve& c = r.curve;
			std::vector<std::string> row {all.size() == 1 ? "" : c.name};
			for (double bpv : {1.0, 2.0, 4.0, 8.0}) {
				const auto* best = metrics::bestWithin(c, bpv);
				row.push_back(best ? fixed(100 * best->rms, 4) : "-");
			}
			for (double rms : {0.001, 0.0001}) {
				const double rate = metrics::rateFor(c, rms);
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
	c->attributes.addTo(*command);
	command
	    ->add_flag(
	        "--configs", c->configs,
	        "The paper's three configurations and the compact mode in one report: I (lazy), II "
	        "(lifting), III (lifting and wgc), compact. For the three --wgc and --optimize are "
	        "ignored; --lifting gives the k of II and III (0 if off)")
	    ->excludes("--mode");
	command
	    ->add_option(
	        "--samples", c->samples,
	        "Points on each surface to measure at (default: as many as faces, at least 100000)")
	    ->check(notNegative())
	    ->check(CLI::Range(std::size_t {1}, std::size_t {1000000000}));
	command->add_option("--csv", c->csv, "Also write the table to this file");
	command->add_flag("--json", c->json, "Print one JSON object on stdout and nothing else");
	command->footer(
	    "rms and max are fractions of the bounding box' diagonal in JSON and CSV, and % of it in\n"
	    "the table; error is the file's own estimate, in model units.");
	command->callback([&chosen, c] { chosen = [c] { return c->run(); }; });
}

} // namespace wavemesh::tool
