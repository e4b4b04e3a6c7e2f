// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/restoration.h"

#include "syntax/point_set_syntax.h"

#include <algorithm>
#include <cmath>

namespace wavemesh {

RestoredNumbers restoredNumbers(const Glue& glue, Index vertices)
{
	RestoredNumbers numbers;
	numbers.of.resize(vertices);
	for (Index v = 0; v < vertices; ++v)
		numbers.of[v] = glue.isCopy(v) ? numbers.of[glue.first[v]] : numbers.count++;
	return numbers;
}

RestoredMesh restore(
    const CornerTable& finest,
    const std::vector<LatticePoint>& positions,
    const RestoredNumbers& numbers,
    const Restoration& r)
{
	RestoredMesh out;
	out.points.resize(numbers.count);
	for (Index v = 0; v < finest.vertexCount; ++v)
		out.points[numbers.of[v]] = positions[v];
	out.points.insert(out.points.end(), r.isolated.begin(), r.isolated.end());

	out.triangles.resize(finest.faceCount());
	for (Index f = 0; f < finest.faceCount(); ++f) {
		auto& t = out.triangles[f];
		for (Index k = 0; k < 3; ++k)
			t[k] = numbers.of[finest.vertex[3 * f + k]];
		if (f < r.turned.size() && r.turned[f])
			std::swap(t[1], t[2]);
	}
	for (Index f = 0; f < r.copies.size(); ++f) {
		const auto t = out.triangles[f];
		out.triangles.insert(out.triangles.end(), r.copies[f].same, t);
		out.triangles.insert(out.triangles.end(), r.copies[f].turned, {t[0], t[2], t[1]});
	}
	for (const auto& [twice, once] : r.degenerate)
		out.triangles.push_back({twice, twice, once});
	return out;
}

std::vector<double> normalsOf(const RestoredMesh& mesh, AttributeOf of)
{
	std::vector<double> faces, vertices(3 * mesh.points.size(), 0);
	for (const auto& t : mesh.triangles) {
		double a[3], b[3]; // edges
		for (std::size_t k = 0; k < 3; ++k) {
			a[k] = double(mesh.points[t[1]][k]) - double(mesh.points[t[0]][k]);
			b[k] = double(mesh.points[t[2]][k]) - double(mesh.points[t[0]][k]);
		}
		for (std::size_t k = 0; k < 3; ++k) {
			const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
			faces.push_back(a[i] * b[j] - a[j] * b[i]);
			for (const Index v : t)
				vertices[3 * v + k] += faces.back();
		}
	}
	std::vector<double> out = of == AttributeOf::Face ? std::move(faces) : std::move(vertices);
	for (std::size_t i = 0; i < out.size(); i += 3) {
		const double length =
		    std::sqrt(out[i] * out[i] + out[i + 1] * out[i + 1] + out[i + 2] * out[i + 2]);
		for (std::size_t k = i; k < i + 3; ++k)
			out[k] = length > 0 ? out[k] / length : 0;
	}
	if (of != AttributeOf::Corner)
		return out;
	std::vector<double> corners;
	corners.reserve(9 * mesh.triangles.size());
	for (const auto& t : mesh.triangles)
		for (const Index v : t)
			for (std::size_t k = 0; k < 3; ++k)
				corners.push_back(out[3 * v + k]);
	return corners;
}

namespace {

/// For each face of the finest level the cut's face that is the same.
std::vector<Index>
matchFaces(const CornerTable& cut, const CornerTable& finest, const std::vector<Index>& source)
{
	const std::vector<Index> corners = matchCorners(finest, cut, source);
	std::vector<Index> match(finest.faceCount());
	for (Index f = 0; f < finest.faceCount(); ++f)
		match[f] = corners[3 * f] / 3;
	return match;
}

void restoreCopies(
    const ManifoldCut& cut, const std::vector<Index>& match, Restoration& r, RestoredSource& from)
{
	if (cut.copies.empty())
		return;
	std::vector<Index> begin(cut.face.size() + 1, 0); // of the cut's faces in cut.copies
	for (const FaceCopy& copy : cut.copies)
		++begin[copy.of + 1];
	for (std::size_t f = 0; f + 1 < begin.size(); ++f)
		begin[f + 1] += begin[f];
	r.copies.resize(match.size());
	for (std::size_t f = 0; f < match.size(); ++f)
		for (const bool turned : {false, true})
			for (Index i = begin[match[f]]; i < begin[match[f] + 1]; ++i)
				if (cut.copies[i].turned == turned) {
					from.face.push_back(cut.copies[i].face);
					++(turned ? r.copies[f].turned : r.copies[f].same);
				}
}

/// Sorted by their vertices: nearly the same as the last one.
void restoreDegenerate(
    const ManifoldCut& cut, const Triangles& original, Restoration& r, RestoredSource& from)
{
	std::vector<Index> restoredAs(cut.degenerate.empty() ? 0 : from.vertex.size());
	for (Index v = 0; v < restoredAs.size(); ++v)
		restoredAs[from.vertex[v]] = v;
	struct Row
	{
		std::array<Index, 2> vertices;
		Index face;
	};
	std::vector<Row> rows;
	rows.reserve(cut.degenerate.size());
	for (const Index f : cut.degenerate) {
		const auto& t = original[f];
		Index twice = t[0], once = t[2]; // all three may be the same
		if (t[1] == t[2]) {
			twice = t[1];
			once  = t[0];
		}
		else if (t[2] == t[0])
			once = t[1];
		rows.push_back({{restoredAs[twice], restoredAs[once]}, f});
	}
	std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
		return a.vertices < b.vertices;
	});
	for (const Row& row : rows) {
		r.degenerate.push_back(row.vertices);
		from.face.push_back(row.face);
	}
}

/// In the order that the file has them in.
void restoreIsolated(
    const ManifoldCut& cut,
    const MeshData& original,
    const Lattice& lattice,
    Restoration& r,
    RestoredSource& from)
{
	std::vector<std::array<double, 3>> positions;
	for (const Index v : cut.isolated)
		positions.push_back(original.positions[v]);
	std::vector<LatticePoint> points = quantise(positions, lattice);
	RangeEncoder ignored;
	for (const Index row :
	     PointSetSyntax<RangeEncoder>(ignored).code(points, Index(points.size()), lattice.bits)) {
		r.isolated.push_back(points[row]);
		from.vertex.push_back(cut.isolated[row]);
	}
}

} // namespace

Restoration whatToRestore(
    const ManifoldCut& cut,
    const MeshData& original,
    const Lattice& lattice,
    const CornerTable& finest,
    const std::vector<Index>& source,
    const RestoredNumbers& numbers,
    RestoredSource& from)
{
	from.vertex.resize(numbers.count);
	for (std::size_t v = 0; v < source.size(); ++v)
		from.vertex[numbers.of[v]] = cut.vertex[source[v]];
	const std::vector<Index> match = matchFaces(cut.table, finest, source);
	Restoration r;
	r.turned.reserve(match.size());
	for (const Index f : match) {
		from.face.push_back(cut.face[f]);
		r.turned.push_back(cut.turned[f]);
	}
	restoreCopies(cut, match, r, from);
	restoreIsolated(cut, original, lattice, r, from);
	restoreDegenerate(cut, original.triangles, r, from);
	return r;
}

} // namespace wavemesh
