// SPDX-License-Identifier: GPL-3.0-or-later
// The way through a file: chunk by chunk, level by level, and what follows them.
#include "decoder_state.h"
#include "finish/finish.h"
#include "guard.h"
#include "level_work.h"
#include "predict/shown_positions.h"
#include "stage.h"

namespace wavemesh {

namespace {

/// So many faces may be in any number of levels.
constexpr std::uint64_t kFewFaces = 1000;

const char* forTheHead()
{
	return "for the head of the file";
}

} // namespace

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

Status Decoder::State::advance()
{
	if (!stopped.ok())
		return stopped;
	if (level == info.finestLevel())
		return {StatusCode::InvalidArgument, "this is the finest level already"};
	if (level < 0 || row(level).endsChunk)
		if (Status s = openChunk(); !s.ok())
			return s;
	levelShare        = shareOfNextLevel();
	const bool splits = level >= 0 && row(level + 1).kind == LevelKind::Split;
	if (Status s = level < 0 ? readBase() : splits ? readSplit() : readPrecise(); !s.ok())
		return s;
	if (row(level).endsChunk && !chunk.whole)
		return {
		    StatusCode::Truncated, "the file ends inside the checksum of " + levelName(level),
		    size};
	return {};
}

/// Its part of the work up to the end of the file, if it is the finest.
double Decoder::State::shareOfNextLevel() const
{
	if (level + 1 != info.finestLevel())
		return 1;
	const LevelInfo* next = &info.levels.back();
	const double work     = levelWork(info.mode, *next, level < 0 ? nullptr : next - 1);
	double all            = work;
	for (const double w : featureWork(info))
		all += w;
	return all > 0 ? work / all : 1;
}

/// What follows the finest level. What came whole is applied even if more is missing.
Status Decoder::State::finish()
{
	if (digestOf(table, positions) != head.digest)
		return {StatusCode::ChecksumMismatch, "the finest mesh does not match its digest"};
	if (head.features == 0)
		return {};
	Finish finish(head, table, positions, glue, attributes.get());
	Status status;
	const auto work = featureWork(info);
	double done = 0, all = 0;
	for (const double w : work)
		all += w;
	for (std::size_t f = 0; f < kFeatures && status.ok(); ++f) {
		const double before = done;
		done += all > 0 ? work[f] / all : 0;
		if (!head.has(Feature(f)))
			continue;
		status = openFeature(Feature(f));
		if (status.ok())
			status = finish.apply(
			    Feature(f), chunk.payload, chunk.size,
			    Stage(progress, levelShare, 1).part(before, done));
	}
	if (status.ok() || status.code == StatusCode::Truncated)
		finished = finish.mesh();
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
	// Of a restored mesh level J has rows of its own, more of vertices, fewer of faces.
	const std::uint64_t values = attributeValues(head, vertices, faces);
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
	const auto work = [&]() -> Result<Decoder> {
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
	};
	return guarded(work, forTheHead);
}

Status Decoder::advance(const Progress& progress)
{
	State& s        = *state_;
	const auto work = [&] {
		s.progress    = progress;
		Status status = s.advance();
		if (status.ok() && s.level == s.info.finestLevel())
			status = s.finish();
		return status;
	};
	const Status status = guarded(work, [&] { return "for " + levelName(s.level + 1); });
	s.progress          = {};
	if (!status.ok() && status.code != StatusCode::InvalidArgument)
		s.stopped = status;
	return status;
}

MeshData Decoder::mesh() const
{
	const State& s = *state_;
	// A level that was given up half-way has changed what the level before needs.
	if (!s.stopped.ok() && s.stopped.code != StatusCode::Truncated)
		return {};
	if (s.finished)
		return *s.finished;
	MeshData out;
	const int shift = s.row(s.level).shift;
	out.positions.reserve(s.positions.size());
	if (shift == 0)
		for (const LatticePoint& p : s.positions)
			out.positions.push_back(s.head.lattice.position(p));
	else
		for (const LatticePoint& p : shownPositions(
		         s.table, s.lastParents, s.positions, shift, s.head.lattice.bits, s.glue))
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
	const auto work = [&]() -> Result<StreamInfo> {
		std::size_t end = 0;
		auto head       = readHead(data, size, end);
		if (!head.ok())
			return head.status();
		return describe(*head, end);
	};
	return guarded(work, forTheHead);
}

namespace {

Result<DecodedMesh>
decodeTo(const std::uint8_t* data, std::size_t size, const DecodeOptions& options)
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
		// The last one finishes the mesh, too.
		const double end = int(next) == target ? 1 : shares[next];
		const Stage stage(options.progress, next == 0 ? 0 : shares[next - 1], end);
		if (!stage(0))
			return cancelled();
		status = decoder->advance(stage);
	}
	if (!status.ok() && (status.code != StatusCode::Truncated || decoder->level() < 0))
		return status;
	DecodedMesh out {decoder->mesh(), decoder->level(), info};
	if (options.progress && !options.progress(1))
		return cancelled();
	return Result<DecodedMesh>(std::move(out), status);
}

} // namespace

Result<DecodedMesh> decode(const std::uint8_t* data, std::size_t size, const DecodeOptions& options)
{
	return guarded([&] { return decodeTo(data, size, options); }, [] { return "for the mesh"; });
}

} // namespace wavemesh
