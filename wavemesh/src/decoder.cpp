// SPDX-License-Identifier: GPL-3.0-or-later
#include "container/container.h"
#include "finish/finish.h"
#include "level_work.h"
#include "multires/refine.h"
#include "stage.h"
#include "syntax/base_syntax.h"
#include "syntax/connectivity_syntax.h"
#include "syntax/detail_syntax.h"
#include "syntax/position_syntax.h"
#include "wavelet/lifting.h"

#include <wavemesh/codec.h>

#include <new>
#include <optional>

namespace wavemesh {

struct Decoder::State
{
	const std::uint8_t* data = nullptr;
	std::size_t size         = 0;
	Head head;
	StreamInfo info;

	int level = -1;
	CornerTable table;
	std::vector<LatticePoint> positions;         ///< cells of the level's precision
	Glue glue;                                   ///< of the base mesh
	std::unique_ptr<AttributeReader> attributes; ///< if the file has any
	std::optional<MeshData> finished; ///< level J with what follows it, as far as it came
	Status stopped;                   ///< not ok: no further level can come
	Progress progress;                ///< of the level being read
	bool cancelled = false;

	std::size_t offset = 0; ///< of the next chunk
	Chunk chunk;            ///< the one being read
	RangeDecoder coder;
	// Megabytes: made for the first refinement that needs them.
	std::unique_ptr<ConnectivityModels> connectivityModels;
	std::unique_ptr<DetailModels> detailModels;
	std::unique_ptr<CompactModels> compactModels;

	const LevelRow& row(int l) const { return head.rows[std::size_t(l)]; }

	Status nextChunk(const std::string& what, std::uint8_t type);
	Status openChunk();
	Status openFeature(Feature feature);
	Status readBase();
	Status readSplit();
	Status readDetails(const Refinement& refinement);
	Status readChildren(const Refinement& refinement, const CornerTable& child);
	Status readPrecise();
	Status finish();
	Status advance();
	bool goesOn(double fraction);
	Progress watched(double from);
	Status ended(const char* where) const;
	Status corrupt(const std::string& what) const;
	Status wrongSize(std::uint32_t found, const char* elements, std::uint32_t declared) const;
};

namespace {

/// So many faces may be in any number of levels.
constexpr std::uint64_t kFewFaces = 1000;

std::string levelName(int level)
{
	return "level " + std::to_string(level);
}

} // namespace

/// The decoder ran out of bytes: because the file is cut, or because it lies.
Status Decoder::State::ended(const char* where) const
{
	const std::string place = std::string("inside ") + where + " of " + levelName(level + 1);
	if (chunk.whole)
		return {
		    StatusCode::Corrupt, "the data end " + place + " although the chunk is whole",
		    chunk.end};
	return {
	    StatusCode::Truncated,
	    "the file ends " + place + " (" + std::to_string(size) + " of " +
	        std::to_string(info.bytes) + " bytes)",
	    size};
}

Status Decoder::State::corrupt(const std::string& what) const
{
	return {
	    StatusCode::Corrupt,
	    levelName(level + 1) + " " + what + " (chunk at offset " +
	        std::to_string(std::size_t(chunk.payload - data)) + ")",
	    std::uint64_t(chunk.payload - data)};
}

Status
Decoder::State::wrongSize(std::uint32_t found, const char* elements, std::uint32_t declared) const
{
	return corrupt(
	    "has " + std::to_string(found) + " " + elements + " but the head declares " +
	    std::to_string(declared));
}

/// Finds the next chunk that must not be skipped, which must be of this type.
Status Decoder::State::nextChunk(const std::string& what, std::uint8_t type)
{
	for (;;) {
		if (offset == size)
			return {
			    StatusCode::Truncated,
			    "the file ends before " + what + " (" + std::to_string(size) + " of " +
			        std::to_string(info.bytes) + " bytes)",
			    size};
		auto next = readChunk(data, size, offset);
		if (!next.ok())
			return next.status();
		chunk = *next;
		if (chunk.type != type && (chunk.type < 'a' || chunk.type > 'z'))
			return {
			    StatusCode::Corrupt,
			    "the chunk at offset " + std::to_string(offset) + " is none that may come here",
			    offset};
		offset = chunk.end;
		if (chunk.type == type)
			return {};
	}
}

/// Finds the next level chunk.
Status Decoder::State::openChunk()
{
	const std::size_t before = offset;
	if (Status s = nextChunk(levelName(level + 1), kLevelChunk); !s.ok())
		return s;
	std::uint64_t expected = 0;
	for (int l = level + 1; l == level + 1 || !row(l - 1).endsChunk; ++l)
		expected += row(l).bytes;
	if (chunk.declared != expected)
		return {
		    StatusCode::Corrupt,
		    "the chunk at offset " + std::to_string(before) + " is not as long as the head says",
		    before};
	coder = RangeDecoder(chunk.payload, chunk.size);
	return {};
}

Status Decoder::State::readBase()
{
	auto base =
	    BaseSyntax<RangeDecoder>(coder, head.lattice.bits - row(0).shift, head.has(kRestoration))
	        .read(row(0).vertices, row(0).faces);
	if (!base.ok())
		return base.status().code == StatusCode::Truncated ? ended("the base mesh") : base.status();
	// Everything that follows relies on cells being cells.
	if (head.mode == Mode::Compact) {
		const std::int32_t end = 1 << (head.lattice.bits - row(0).shift);
		for (const LatticePoint& p : base->positions)
			for (const std::int32_t x : p)
				if (x < 0 || x >= end)
					return corrupt("has a vertex outside the lattice");
	}
	table     = std::move(base->table);
	positions = std::move(base->positions);
	glue      = std::move(base->glue);
	if (head.has(kAttributes)) {
		attributes = std::make_unique<AttributeReader>(head);
		attributes->base(coder, table, glue);
		if (coder.exhausted())
			return ended("the attributes");
	}
	level = 0;
	return {};
}

Status Decoder::State::readSplit()
{
	const LevelRow& target = row(level + 1);
	Refinement refinement;
	if (!connectivityModels)
		connectivityModels =
		    std::make_unique<ConnectivityModels>(head.rich ? Contexts::Rich : Contexts::Fast);
	ConnectivitySyntax<RangeDecoder>(coder, *connectivityModels, table, positions).code(refinement);
	if (coder.exhausted())
		return ended("the connectivity");
	if (head.mode == Mode::Classic && !goesOn(kConnectivityWork))
		return wavemesh::cancelled();
	if (refinement.childVertices != target.vertices)
		return wrongSize(refinement.childVertices, "vertices", target.vertices);
	CornerTable child = refine(table, refinement);
	if (child.faceCount() != target.faces)
		return wrongSize(child.faceCount(), "faces", target.faces);
	Status status =
	    head.mode == Mode::Classic ? readDetails(refinement) : readChildren(refinement, child);
	if (status.ok() || status.code == StatusCode::Truncated) {
		if (attributes)
			attributes->split(coder, table, child, refinement, parentsOf(table, refinement));
		if (status.ok() && coder.exhausted())
			status = ended("the attributes");
		table = std::move(child);
		++level;
	}
	return status;
}

/// Classic: details, and the filter bank.
Status Decoder::State::readDetails(const Refinement& refinement)
{
	const Parents parents = parentsOf(table, refinement);
	UpdateWeights weights = updateWeights(table, refinement, parents, head.lifting);
	keepStill(glue, weights);
	std::vector<LatticePoint> details(parents.size(), {0, 0, 0});
	if (!detailModels)
		detailModels = std::make_unique<DetailModels>();
	DetailSyntax<RangeDecoder>(coder, *detailModels, table, refinement, positions).code(details);
	const Status cut = coder.exhausted() ? ended("the details") : Status();
	if (cut.ok() || cut.code == StatusCode::Truncated)
		synthesise(parents, weights, details, positions);
	return cut;
}

/// Compact: the cells of the new vertices.
Status Decoder::State::readChildren(const Refinement& refinement, const CornerTable& child)
{
	const Parents parents = parentsOf(table, refinement);
	if (!compactModels)
		compactModels = std::make_unique<CompactModels>(head.predictors);
	positions.resize(child.vertexCount, {0, 0, 0});
	withPositionSyntax<RangeDecoder>(
	    head.predictors,
	    [&](auto syntax) {
		    syntax.watch(watched(kConnectivityWork));
		    syntax.codeChildren(table, refinement, parents, row(level + 1).shift, positions);
	    },
	    coder, *compactModels, child, head.lattice.bits, glue);
	if (cancelled)
		return wavemesh::cancelled();
	return coder.exhausted() ? ended("the positions") : Status();
}

/// Compact: more bits for every vertex.
Status Decoder::State::readPrecise()
{
	if (!compactModels)
		compactModels = std::make_unique<CompactModels>(head.predictors);
	const int shift = row(level + 1).shift, bits = row(level).shift - shift;
	const Index whole = withPositionSyntax<RangeDecoder>(
	    head.predictors,
	    [&](auto syntax) {
		    syntax.watch(watched(0));
		    return syntax.codeBits(shift, bits, positions, {});
	    },
	    coder, *compactModels, table, head.lattice.bits, glue);
	if (cancelled)
		return wavemesh::cancelled();
	const Status cut = coder.exhausted() ? ended("the positions") : Status();
	if (!cut.ok() && whole == 0) { // nothing new: the level before, as it was
		for (LatticePoint& p : positions)
			for (std::int32_t& x : p)
				x >>= bits;
		return cut;
	}
	if (cut.ok() || cut.code == StatusCode::Truncated)
		++level;
	return cut;
}

/// Tells the progress of the level, and remembers the answer.
bool Decoder::State::goesOn(double fraction)
{
	cancelled = progress && !progress(fraction);
	return !cancelled;
}

/// The progress of the rest of a level, from `from` on.
Progress Decoder::State::watched(double from)
{
	return [this, from](double fraction) { return goesOn(from + (1 - from) * fraction); };
}

Status Decoder::State::advance()
{
	if (!stopped.ok())
		return stopped;
	if (level == info.finestLevel())
		return {StatusCode::InvalidArgument, "this is the finest level already"};
	if (level < 0 || row(level).endsChunk)
		if (Status s = openChunk(); !s.ok())
			return s;
	const bool splits = level >= 0 && row(level + 1).kind == LevelKind::Split;
	if (Status s = level < 0 ? readBase() : splits ? readSplit() : readPrecise(); !s.ok())
		return s;
	if (row(level).endsChunk && !chunk.whole)
		return {
		    StatusCode::Truncated, "the file ends inside the checksum of " + levelName(level),
		    size};
	return {};
}

/// What follows the finest level. What came whole is applied even if more is missing.
Status Decoder::State::finish()
{
	if (digestOf(table, positions) != head.digest)
		return {StatusCode::ChecksumMismatch, "the finest mesh does not match its digest"};
	if (head.features == 0)
		return {};
	Finish stage(head, table, positions, glue, attributes.get());
	Status status;
	for (int f = 0; f < kFeatures && status.ok(); ++f)
		if (head.has(Feature(f))) {
			status = openFeature(Feature(f));
			if (status.ok())
				status = stage.apply(Feature(f), chunk.payload, chunk.size);
		}
	if (status.ok() || status.code == StatusCode::Truncated)
		finished = stage.mesh();
	return status;
}

/// Finds the chunk of a feature.
Status Decoder::State::openFeature(Feature feature)
{
	if (Status s = nextChunk("what follows the levels", kFeatureChunk[feature]); !s.ok())
		return s;
	if (chunk.declared != head.featureBytes[feature])
		return {
		    StatusCode::Corrupt,
		    "the chunk that ends at offset " + std::to_string(chunk.end) +
		        " is not as long as the head says",
		    chunk.end};
	if (!chunk.whole)
		return {
		    StatusCode::Truncated,
		    "the file ends inside what follows the levels (" + std::to_string(size) + " of " +
		        std::to_string(info.bytes) + " bytes)",
		    size};
	return {};
}

namespace {

Status overLimit(std::uint64_t count, const char* what, const char* name, std::uint64_t limit)
{
	return {
	    StatusCode::LimitExceeded, "the file declares " + std::to_string(count) + " " + what +
	                                   ", more than the limit of " + std::to_string(limit) + " (" +
	                                   name + ")"};
}

/// Before memory or time is taken.
Status checkLimits(const Head& head, const StreamInfo& info, const DecodeLimits& limits)
{
	const LevelRow& finest       = head.rows.back();
	const std::uint32_t vertices = std::max(info.vertices, finest.vertices);
	const std::uint32_t faces    = std::max(info.faces, finest.faces);
	if (vertices > limits.maxVertices)
		return overLimit(vertices, "vertices", "maxVertices", limits.maxVertices);
	if (faces > limits.maxFaces)
		return overLimit(faces, "faces", "maxFaces", limits.maxFaces);
	const std::uint64_t values = info.features.attributeValues;
	if (values > limits.maxAttributeValues)
		return overLimit(
		    values, "numbers in attributes", "maxAttributeValues", limits.maxAttributeValues);
	// Levels that hardly grow would make decoding take many times what its mesh is worth.
	std::uint64_t inLevels = 0;
	for (const LevelRow& row : head.rows)
		inLevels += row.faces;
	const std::uint64_t share = inLevels / (std::uint64_t(finest.faces) + kFewFaces);
	if (share > limits.maxLevelShare)
		return overLimit(
		    share, "times its faces in all levels together", "maxLevelShare", limits.maxLevelShare);
	return {};
}

} // namespace

Decoder::Decoder(std::unique_ptr<State> state) : state_(std::move(state)) {}
Decoder::Decoder(Decoder&&) noexcept            = default;
Decoder& Decoder::operator=(Decoder&&) noexcept = default;
Decoder::~Decoder()                             = default;

const StreamInfo& Decoder::info() const
{
	return state_->info;
}

int Decoder::level() const
{
	return state_->level;
}

Result<Decoder>
Decoder::open(const std::uint8_t* data, std::size_t size, const DecodeLimits& limits)
{
	auto state      = std::make_unique<State>();
	std::size_t end = 0;
	auto head       = readHead(data, size, end);
	if (!head.ok())
		return head.status();
	state->data   = data;
	state->size   = size;
	state->head   = std::move(*head);
	state->info   = describe(state->head, end);
	state->offset = end;
	if (Status over = checkLimits(state->head, state->info, limits); !over.ok())
		return over;
	return Decoder(std::move(state));
}

Status Decoder::advance(const Progress& progress)
{
	State& s   = *state_;
	s.progress = progress;
	Status status;
	try {
		status = s.advance();
		if (status.ok() && s.level == s.info.finestLevel())
			status = s.finish();
	}
	catch (const std::bad_alloc&) {
		status = {StatusCode::OutOfMemory, "not enough memory for " + levelName(s.level + 1)};
	}
	s.progress = {};
	if (!status.ok() && status.code != StatusCode::InvalidArgument)
		s.stopped = status;
	return status;
}

MeshData Decoder::mesh() const
{
	const State& s = *state_;
	if (s.finished)
		return *s.finished;
	MeshData out;
	const int shift = s.row(s.level).shift;
	out.positions.reserve(s.positions.size());
	if (shift == 0)
		for (const LatticePoint& p : s.positions)
			out.positions.push_back(s.head.lattice.position(p));
	else
		for (const LatticePoint& p : likelyPositions(s.table, s.positions, shift, s.glue))
			out.positions.push_back(s.head.lattice.positionOfSixteenths(p));
	out.triangles.resize(s.table.faceCount());
	for (std::size_t f = 0; f < out.triangles.size(); ++f)
		for (std::size_t k = 0; k < 3; ++k)
			out.triangles[f][k] = s.table.vertex[3 * f + k];
	if (s.attributes)
		out.attributes = s.attributes->ofLevel();
	out.textures = s.head.textures;
	return out;
}

Result<StreamInfo> readInfo(const std::uint8_t* data, std::size_t size)
{
	std::size_t end = 0;
	auto head       = readHead(data, size, end);
	if (!head.ok())
		return head.status();
	return describe(*head, end);
}

Result<DecodedMesh> decode(const std::uint8_t* data, std::size_t size, const DecodeOptions& options)
{
	auto decoder = Decoder::open(
	    data, static_cast<std::size_t>(std::min<std::uint64_t>(size, options.maxBytes)),
	    options.limits);
	if (!decoder.ok())
		return decoder.status();
	const StreamInfo& info           = decoder->info();
	const int finest                 = info.finestLevel();
	const int target                 = options.level < 0 ? finest : std::min(options.level, finest);
	const std::vector<double> shares = decodingShares(info, target);
	Status status;
	while (decoder->level() < target && status.ok()) {
		const std::size_t next = std::size_t(decoder->level() + 1);
		const Stage stage(options.progress, next == 0 ? 0 : shares[next - 1], shares[next]);
		if (!stage(0))
			return cancelled();
		status = decoder->advance(stage);
	}
	if (!status.ok() && (status.code != StatusCode::Truncated || decoder->level() < 0))
		return status;
	try {
		DecodedMesh out {decoder->mesh(), decoder->level(), info};
		if (options.progress && !options.progress(1))
			return cancelled();
		return Result<DecodedMesh>(std::move(out), status);
	}
	catch (const std::bad_alloc&) {
		return Status(StatusCode::OutOfMemory, "not enough memory for the mesh");
	}
}

} // namespace wavemesh
