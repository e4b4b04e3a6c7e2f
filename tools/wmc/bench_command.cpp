// SPDX-License-Identifier: GPL-3.0-or-later
// bench: speed and memory of the codec alone.
#include "codec_options.h"
#include "commands.h"
#include "console.h"
#include "failure.h"
#include "info_json.h"
#include "measure.h"
#include "mesh_files.h"

#include <algorithm>
#include <filesystem>
#include <memory>

namespace wavemesh::tool {

namespace fs = std::filesystem;

namespace {

struct Row
{
	std::string path;
	StreamInfo info;
	Measured encode, decode;
};

/// The meshes named, and those in the folders named, in the order of their names.
std::vector<std::string> expand(const std::vector<std::string>& paths)
{
	std::vector<std::string> files;
	for (const std::string& path : paths) {
		std::error_code ignored;
		if (!fs::is_directory(path, ignored)) {
			files.push_back(path);
			continue;
		}
		std::vector<std::string> inside;
		for (const auto& entry : fs::directory_iterator(path)) {
			const std::string e = entry.path().extension().string();
			if (e == ".ply" || e == ".obj" || e == ".off" || e == ".stl")
				inside.push_back(entry.path().string());
		}
		if (inside.empty())
			throw Failure(path + ": there are no meshes in this folder");
		std::sort(inside.begin(), inside.end());
		files.insert(files.end(), inside.begin(), inside.end());
	}
	return files;
}

MeshData tetrahedron()
{
	return {
	    {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
	    {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}};
}

/// Of processor time: what one core does.
double perSecond(const Row& r, const Measured& m)
{
	return m.cpuSeconds > 0 ? r.info.vertices / m.cpuSeconds : 0;
}

double perVertex(const Row& r, const Measured& m)
{
	return static_cast<double>(m.peakBytes) / std::max(1u, r.info.vertices);
}

struct Bench
{
	std::vector<std::string> paths;
	CodecOptions codec;
	int runs  = 3;
	bool json = false;

	Row measure(const std::string& path) const
	{
		const MeshData mesh         = loadMesh(path);
		const EncodeOptions options = codec.toEncodeOptions();
		const MeshData tiny         = tetrahedron();
		Row row;
		row.path   = path;
		row.encode = measureInChild(
		    runs, [&] { (void)encode(tiny, options).ok(); },
		    [&] { return encode(mesh, options).ok(); });
		// Here as well, for the file itself; a refusal ends the program with its reason.
		const EncodedMesh file     = encodeMesh(path, mesh, options);
		const EncodedMesh tinyFile = encodeMesh("tetrahedron", tiny, EncodeOptions {});
		row.info                   = file.info;
		auto decodes               = [](const EncodedMesh& encoded) {
            return decode(encoded.bytes.data(), encoded.bytes.size(), ofOwnFile()).ok();
		};
		row.decode = measureInChild(
		    runs, [&] { (void)decodes(tinyFile); }, [&] { return decodes(file); });
		if (!row.encode.ok || !row.decode.ok)
			throw Failure(path + ": the measurement failed");
		return row;
	}

	int run() const
	{
		std::vector<Row> rows;
		ProgressLine line("measuring");
		const auto files = expand(paths);
		for (std::size_t i = 0; i < files.size(); ++i) {
			line.show(double(i) / double(files.size()));
			rows.push_back(measure(files[i]));
		}
		json ? printJson(asJson(rows)) : print(rows);
		return kFine;
	}

	void print(const std::vector<Row>& rows) const
	{
		std::printf(
		    "%s; without reading and writing files, best of %d\n"
		    "v/s: vertices per second of processor time; peak: memory above that of the mesh or "
		    "the file itself\n\n",
		    nameOf(codec.toEncodeOptions()).c_str(), runs);
		Table table(
		    {"file", "vertices", "bytes", "bpv", "encode v/s", "decode v/s", "peak encode",
		     "B/vertex", "peak decode", "B/vertex"});
		for (const Row& r : rows)
			table.add(
			    {fs::path(r.path).filename().string(), grouped(r.info.vertices),
			     grouped(r.info.bytes), fixed(bitsPerVertex(r.info.bytes, r.info.vertices), 2),
			     grouped(static_cast<std::uint64_t>(perSecond(r, r.encode))),
			     grouped(static_cast<std::uint64_t>(perSecond(r, r.decode))),
			     megabytes(r.encode.peakBytes), fixed(perVertex(r, r.encode), 0),
			     megabytes(r.decode.peakBytes), fixed(perVertex(r, r.decode), 0)});
		table.print();
	}

	/// Sums over all files, then one object per file.
	Json asJson(const std::vector<Row>& rows) const
	{
		StreamInfo sum;
		double encodeSeconds = 0, decodeSeconds = 0;
		Json files = Json::array();
		for (const Row& r : rows) {
			Json j = {{"file", r.path}};
			j.update(toJson(r.info));
			j["encode_seconds"]               = r.encode.seconds;
			j["decode_seconds"]               = r.decode.seconds;
			j["encode_cpu_seconds"]           = r.encode.cpuSeconds;
			j["decode_cpu_seconds"]           = r.decode.cpuSeconds;
			j["encode_vertices_per_second"]   = perSecond(r, r.encode);
			j["decode_vertices_per_second"]   = perSecond(r, r.decode);
			j["encode_peak_bytes"]            = r.encode.peakBytes;
			j["decode_peak_bytes"]            = r.decode.peakBytes;
			j["encode_peak_bytes_per_vertex"] = perVertex(r, r.encode);
			j["decode_peak_bytes_per_vertex"] = perVertex(r, r.decode);
			files.push_back(j);
			sum.vertices += r.info.vertices;
			sum.faces += r.info.faces;
			sum.bytes += r.info.bytes;
			sum.connectivityBytes += r.info.connectivityBytes;
			sum.geometryBytes += r.info.geometryBytes;
			if (rows.size() == 1)
				sum.levels = r.info.levels;
			encodeSeconds += r.encode.seconds;
			decodeSeconds += r.decode.seconds;
		}
		const Json all = toJson(sum);
		Json j         = {{"options", nameOf(codec.toEncodeOptions())}, {"runs", runs}};
		for (const char* key : {"vertices", "faces", "bytes", "bits_per_vertex", "levels"})
			j[key] = all[key];
		j["encode_seconds"] = encodeSeconds;
		j["decode_seconds"] = decodeSeconds;
		j["files"]          = files;
		return j;
	}
};

} // namespace

void addBench(CLI::App& app, Command& chosen)
{
	auto c        = std::make_shared<Bench>();
	auto* command = app.add_subcommand("bench", "Speed and memory of the codec on meshes");
	command->add_option("FILES", c->paths, "Meshes, or folders of meshes (.ply .obj .off .stl)")
	    ->required();
	c->codec.addTo(*command);
	command->add_option("--runs", c->runs, "Times to run each; the best counts")
	    ->check(CLI::Range(1, 1000))
	    ->capture_default_str();
	command->add_flag("--json", c->json, "Print one JSON object on stdout and nothing else");
	command->callback([&chosen, c] { chosen = [c] { return c->run(); }; });
}

} // namespace wavemesh::tool
