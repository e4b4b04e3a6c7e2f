// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The base mesh: connectivity by growing each component face by face across open edges ("gates"),
/// positions predicted by the parallelogram behind the gate. Written and read by the same template.
#pragma once

#include "entropy/models.h"
#include "mesh/integer_math.h"
#include "stage.h"
#include "syntax/glue_syntax.h"

#include <unordered_set>

namespace wavemesh {

struct BaseMesh
{
	CornerTable table;
	std::vector<LatticePoint> positions;
	Glue glue {}; ///< empty unless the file says that vertices are glued
};

template <class Coder>
class BaseSyntax
{
public:
	/// @param glued  may vertices be copies of others?
	BaseSyntax(Coder& coder, int bits, bool glued = false) :
	        coder_(coder), glued_(glued), glue_(coder)
	{
		last_.fill(static_cast<std::int32_t>(1u << (bits - 1)));
	}

	/// Has `progress` called now and then with the part of the faces that are coded. If it returns
	/// false, read() ends with Cancelled.
	void watch(const Progress& progress) { progress_ = progress; }

	/// Writes `base`; `source` tells the vertex of `base` behind each vertex of the coded order.
	/// Returns the mesh in the coded order: what read() gives.
	/// @param group  if glued: #V, of the vertices of `base`, see GlueSyntax::write()
	BaseMesh write(
	    const BaseMesh& base, std::vector<Index>& source, const std::vector<Index>* group = nullptr)
	{
		base_ = &base;
		glue_.write(group);
		codedAs_.assign(base.table.vertexCount, kNone);
		faceDone_.assign(base.table.faceCount(), 0);
		source.clear();
		source_ = &source;
		(void)grow(base.table.vertexCount, base.table.faceCount());
		BaseMesh out;
		out.table     = std::move(buildCornerTable(triangles_, base.table.vertexCount).value());
		out.positions = std::move(positions_);
		out.glue      = glue_.take();
		return out;
	}

	/// Reads a base mesh of known size. Truncated if the data end first, Corrupt if they do not
	/// describe a manifold of that size, Cancelled.
	Result<BaseMesh> read(Index vertices, Index faces)
	{
		if (Status s = grow(vertices, faces); !s.ok())
			return s;
		auto table = buildCornerTable(triangles_, vertices);
		if (positions_.size() != vertices || !table.ok())
			return Status(StatusCode::Corrupt, "the base mesh is not a manifold");
		return BaseMesh {std::move(*table), std::move(positions_), glue_.take()};
	}

private:
	static constexpr bool kReading = Coder::kReading;

	/// Edge from -> to of a face whose third vertex is `behind`; the next face lies across.
	struct Gate
	{
		Index from, to, behind;
		Index corner; ///< writing: of the face, facing the edge
	};

	static std::uint64_t key(Index a, Index b) { return (std::uint64_t(a) << 32) | b; }
	static Status corrupt() { return {StatusCode::Corrupt, "the base mesh contradicts itself"}; }

	Status grow(Index vertices, Index faces)
	{
		Index nextFace = 0; // writing
		while (triangles_.size() < faces) {
			Index corner = kNone;
			if constexpr (!kReading) {
				while (faceDone_[nextFace])
					++nextFace;
				corner = 3 * nextFace;
			}
			Index v[3];
			for (Index k = 0; k < 3; ++k)
				v[k] = newVertex(
				    vertexAt(corner, k), k > 0 ? v[0] : kNone, k > 1 ? v[1] : kNone, last_,
				    startModels_);
			if (glue_.failed() || positions_.size() > vertices ||
			    !addFace(v[0], v[1], v[2], corner))
				return coder_.exhausted() ? truncated() : corrupt();
			while (!gates_.empty()) {
				if (!goesOn(faces))
					return cancelled();
				const Gate gate = gates_.back();
				gates_.pop_back();
				if (Status s = pass(gate, vertices, faces); !s.ok())
					return s;
			}
		}
		return coder_.exhausted() ? truncated() : Status();
	}
	static Status truncated()
	{
		return {StatusCode::Truncated, "the data end inside the base mesh"};
	}

	bool goesOn(Index faces)
	{
		constexpr std::size_t kBetween = 1024;
		if (triangles_.size() < nextAsked_)
			return true;
		nextAsked_ = triangles_.size() + kBetween;
		return !progress_ || progress_(double(triangles_.size()) / double(faces));
	}

	Index vertexAt(Index corner, Index k) const
	{
		if constexpr (kReading)
			return kNone;
		else
			return base_->table.vertex[corner + k];
	}

	/// Looks across a gate: nothing, a new vertex, or one that is known.
	Status pass(const Gate& gate, Index vertices, Index faces)
	{
		if (edges_.count(key(gate.to, gate.from)) != 0)
			return {};
		Index corner = kNone, tip = kNone; // writing: corner beyond and the coded vertex there
		if constexpr (!kReading) {
			corner = base_->table.opposite[gate.corner];
			if (corner != kNone)
				tip = codedAs_[base_->table.vertex[corner]];
		}
		if (codeBit(coder_, boundary_, corner == kNone, 60))
			return coder_.exhausted() ? truncated() : Status();
		Index v;
		if (codeBit(coder_, isNew_, tip == kNone, 60)) {
			LatticePoint predicted;
			for (std::size_t k = 0; k < 3; ++k)
				predicted[k] = wrappingSubtract(
				    wrappingAdd(positions_[gate.from][k], positions_[gate.to][k]),
				    positions_[gate.behind][k]);
			v = newVertex(
			    kReading ? kNone : base_->table.vertex[corner], gate.from, gate.to, predicted,
			    tipModels_);
		}
		else
			v = codeKnown(gate, tip);
		if (coder_.exhausted())
			return truncated();
		if (glue_.failed() || positions_.size() > vertices || triangles_.size() >= faces ||
		    !addFace(gate.to, gate.from, v, kReading ? kNone : corner))
			return corrupt();
		return {};
	}

	/// A known vertex beyond the gate: mostly the far end of an open edge next to it.
	Index codeKnown(const Gate& gate, Index tip)
	{
		const Index left = openInto_[gate.from], right = openFrom_[gate.to];
		if (codeBit(coder_, isLeft_, tip == left, 60))
			return left;
		if (codeBit(coder_, isRight_, tip == right, 60))
			return right;
		return codeRaw(coder_, bitLength(positions_.size() - 1), tip);
	}

	/// @param from, to  its neighbours that are known, or kNone
	Index newVertex(
	    Index source,
	    Index from,
	    Index to,
	    const LatticePoint& predicted,
	    std::array<AdaptiveSigned<31>, 3>& models)
	{
		const Index first = glued_ ? glue_.next(source, from, to) : kNone;
		LatticePoint p {};
		if (first != kNone)
			p = positions_[first];
		for (std::size_t k = 0; k < 3 && first == kNone; ++k) {
			std::int64_t residual = 0;
			if constexpr (!kReading)
				residual = wrappingSubtract(base_->positions[source][k], predicted[k]);
			p[k] = wrappingAdd(
			    predicted[k], static_cast<std::int32_t>(models[k].code(coder_, residual)));
		}
		if constexpr (!kReading) {
			codedAs_[source] = static_cast<Index>(positions_.size());
			source_->push_back(source);
		}
		last_ = p;
		positions_.push_back(p);
		openInto_.push_back(kNone);
		openFrom_.push_back(kNone);
		return static_cast<Index>(positions_.size() - 1);
	}

	/// Adds face (a, b, c) and opens its edges; false if an edge is there already.
	bool addFace(Index a, Index b, Index c, Index corner)
	{
		const Index v[3] = {a, b, c};
		for (const Index x : v)
			if (x >= positions_.size())
				return false;
		Index first = kNone; // writing: corner of the face where a stands
		if constexpr (!kReading) {
			first = corner / 3 * 3;
			while (codedAs_[base_->table.vertex[first]] != a)
				++first;
			faceDone_[corner / 3] = 1;
		}
		triangles_.push_back({a, b, c});
		if (glued_)
			glue_.addFace(a, b, c);
		for (int k = 0; k < 3; ++k) {
			const Index from = v[k], to = v[(k + 1) % 3], behind = v[(k + 2) % 3];
			if (from == to || !edges_.insert(key(from, to)).second)
				return false;
			openFrom_[from] = to;
			openInto_[to]   = from;
			Index facing    = kNone;
			if constexpr (!kReading)
				facing = first / 3 * 3 + (first + Index(k) + 2) % 3;
			gates_.push_back({from, to, behind, facing});
		}
		return true;
	}

	Coder& coder_;
	bool glued_;
	GlueSyntax<Coder> glue_;
	std::vector<std::array<Index, 3>> triangles_;
	std::vector<LatticePoint> positions_;
	std::vector<Gate> gates_;
	std::unordered_set<std::uint64_t> edges_; ///< directed
	std::vector<Index> openInto_, openFrom_;  ///< #V: the youngest edges
	LatticePoint last_ {};
	Progress progress_;
	std::size_t nextAsked_ = 0;
	AdaptiveBit boundary_, isNew_, isLeft_, isRight_;
	std::array<AdaptiveSigned<31>, 3> startModels_, tipModels_;

	// Writing only.
	const BaseMesh* base_       = nullptr;
	std::vector<Index>* source_ = nullptr;
	std::vector<Index> codedAs_;         ///< #V: place in the coded order
	std::vector<std::uint8_t> faceDone_; ///< #F
};

} // namespace wavemesh
