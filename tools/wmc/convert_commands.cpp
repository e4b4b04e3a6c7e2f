// SPDX-License-Identifier: GPL-3.0-or-later
// encode, decode, info.
#include "attribute_options.h"
#include "codec_options.h"
#include "commands.h"
#include "console.h"
#include "failure.h"
#include "info_json.h"
#include "mesh_files.h"

#include <filesystem>
#include <memory>

namespace wavemesh::tool {

namespace {

std::string joined(const std::vector<std::string>& names)
{
	std::string list;
	for (const std::string& name : names)
		list += (list.empty() ? "" : ", ") + name;
	return list;
}

struct Encode
{
	std::string in, out;
	CodecOptions codec;
	AttributeOptions attributes;
	bool json = false;

	int run() const
	{
		std::error_code ignored;
		if (std::filesystem::equivalent(in, out, ignored))
			throw UsageError(out + ": this is the mesh to encode; name another file to write");
		if (isNamedAsMesh(out))
			throw UsageError(out + ": this is the name of a mesh, and encode writes .wmc");
		const EncodeOptions options = codec.toEncodeOptions();
		std::vector<std::string> notRead;
		MeshData mesh = loadMesh(in, attributes.channels(), &notRead);
		if (!notRead.empty())
			warn(in + ": not kept: " + joined(notRead));
		attributes.setBits(mesh, codec.exact);
		double seconds = 0, back = 0;
		const EncodedMesh file = encodeMesh(in, mesh, options, &seconds);
		// Nothing is written that does not decode.
		if (const auto decoded = decodeBytes(out, file.bytes, ofOwnFile(), &back); !decoded.ok())
			throw Failure(messageOf(out, decoded.status()));
		OutputFile output(out);
		output.write(file.bytes.data(), file.bytes.size());
		output.commit();
		if (json) {
			Json j = {{"file", out}};
			j.update(toJson(file.info));
			j["encode_seconds"] = seconds;
			j["decode_seconds"] = back;
			printJson(j);
		}
		else
			printInfo(file.info);
		return kFine;
	}
};

struct Decode
{
	std::string in, out;
	int level              = kFinestLevel;
	std::uint64_t maxBytes = ~std::uint64_t {0};
	DecodeLimits limits;
	bool json = false;

	int run() const
	{
		checkMeshFormat(out);
		const Bytes bytes = readFile(in);
		DecodeOptions options;
		options.level      = level;
		options.maxBytes   = maxBytes;
		options.limits     = limits;
		double seconds     = 0;
		const auto decoded = decodeBytes(in, bytes, options, &seconds);
		// A mesh that comes with any other complaint is not to be trusted.
		if (!decoded.ok() && decoded.status().code != StatusCode::Truncated)
			throw Failure(messageOf(in, decoded.status()));
		const StreamInfo& info = decoded->info;
		if (!decoded.ok())
			warn(
			    messageOf(in, decoded.status()) + "; wrote level " +
			    std::to_string(decoded->level) + " of " + std::to_string(info.finestLevel()));
		const std::vector<std::string> notHeld = saveMesh(decoded->mesh, out);
		if (!notHeld.empty())
			warn(out + ": this format is written without " + joined(notHeld));
		if (json) {
			Json j = {{"file", in}};
			j.update(toJson(info));
			j["decode_seconds"] = seconds;
			j["bytes_used"]     = std::min<std::uint64_t>(bytes.size(), maxBytes);
			j["truncated"]      = !decoded.ok();
			j["warning"]        = decoded.ok() ? Json() : Json(decoded.status().what);
			j["level"]          = decoded->level;
			j["written"]        = {
			           {"file", out},
			           {"vertices", decoded->mesh.positions.size()},
			           {"faces", decoded->mesh.triangles.size()}};
			printJson(j);
		}
		else
			std::printf(
			    "level %d of %d: %s vertices, %s faces\n", decoded->level, info.finestLevel(),
			    grouped(decoded->mesh.positions.size()).c_str(),
			    grouped(decoded->mesh.triangles.size()).c_str());
		return kFine;
	}
};

struct Info
{
	std::string in;
	bool json = false;

	int run() const
	{
		constexpr std::size_t kHead = 1 << 14;
		const std::uint64_t size    = fileSize(in);
		Bytes head                  = readFile(in, kHead);
		auto info                   = readInfo(head.data(), head.size());
		if (info.status().code == StatusCode::Truncated && size > kHead) { // very many levels
			head = readFile(in);
			info = readInfo(head.data(), head.size());
		}
		if (!info.hasValue())
			throw Failure(messageOf(in, info.status()));
		const bool truncated = size < info->bytes;
		if (truncated)
			warn(
			    in + ": the file is cut off: " + std::to_string(size) + " of " +
			    std::to_string(info->bytes) + " bytes");
		if (json) {
			Json j = {{"file", in}};
			j.update(toJson(*info));
			j["file_size"] = size;
			j["truncated"] = truncated;
			printJson(j);
		}
		else
			printInfo(*info);
		return kFine;
	}
};

void addLimit(
    CLI::App& command, const std::string& option, std::uint64_t& limit, const std::string& more)
{
	command.add_option(option, limit, "Refuse files that declare " + more)
	    ->check(notNegative())
	    ->capture_default_str();
}

void addJson(CLI::App& command, bool& json)
{
	command.add_flag("--json", json, "Print one JSON object on stdout and nothing else");
}

} // namespace

void addEncode(CLI::App& app, Command& chosen)
{
	auto c        = std::make_shared<Encode>();
	auto* command = app.add_subcommand("encode", "Encode a mesh as .wmc");
	command->add_option("IN", c->in, "Mesh to read: .ply, .obj, .off or .stl")->required();
	command->add_option("OUT", c->out, "File to write, .wmc")->required();
	c->codec.addTo(*command);
	c->attributes.addTo(*command);
	addJson(*command, c->json);
	command->callback([&chosen, c] { chosen = [c] { return c->run(); }; });
}

void addDecode(CLI::App& app, Command& chosen)
{
	auto c = std::make_shared<Decode>();
	auto* command =
	    app.add_subcommand("decode", "Decode a .wmc, whole, to a level, or a part of it");
	command->add_option("IN", c->in, "File to read, .wmc")->required();
	command->add_option("OUT", c->out, "Mesh to write: .ply, .obj, .off or .stl")->required();
	command
	    ->add_option(
	        "--level", c->level,
	        "Level to stop at: 0 is the coarsest; -1, or any past the finest, is the finest")
	    ->check(CLI::Range(-1, 1 << 30))
	    ->capture_default_str();
	command
	    ->add_option(
	        "--max-bytes", c->maxBytes,
	        "Decode as if the file ended after this many bytes (default: all of it)")
	    ->check(notNegative());
	addLimit(*command, "--max-vertices", c->limits.maxVertices, "more vertices");
	addLimit(*command, "--max-faces", c->limits.maxFaces, "more faces");
	addLimit(
	    *command, "--max-attribute-values", c->limits.maxAttributeValues,
	    "more numbers in attributes");
	addLimit(
	    *command, "--max-level-share", c->limits.maxLevelShare,
	    "more faces in all levels together, in multiples of the finest level's");
	addJson(*command, c->json);
	command->footer(
	    "A file that is cut off gives the mesh that its bytes still hold, and a "
	    "warning. Another\n"
	    "warning names what is not written in the format of OUT. To OUT.obj with textures belongs\n"
	    "an OUT.mtl.");
	command->callback([&chosen, c] { chosen = [c] { return c->run(); }; });
}

void addInfo(CLI::App& app, Command& chosen)
{
	auto c        = std::make_shared<Info>();
	auto* command = app.add_subcommand("info", "Print what the head of a .wmc tells");
	command->add_option("IN", c->in, "File to read, .wmc; only its head is read")->required();
	addJson(*command, c->json);
	command->callback([&chosen, c] { chosen = [c] { return c->run(); }; });
}

} // namespace wavemesh::tool
