// SPDX-License-Identifier: GPL-3.0-or-later
// The decoder's levels: the base mesh, and the steps from each level to the next.
#include "decoder_state.h"
#include "level_work.h"
#include "stage.h"
#include "syntax/base_syntax.h"
#include "wavelet/lifting.h"

namespace wavemesh {

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

Status Decoder::State::readBase()
{
	const double end = attributesBegin();
	BaseSyntax<RangeDecoder> syntax(
	    coder, head.lattice.bits - row(0).shift, head.has(kRestoration));
	syntax.watch(watched(0, end));
	auto base = syntax.read(row(0).vertices, row(0).faces);
	if (!base.ok())
		return base.status().code == StatusCode::Truncated ? ended("the base mesh") : base.status();
	// Everything that follows relies on cells being cells.
	if (head.mode == Mode::Compact) {
		const std::int32_t cells = 1 << (head.lattice.bits - row(0).shift);
		for (const LatticePoint& p : base->positions)
			for (const std::int32_t x : p)
				if (x < 0 || x >= cells)
					return corrupt("has a vertex outside the lattice");
	}
	table     = std::move(base->table);
	positions = std::move(base->positions);
	glue      = std::move(base->glue);
	if (head.has(kAttributes)) {
		attributes = std::make_unique<AttributeReader>(head);
		attributes->base(coder, table, glue, watched(end, 1));
		if (cancelled)
			return wavemesh::cancelled();
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
	if (head.mode == Mode::Classic && !goesOn(kConnectivityWork * attributesBegin()))
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
			attributes->split(
			    coder, table, child, refinement, parentsOf(table, refinement),
			    watched(attributesBegin(), 1));
		if (cancelled)
			return wavemesh::cancelled();
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
	lastParents = parentsOf(table, refinement);
	if (!compactModels)
		compactModels = std::make_unique<CompactModels>(head.predictors);
	positions.resize(child.vertexCount, {0, 0, 0});
	const double end = attributesBegin();
	withPositionSyntax<RangeDecoder>(
	    head.predictors,
	    [&](auto syntax) {
		    syntax.watch(watched(kConnectivityWork * end, end));
		    syntax.codeChildren(table, refinement, lastParents, row(level + 1).shift, positions);
	    },
	    coder, *compactModels, child, head.lattice.bits, glue);
	if (child.vertexCount == head.rows.back().vertices)
		lastParents = {}; // no level is shown that needs them
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
		    syntax.watch(watched(0, 1));
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
	cancelled = progress && !progress(levelShare * fraction);
	return !cancelled;
}

/// The progress of a part of a level.
Progress Decoder::State::watched(double from, double to)
{
	return [this, from, to](double fraction) { return goesOn(from + (to - from) * fraction); };
}

/// Where in the work of the next level its attributes begin.
double Decoder::State::attributesBegin() const
{
	const LevelInfo* next = &info.levels[std::size_t(level + 1)];
	const double all      = levelWork(info.mode, *next, level < 0 ? nullptr : next - 1);
	return all > 0 ? 1 - attributeWork(*next) / all : 1;
}

} // namespace wavemesh
