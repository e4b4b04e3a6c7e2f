// SPDX-License-Identifier: GPL-3.0-or-later
// Faces are sorted by the labels of their corners. Those with the same labels are laid onto each
// other, in whichever of the three turns their attributes agree; isolated vertices likewise.
#include "attribute_check.h"

#include "attribute_options.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace wavemesh::tool {

namespace {

using Label = std::array<std::int64_t, 3>;

/// A face with the corner first that makes its labels the smallest.
struct Key
{
	std::array<Label, 3> labels;
	std::uint32_t face, first;
};

std::vector<Key> keysOf(const LabelledMesh& mesh)
{
	std::vector<Key> keys;
	for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
		Key best {};
		for (std::uint32_t first = 0; first < 3; ++first) {
			Key key {{}, f, first};
			for (std::size_t k = 0; k < 3; ++k)
				key.labels[k] = mesh.labels[mesh.triangles[f][(first + k) % 3]];
			if (first == 0 || key.labels < best.labels)
				best = key;
		}
		keys.push_back(best);
	}
	std::stable_sort(
	    keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.labels < b.labels; });
	return keys;
}

std::vector<std::uint32_t> isolatedVertices(const LabelledMesh& mesh)
{
	std::vector<bool> used(mesh.labels.size(), false);
	for (const auto& t : mesh.triangles)
		for (const std::uint32_t v : t)
			used[v] = true;
	std::vector<std::uint32_t> out;
	for (std::uint32_t v = 0; v < used.size(); ++v)
		if (!used[v])
			out.push_back(v);
	std::sort(out.begin(), out.end(), [&](std::uint32_t a, std::uint32_t b) {
		return mesh.labels[a] < mesh.labels[b];
	});
	return out;
}

/// An attribute of both meshes.
class Pair
{
public:
	Pair(const Attribute& original, const Attribute& decoded, double step) :
	        original_(original), decoded_(decoded), step_(step)
	{
	}

	AttributeOf of() const { return original_.of; }
	bool isFauxEdges() const { return original_.kind == AttributeKind::FauxEdges; }
	std::string name() const { return nameOf(original_.of, original_.kind, original_.name); }

	bool agree(std::size_t a, std::size_t b) const
	{
		const auto width = std::size_t(original_.components);
		for (std::size_t k = 0; k < width; ++k)
			if (!isNear(original_.values[a * width + k], decoded_.values[b * width + k]))
				return false;
		return true;
	}
	/// Of faces, corner k of b lying on corner k + turn of a.
	bool agreeTurned(std::size_t a, std::size_t b, std::uint32_t turn) const
	{
		const auto bits       = [](double x) { return static_cast<std::uint32_t>(x) & 7; };
		const std::uint32_t x = bits(original_.values[a]), y = bits(decoded_.values[b]);
		return ((x >> turn) | (x << (3 - turn))) % 8 == y;
	}

private:
	bool isNear(double x, double y) const
	{
		if (std::memcmp(&x, &y, sizeof x) == 0)
			return true;
		// Half a step, and the rounding to 32 bits.
		return step_ > 0 && std::abs(x - y) <= 0.5 * step_ * (1 + 1e-9) + 1e-7 * std::abs(x);
	}

	const Attribute& original_;
	const Attribute& decoded_;
	double step_;
};

/// First of `pairs` that does not agree in this turn, or nullptr.
const Pair* disagreeing(
    const std::vector<Pair>& pairs,
    const LabelledMesh& a,
    const LabelledMesh& b,
    const Key& x,
    const Key& y,
    std::uint32_t turn)
{
	for (const Pair& p : pairs)
		for (std::uint32_t k = 0; k < 3; ++k) {
			const std::uint32_t i = (x.first + k) % 3, j = (y.first + k + turn) % 3;
			if (p.of() == AttributeOf::Vertex
			        ? !p.agree(a.triangles[x.face][i], b.triangles[y.face][j])
			    : p.of() == AttributeOf::Corner ? !p.agree(3 * x.face + i, 3 * y.face + j)
			    : p.isFauxEdges()               ? !p.agreeTurned(x.face, y.face, (3 + i - j) % 3)
			    : p.of() == AttributeOf::Face   ? !p.agree(x.face, y.face)
			                                    : false)
				return &p;
		}
	return nullptr;
}

/// Lays the elements of a run of equal keys, [begin, end) in both, onto each other.
template <class Fits>
const Pair* layRun(std::size_t begin, std::size_t end, Fits fits)
{
	std::vector<std::size_t> left(end - begin);
	std::iota(left.begin(), left.end(), begin);
	for (std::size_t i = begin; i < end; ++i) {
		const Pair* wrong = nullptr;
		const auto found  = std::find_if(left.begin(), left.end(), [&](std::size_t j) {
            const Pair* now = fits(i, j);
            wrong           = wrong ? wrong : now;
            return now == nullptr;
        });
		if (found == left.end())
			return wrong;
		left.erase(found);
	}
	return nullptr;
}

const Pair* checkFaces(const std::vector<Pair>& pairs, const LabelledMesh& a, const LabelledMesh& b)
{
	const std::vector<Key> x = keysOf(a), y = keysOf(b);
	const Pair* wrong = nullptr;
	for (std::size_t begin = 0, end = 0; begin < x.size() && !wrong; begin = end) {
		while (end < x.size() && x[end].labels == x[begin].labels)
			++end;
		wrong = layRun(begin, end, [&](std::size_t i, std::size_t j) -> const Pair* {
			const auto& labels = x[i].labels;
			const bool turns   = labels[0] == labels[1] && labels[1] == labels[2];
			const Pair* first  = disagreeing(pairs, a, b, x[i], y[j], 0);
			for (std::uint32_t turn = 1; first && turns && turn < 3; ++turn)
				if (!disagreeing(pairs, a, b, x[i], y[j], turn))
					return nullptr;
			return first;
		});
	}
	return wrong;
}

const Pair*
checkIsolated(const std::vector<Pair>& pairs, const LabelledMesh& a, const LabelledMesh& b)
{
	const std::vector<std::uint32_t> x = isolatedVertices(a), y = isolatedVertices(b);
	const Pair* wrong = nullptr;
	for (std::size_t begin = 0, end = 0; begin < x.size() && !wrong; begin = end) {
		while (end < x.size() && a.labels[x[end]] == a.labels[x[begin]])
			++end;
		wrong = layRun(begin, end, [&](std::size_t i, std::size_t j) -> const Pair* {
			for (const Pair& p : pairs)
				if (p.of() == AttributeOf::Vertex && !p.agree(x[i], y[j]))
					return &p;
			return nullptr;
		});
	}
	return wrong;
}

} // namespace

std::string whatDiffersInAttributes(
    const MeshData& original,
    const LabelledMesh& originalPlaces,
    const MeshData& decoded,
    const LabelledMesh& decodedPlaces,
    const StreamInfo& info)
{
	std::vector<Pair> pairs;
	for (std::size_t i = 0; i < decoded.attributes.size(); ++i) {
		const Attribute& mine = decoded.attributes[i];
		const auto theirs     = std::find_if(
		        original.attributes.begin(), original.attributes.end(), [&](const Attribute& a) {
                return a.of == mine.of && a.kind == mine.kind && a.name == mine.name &&
                       a.components == mine.components;
            });
		if (theirs == original.attributes.end())
			return "the original has no " + nameOf(mine.of, mine.kind, mine.name);
		pairs.emplace_back(*theirs, mine, info.attributes[i].step);
	}
	if (!decoded.textures.empty() && decoded.textures != original.textures)
		return "the textures have other names";
	for (const Pair& p : pairs)
		if (p.of() == AttributeOf::Mesh && !p.agree(0, 0))
			return p.name() + " is not the original's";
	const Pair* wrong = checkFaces(pairs, originalPlaces, decodedPlaces);
	if (!wrong)
		wrong = checkIsolated(pairs, originalPlaces, decodedPlaces);
	return wrong ? wrong->name() + " is not the original's" : "";
}

} // namespace wavemesh::tool
