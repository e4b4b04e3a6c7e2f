// SPDX-License-Identifier: GPL-3.0-or-later
#include "codec_options.h"

#include "console.h"
#include "failure.h"

#include <chrono>
#include <cmath>

namespace wavemesh::tool {

namespace {

class Stopwatch
{
public:
	double seconds() const
	{
		return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
	}

private:
	std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// CLI11's own says "not in range" and writes out the largest double.
CLI::Validator aboveZero()
{
	return {
	    [](std::string& text) {
		    double x = 0;
		    return CLI::detail::lexical_cast(text, x) && x > 0 && std::isfinite(x)
		               ? std::string()
		               : text + " is not a number above 0";
	    },
	    "> 0"};
}

} // namespace

CLI::Validator notNegative()
{
	return {
	    [](std::string& text) { return text[0] == '-' ? text + " is less than 0" : std::string(); },
	    ""};
}

void CodecOptions::addTo(CLI::App& command)
{
	const std::string group = "Codec";
	auto* bitsOption =
	    command
	        .add_option(
	            "--bits", bits, "Bits per coordinate over the largest extent of the bounding box")
	        ->check(CLI::Range(1, 24))
	        ->capture_default_str()
	        ->group(group);
	command.add_option("--step", step, "Lattice step in model units, in place of --bits")
	    ->check(aboveZero())
	    ->excludes(bitsOption)
	    ->group(group);
	command
	    .add_option(
	        "--mode", mode,
	        "Coding mode: compact makes positions more precise as the mesh gets denser, and the "
	        "file smaller; classic is the method of the paper")
	    ->check(CLI::IsMember({"compact", "classic"}))
	    ->capture_default_str()
	    ->group(group);
	command
	    .add_option(
	        "--effort", effort,
	        "1 is the fastest, and always writes the classic mode, without lifting unless --mode "
	        "classic; 2 encodes in one way, small meshes in 2 to 14, and 3 in 6 to 104 ways, of "
	        "which the best file is kept. Decoding takes about 1, 6 and 9 microseconds a "
	        "vertex at 12 bits, up to 4, 20 and 35 at 24")
	    ->check(CLI::IsMember({1, 2, 3}))
	    ->capture_default_str()
	    ->group(group);
	command
	    .add_option(
	        "--lifting", lifting,
	        "Update step of the wavelet, of --mode classic only: off (lazy filter bank), or the k "
	        "of its k-disc support, 0 if not given")
	    ->check(CLI::IsMember({"off", "0", "1", "2"}))
	    ->group(group);
	command
	    .add_option(
	        "--optimize", optimize,
	        "What the choice of vertices to remove aims at: size, levels (the smallest error of "
	        "coarse levels, for up to 40 % more bytes), or balanced (a small error, for up to 3 % "
	        "more)")
	    ->check(CLI::IsMember({"size", "balanced", "levels"}))
	    ->capture_default_str()
	    ->group(group);
	command
	    .add_option(
	        "--wgc", wgc,
	        "Wavelet geometrical criterion, keeps sharp edges in coarse levels: off, on, or auto "
	        "(both are tried for --optimize size with --mode classic or --effort 3, and below 4096 "
	        "vertices for balanced, and with --effort 1, too; else off)")
	    ->check(CLI::IsMember({"off", "on", "auto"}))
	    ->capture_default_str()
	    ->group(group);
	command
	    .add_option(
	        "--wgc-sharpness", sharpness,
	        "A vertex is sharp if the sine of an incident dihedral angle is above this")
	    ->check(CLI::Range(0.0, 1.0))
	    ->capture_default_str()
	    ->group(group);
	command
	    .add_option(
	        "--wgc-deviation", deviation,
	        "A sharp vertex may go if its distance to its parents' edge, over that edge's length, "
	        "is below this")
	    ->check(aboveZero())
	    ->capture_default_str()
	    ->group(group);
	command
	    .add_flag(
	        "--exact", exact,
	        "Keep every coordinate bit for bit, not only its place on the lattice: wmc info calls "
	        "it float-lossless, else lattice-lossless")
	    ->group(group);
	command
	    .add_flag(
	        "--keep-order", keepOrder,
	        "Keep the order of vertices and faces, and each face's first corner")
	    ->group(group);
}

EncodeOptions CodecOptions::toEncodeOptions() const
{
	if (mode == "compact" && !lifting.empty() && lifting != "off")
		throw UsageError(
		    "--lifting " + lifting + " is for --mode classic; compact mode has no lifting");
	EncodeOptions o;
	o.mode         = mode == "classic" ? Mode::Classic : Mode::Compact;
	o.bits         = bits;
	o.step         = step;
	o.effort       = effort;
	o.lifting      = lifting == "off" ? kLiftingOff : lifting.empty() ? 0 : lifting[0] - '0';
	o.optimize     = optimize == "size"       ? Optimize::Size
	                 : optimize == "balanced" ? Optimize::Balanced
	                                          : Optimize::Levels;
	o.wgc          = wgc == "off" ? Wgc::Off : wgc == "on" ? Wgc::On : Wgc::Auto;
	o.wgcSharpness = sharpness;
	o.wgcDeviation = deviation;
	o.exact        = exact;
	o.keepOrder    = keepOrder;
	return o;
}

std::string nameOf(Mode mode)
{
	switch (mode) {
	case Mode::Classic:
		return "classic";
	case Mode::Compact:
		return "compact";
	}
	return "unknown";
}

std::string nameOf(Optimize optimize)
{
	switch (optimize) {
	case Optimize::Size:
		return "size";
	case Optimize::Balanced:
		return "balanced";
	case Optimize::Levels:
		return "levels";
	}
	return "unknown";
}

std::string nameOfLifting(int lifting)
{
	return lifting == kLiftingOff ? "off" : std::to_string(lifting);
}

std::string nameOf(const EncodeOptions& o)
{
	return nameOf(isWrittenClassic(o) ? Mode::Classic : Mode::Compact) + ", " +
	       (o.step > 0 ? "step " + significant(o.step, 6) : std::to_string(o.bits) + " bits") +
	       (o.mode == Mode::Classic ? ", lifting " + nameOfLifting(o.lifting)
	                                : ", effort " + std::to_string(o.effort)) +
	       ", wgc " +
	       (o.wgc == Wgc::Off  ? "off"
	        : o.wgc == Wgc::On ? "on"
	                           : "auto") +
	       ", optimize " + nameOf(o.optimize) + (o.exact ? ", exact" : "") +
	       (o.keepOrder ? ", order kept" : "");
}

std::string messageOf(const std::string& path, const Status& status)
{
	std::string message = path + ": " + status.what;
	if (status.byteOffset != Status::kNoOffset &&
	    status.what.find(std::to_string(status.byteOffset)) == std::string::npos)
		message += " (byte " + std::to_string(status.byteOffset) + ")";
	return message;
}

namespace {

bool isFinite(const MeshData& mesh)
{
	for (const auto& p : mesh.positions)
		for (const double x : p)
			if (!std::isfinite(x))
				return false;
	return true;
}

} // namespace

EncodedMesh encodeMesh(
    const std::string& path, const MeshData& mesh, const EncodeOptions& options, double* seconds)
{
	ProgressLine line("encoding " + path);
	EncodeOptions withProgress = options;
	withProgress.progress      = line.callback();
	const Stopwatch watch;
	auto encoded = encode(mesh, withProgress);
	if (seconds)
		*seconds = watch.seconds();
	if (!encoded.ok())
		throw Failure(
		    messageOf(path, encoded.status()) +
		    (isFinite(mesh) || options.exact ? "" : " (option --exact)"));
	return std::move(encoded.value());
}

DecodeOptions ofOwnFile()
{
	DecodeOptions options;
	options.limits = DecodeLimits::none();
	return options;
}

Result<DecodedMesh>
decodeBytes(const std::string& path, const Bytes& bytes, DecodeOptions options, double* seconds)
{
	ProgressLine line("decoding " + path);
	options.progress = line.callback();
	const Stopwatch watch;
	auto decoded = decode(bytes.data(), bytes.size(), options);
	if (seconds)
		*seconds = watch.seconds();
	if (decoded.status().code == StatusCode::LimitExceeded)
		throw Failure(
		    messageOf(path, decoded.status()) + "; wmc decode has options to raise it (--max-...)");
	if (!decoded.hasValue())
		throw Failure(messageOf(path, decoded.status()));
	return decoded;
}

} // namespace wavemesh::tool
