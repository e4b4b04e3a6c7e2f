// SPDX-License-Identifier: GPL-3.0-or-later
#include "stage_meshes.h"

#include "mesh/quantization.h"
#include "multires/refine.h"
#include "syntax/base_syntax.h"

#include <algorithm>
#include <utility>

namespace wavemesh::test {

StageMesh stageMesh(const MeshData& mesh, int bits)
{
	StageMesh out;
	out.table = buildCornerTable(mesh.triangles, static_cast<Index>(mesh.positions.size())).value();
	out.positions = quantise(mesh.positions, makeLattice(mesh.positions, bits, 0).value());
	return out;
}

MeshData meshOf(const CornerTable& table, const std::vector<LatticePoint>& positions)
{
	MeshData m;
	m.triangles = facesOf(table);
	for (Index v = 0; v < table.vertexCount; ++v) {
		const LatticePoint p = v < positions.size() ? positions[v] : LatticePoint {};
		m.positions.push_back({double(p[0]), double(p[1]), double(p[2])});
	}
	return m;
}

std::vector<LatticePoint>
pickedPositions(const std::vector<LatticePoint>& fine, const std::vector<Index>& rows)
{
	std::vector<LatticePoint> out;
	for (const Index v : rows)
		out.push_back(fine[v]);
	return out;
}

std::vector<Triangle> facesOf(const CornerTable& table)
{
	std::vector<Triangle> faces;
	for (Index f = 0; f < table.faceCount(); ++f)
		faces.push_back({table.vertex[3 * f], table.vertex[3 * f + 1], table.vertex[3 * f + 2]});
	return faces;
}

std::vector<Triangle> sortedFaces(std::vector<Triangle> faces)
{
	for (Triangle& t : faces)
		std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
	std::sort(faces.begin(), faces.end());
	return faces;
}

std::string whatIsNotLinked(const CornerTable& t)
{
	if (t.opposite.size() != t.vertex.size())
		return "sizes differ";
	for (Index c = 0; c < t.cornerCount(); ++c) {
		const Index d = t.opposite[c];
		if (d == kNone)
			continue;
		if (d >= t.cornerCount() || t.opposite[d] != c)
			return "the opposite of the opposite of corner " + std::to_string(c) + " is another";
		if (t.vertex[nextCorner(c)] != t.vertex[prevCorner(d)] ||
		    t.vertex[prevCorner(c)] != t.vertex[nextCorner(d)])
			return "corner " + std::to_string(c) + " and its opposite face two edges";
	}
	return {};
}

Levels makeLevels(
    const MeshData& mesh, const GeometricalCriterion& criterion, int bits, const Steering& steering)
{
	const StageMesh fine = stageMesh(mesh, bits);
	const auto steps =
	    coarsenAll(fine.table, fine.positions, criterion, steering, [](double) { return true; });
	BaseMesh base;
	base.table = steps.empty() ? fine.table : steps.back().coarse;
	base.positions.resize(base.table.vertexCount);
	RangeEncoder ignored;
	std::vector<Index> source;
	base = BaseSyntax<RangeEncoder>(ignored, bits).write(base, source);
	Levels out;
	out.replay = replay(steps, std::move(base.table), std::move(source));
	for (const Index v : out.replay.source)
		out.positions.push_back(fine.positions[v]);
	return out;
}

Refinement randomRefinement(const CornerTable& parent, Rng& rng, bool flips)
{
	Refinement r;
	r.parentVertices = r.childVertices = parent.vertexCount;
	r.childOnEdge.assign(parent.cornerCount(), kNone);
	r.faceCode.assign(parent.faceCount(), kFaceNone);
	const std::uint32_t density = 1 + rng.below(9);
	for (Index c = 0; c < parent.cornerCount(); ++c) {
		const Index d = parent.opposite[c];
		if ((d != kNone && d < c) || rng.below(10) >= density)
			continue;
		r.childOnEdge[c] = r.childVertices++;
		if (d != kNone)
			r.childOnEdge[d] = r.childOnEdge[c];
	}
	std::vector<std::uint8_t> flipped(parent.faceCount(), 0);
	for (Index f = 0; f < parent.faceCount(); ++f) {
		const FaceShape shape = faceShape(r.childOnEdge, f);
		if (shape.splits == 2 && rng.below(2))
			r.faceCode[f] = kFaceDiagonal1;
		if (shape.splits != 1 || !flips || rng.below(3) == 0)
			continue;
		const bool second = rng.below(2) == 1;
		const Index edge  = second ? prevCorner(shape.corner) : nextCorner(shape.corner);
		if (!canFlip(parent, r, flipped, edge))
			continue;
		r.faceCode[f] = second ? kFaceFlip2 : kFaceFlip1;
		flipped[f] = flipped[parent.opposite[edge] / 3] = 1;
	}
	for (Index f = 0; f < parent.faceCount(); ++f)
		if (faceShape(r.childOnEdge, f).splits == 0 && !flipped[f] && rng.below(4) == 0) {
			r.faceCode[f] = kFaceCentre;
			r.hasCentres  = true;
			++r.childVertices;
		}
	return r;
}

} // namespace wavemesh::test
