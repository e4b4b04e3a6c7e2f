// SPDX-License-Identifier: GPL-3.0-or-later
#include "container/container.h"
#include "finish/finish.h"
#include "multires/hierarchy.h"
#include "syntax/base_syntax.h"
#include "syntax/connectivity_syntax.h"
#include "syntax/detail_syntax.h"
#include "wavelet/lifting.h"

#include <wavemesh/codec.h>

#include <limits>
#include <new>

namespace wavemesh {
namespace {

/// A chunk is closed after the level that takes it past this many bytes: small levels share one.
constexpr std::size_t kChunkSize = 400;

Status checkOptions(const EncodeOptions& o)
{
	if (o.mode != Mode::Classic)
		return {StatusCode::InvalidArgument, "unknown mode"};
	if (o.lifting < kLiftingOff || o.lifting > 2)
		return {StatusCode::InvalidArgument, "lifting must be off or the k of a k-disc, 0 to 2"};
	if (!(o.wgcSharpness >= 0 && o.wgcSharpness <= 1))
		return {StatusCode::InvalidArgument, "the sharpness threshold must be 0 to 1"};
	if (!(o.wgcDeviation > 0 && o.wgcDeviation <= 1e6))
		return {StatusCode::InvalidArgument, "the deviation threshold must be positive"};
	return {};
}

/// Maps the progress of one stage into a part of the whole.
class Stage
{
public:
	Stage(const Progress& progress, double from, double to) :
	        progress_(progress), from_(from), to_(to)
	{
	}
	bool operator()(double fraction) const
	{
		return !progress_ || progress_(from_ + fraction * (to_ - from_));
	}
	Stage part(double from, double to) const
	{
		return {progress_, from_ + from * (to_ - from_), from_ + to * (to_ - from_)};
	}

private:
	const Progress& progress_;
	double from_, to_;
};

Status cancelled()
{
	return {StatusCode::Cancelled, "cancelled"};
}

struct QuantisedMesh
{
	ManifoldCut cut;
	Lattice lattice;
	std::vector<LatticePoint> positions; ///< #V of the cut
};

/// Details of one level and what their synthesis needs.
struct AnalysedLevel
{
	Parents parents;
	UpdateWeights weights;
	std::vector<LatticePoint> details;
};

std::uint64_t saturatingAdd(std::uint64_t a, std::uint64_t b)
{
	return a > std::numeric_limits<std::uint64_t>::max() - b
	           ? std::numeric_limits<std::uint64_t>::max()
	           : a + b;
}

/// Writes the levels into chunks and their rows into the head.
class LevelWriter
{
public:
	LevelWriter(Head& head, std::vector<std::uint8_t>& chunks) : head_(head), chunks_(chunks) {}

	RangeEncoder& coder() { return coder_; }
	void connectivityEnds() { connectivityEnd_ = coder_.mark(); }

	void endLevel(const LevelRow& row, bool last)
	{
		levels_.push_back({row, connectivityEnd_, coder_.mark()});
		connectivityEnd_ = coder_.mark();
		if (last || coder_.mark().size >= kChunkSize)
			endChunk();
	}

private:
	struct Level
	{
		LevelRow row;
		RangeEncoder::Mark connectivityEnd, end;
	};

	void endChunk()
	{
		const auto payload = coder_.finish();
		writeChunk(kLevelChunk, payload, chunks_);
		std::size_t begin = 0;
		for (Level& level : levels_) {
			const std::size_t middle    = RangeEncoder::prefix(payload, level.connectivityEnd);
			const std::size_t end       = RangeEncoder::prefix(payload, level.end);
			level.row.bytes             = std::uint32_t(end - begin);
			level.row.connectivityBytes = std::uint32_t(middle - begin);
			level.row.endsChunk         = &level == &levels_.back();
			begin                       = end;
			head_.rows.push_back(level.row);
		}
		levels_.clear();
		connectivityEnd_ = {};
	}

	Head& head_;
	std::vector<std::uint8_t>& chunks_;
	RangeEncoder coder_;
	std::vector<Level> levels_; ///< of the chunk being written
	RangeEncoder::Mark connectivityEnd_;
};

Result<EncodedMesh> encodeOnce(
    const MeshData& original,
    const QuantisedMesh& mesh,
    const EncodeOptions& options,
    bool wgc,
    const Stage& stage)
{
	// Coarsen, from the finest level down.
	const GeometricalCriterion criterion {wgc, options.wgcSharpness, options.wgcDeviation};
	bool running           = true;
	const Stage coarsening = stage.part(0, 0.5);
	auto coarsenings       = coarsenAll(
	          mesh.cut.table, mesh.positions, criterion,
	          [&](double fraction) {
            running = coarsening(fraction);
            return running;
        },
	          mesh.cut.shared());
	if (!running)
		return cancelled();

	// Number everything as the decoder will.
	BaseMesh base;
	std::vector<Index> source;
	base.table = coarsenings.empty() ? mesh.cut.table : coarsenings.back().coarse;
	base.positions.resize(base.table.vertexCount);
	{
		RangeEncoder ignored; // the order of the base does not depend on its positions
		base.table = BaseSyntax<RangeEncoder>(ignored, mesh.lattice.bits).write(base, source).table;
	}
	Replay levels = replay(std::move(coarsenings), std::move(base.table), std::move(source));
	std::vector<LatticePoint> positions;
	positions.reserve(levels.source.size());
	for (const Index v : levels.source)
		positions.push_back(mesh.positions[v]);

	Head head;
	head.lifting  = options.lifting;
	head.wgc      = wgc;
	head.lattice  = mesh.lattice;
	head.digest   = digestOf(levels.finest, positions);
	head.features = featuresFor(options, original, mesh.cut);

	const std::size_t splits       = levels.levels.size();
	const bool glued               = head.has(kRestoration);
	const std::vector<Index> group = mesh.cut.groupsOf(
	    levels.source,
	    splits == 0 ? levels.finest.vertexCount : levels.levels[0].parent.vertexCount);
	const Glue glue = glueOf(group);

	// Analyse, from the finest level down.
	std::vector<AnalysedLevel> analysed(splits);
	std::vector<std::uint64_t> squaredError(
	    splits + 1, 0); // by level, of the details that it lacks
	for (std::size_t i = splits; i-- > 0;) {
		const ReplayedLevel& level = levels.levels[i];
		AnalysedLevel& a           = analysed[i];
		a.parents                  = parentsOf(level.parent, level.refinement);
		a.weights = updateWeights(level.parent, level.refinement, a.parents, options.lifting);
		keepStill(glue, a.weights);
		a.details = analyse(a.parents, a.weights, positions);
		positions.resize(level.parent.vertexCount);
		squaredError[i] = squaredError[i + 1];
		for (const LatticePoint& d : a.details)
			squaredError[i] = saturatingAdd(squaredError[i], squaredDistance(d, {0, 0, 0}));
		if (!stage(0.7 - 0.2 * double(i + 1) / double(splits)))
			return cancelled();
	}

	std::vector<std::array<Index, 3>> parents; // of all vertices but the base mesh's
	if (head.has(kAttributes))
		for (const AnalysedLevel& a : analysed)
			parents.insert(parents.end(), a.parents.begin(), a.parents.end());

	// Code, from the base up; each level is synthesised on the way, as the decoder does.
	std::vector<std::uint8_t> chunks;
	LevelWriter writer(head, chunks);
	ConnectivityModels connectivityModels;
	DetailModels detailModels;
	const auto row = [&](LevelKind kind, std::size_t level, std::size_t vertices,
	                     std::size_t faces) {
		LevelRow r;
		r.kind      = kind;
		r.vertices  = std::uint32_t(vertices);
		r.faces     = std::uint32_t(faces);
		r.errorCode = errorCode(squaredError[level], levels.source.size());
		return r;
	};
	{
		BaseMesh b {splits == 0 ? levels.finest : levels.levels[0].parent, positions, {}};
		BaseSyntax<RangeEncoder>(writer.coder(), mesh.lattice.bits, glued).write(b, source, &group);
		writer.endLevel(
		    row(LevelKind::Base, 0, b.positions.size(), b.table.faceCount()), splits == 0);
	}
	for (std::size_t i = 0; i < splits; ++i) {
		ReplayedLevel& level = levels.levels[i];
		AnalysedLevel& a     = analysed[i];
		ConnectivitySyntax<RangeEncoder>(
		    writer.coder(), connectivityModels, level.parent, positions)
		    .code(level.refinement);
		writer.connectivityEnds();
		DetailSyntax<RangeEncoder>(
		    writer.coder(), detailModels, level.parent, level.refinement, positions)
		    .code(a.details);
		synthesise(a.parents, a.weights, a.details, positions);
		const CornerTable& child = i + 1 < splits ? levels.levels[i + 1].parent : levels.finest;
		writer.endLevel(
		    row(LevelKind::Split, i + 1, positions.size(), child.faceCount()), i + 1 == splits);
		level = {};
		a     = {};
		if (!stage(0.7 + 0.3 * double(positions.size()) / double(levels.source.size())))
			return cancelled();
	}

	writeFinish(
	    {original, mesh.cut, levels.finest, positions, levels.source, glue, parents}, head, chunks);

	EncodedMesh out;
	writeHead(head, out.bytes);
	out.info = describe(head, out.bytes.size());
	out.bytes.insert(out.bytes.end(), chunks.begin(), chunks.end());
	return out;
}

Result<EncodedMesh> encodeMesh(const MeshData& mesh, const EncodeOptions& options)
{
	if (Status s = checkOptions(options); !s.ok())
		return s;
	constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max() / 3;
	if (mesh.positions.size() > kMost || mesh.triangles.size() > kMost)
		return Status(
		    StatusCode::LimitExceeded, "the mesh has more than 715 million vertices or faces");
	const auto& finite = options.exact ? finitePositions(mesh.positions) : mesh.positions;
	const auto lattice = makeLattice(finite, options.bits, options.step);
	if (!lattice.ok())
		return lattice.status();
	if (Status s = checkAttributes(mesh); !s.ok())
		return s;
	auto cut = cutToManifold(mesh.triangles, Index(mesh.positions.size()));
	if (!cut.ok())
		return cut.status();
	QuantisedMesh quantised {std::move(*cut), *lattice, {}};
	{
		const auto points = quantise(finite, *lattice);
		for (const Index v : quantised.cut.vertex)
			quantised.positions.push_back(points[v]);
	}

	const Stage whole(options.progress, 0, 1);
	if (options.wgc != Wgc::Auto)
		return encodeOnce(mesh, quantised, options, options.wgc == Wgc::On, whole);
	auto blind = encodeOnce(mesh, quantised, options, false, whole.part(0, 0.5));
	if (!blind.ok())
		return blind;
	auto steered = encodeOnce(mesh, quantised, options, true, whole.part(0.5, 1));
	if (!steered.ok())
		return steered;
	return steered->bytes.size() < blind->bytes.size() ? steered : blind;
}

} // namespace

Result<EncodedMesh> encode(const MeshData& mesh, const EncodeOptions& options)
{
	try {
		return encodeMesh(mesh, options);
	}
	catch (const std::bad_alloc&) {
		return Status(StatusCode::OutOfMemory, "not enough memory to encode this mesh");
	}
}

} // namespace wavemesh
