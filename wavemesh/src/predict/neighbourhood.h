// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// What is known around the vertices of a level while their positions are coded.
#pragma once

#include "multires/refinement.h"
#include "predict/vertex_view.h"
#include "wavelet/lifting.h"

namespace wavemesh {

/// "Known" vertices are those whose cell has the precision being coded already.
class Neighbourhood
{
public:
	/// @param table    connectivity of the level that is being coded
	/// @param glue     of the base mesh
	/// @param records  #V, of the known vertices
	Neighbourhood(
	    const CornerTable& table, const Glue& glue, const std::vector<VertexRecord>& records);

	/// Before the cells of the vertices that a split added are coded; those of the parent level are
	/// known.
	///
	/// @param parent      the level before
	/// @param refinement  from `parent` to the table given
	/// @param cells       the first #parent rows are read
	/// @return the new vertices in the order of coding. Linear.
	std::vector<Index> beginChildren(
	    const CornerTable& parent,
	    const Refinement& refinement,
	    const Parents& parents,
	    const std::vector<LatticePoint>& cells);

	/// Before `bits` more bits of all vertices are coded; none is known.
	/// @return all vertices in the order of coding. Linear.
	std::vector<Index> beginBits(const std::vector<LatticePoint>& cells, int bits);

	/// The vertex is the next; it and those behind it are not known.
	void reach(Index v) { now_ = rank_[v]; }
	bool known(Index v) const { return rank_[v] < now_; }
	/// Was it coded in this pass, or will it be?
	bool isNew(Index v) const { return v >= firstNew_; }
	/// Where the vertex is, 1/16.
	void place(Index v, const LatticePoint& sixteenths) { likely_[v] = sixteenths; }

	/// Fills in the view of a vertex, all but its expectations: offset, height, scale, across,
	/// along and the predictions on the surface.
	void look(Index v, VertexView& view) const;

private:
	Vector at(Index v) const { return {likely_[v][0], likely_[v][1], likely_[v][2]}; }
	Vector fromOrigin(const VertexView& view, Index v) const { return at(v) - view.origin; }
	void findRing(Index v, VertexView& view) const;
	void addParallelogram(
	    Index v,
	    VertexView& view,
	    std::size_t i,
	    Vector& all,
	    std::size_t& allCount,
	    Vector& knownAll,
	    Vector& first) const;
	Vector middleOfParents(const std::array<Index, 3>& parents) const;
	void lookAtParents(
	    Index v,
	    VertexView& view,
	    const std::array<Index, 3>& parents,
	    Vector& far,
	    Vector& wings,
	    Vector& bend) const;
	Vector beyond(Index c) const;
	void describe(
	    VertexView& view,
	    const std::array<Vector, kOffsetFeatures>& features,
	    const std::array<Index, 3>* parents) const;

	const CornerTable& table_;
	const Glue& glue_;
	const std::vector<VertexRecord>& records_;
	std::vector<Index> first_;
	std::vector<Index> rank_; ///< #V: place in the order of coding
	Index now_      = 0;      ///< rank of the vertex being coded
	Index firstNew_ = 0;
	bool births_    = false;
	std::vector<LatticePoint> likely_; ///< #V: 16 times the cell, or where in its cell it may be
	std::vector<LatticePoint> laplacians_;
	std::vector<UnitVector> normals_;

	const CornerTable* parent_ = nullptr;
	const Parents* parents_    = nullptr;
	std::vector<Index> edgeCorner_; ///< #children: corner of the parent level facing the edge
};

} // namespace wavemesh
