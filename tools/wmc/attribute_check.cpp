// SPDX-License-Identifier: GPL-3.0-or-later
// Faces are sorted by the labels of their corners. Those with the same labels are sorted by their
// attributes and laid onto each other, in whichever of the three turns these agree; isolated
// vertices likewise.
#include "attribute_check.h"

#include "attribute_pair.h"

#include <algorithm>
#include <functional>

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

Signature signatureOf(
    const std::vector<Pair>& pairs,
    const LabelledMesh& mesh,
    const Key& key,
    std::uint32_t turn,
    bool isDecoded)
{
	Signature signature;
	for (const Pair& p : pairs) {
		if (p.isFauxEdges())
			p.appendTurned(isDecoded, key.face, (key.first + turn) % 3, signature);
		else if (p.of() == AttributeOf::Face)
			p.append(isDecoded, key.face, signature);
		for (std::uint32_t k = 0; k < 3; ++k) {
			const std::uint32_t corner = (key.first + turn + k) % 3;
			if (p.of() == AttributeOf::Vertex)
				p.append(isDecoded, mesh.triangles[key.face][corner], signature);
			else if (p.of() == AttributeOf::Corner)
				p.append(isDecoded, 3 * key.face + corner, signature);
		}
	}
	return signature;
}

struct Signed
{
	Signature signature;
	std::size_t at;
};

std::vector<Signed>
signedRun(std::size_t begin, std::size_t end, const std::function<Signature(std::size_t)>& sign)
{
	std::vector<Signed> run;
	for (std::size_t i = begin; i < end; ++i)
		run.push_back({sign(i), i});
	std::sort(run.begin(), run.end(), [](const Signed& x, const Signed& y) {
		return x.signature < y.signature;
	});
	return run;
}

/// Lays the elements of a run of equal keys, [begin, end) in both, onto each other: the same
/// signatures first, then whatever fits.
template <class Sign, class Fits>
const Pair* layRun(std::size_t begin, std::size_t end, Sign sign, Fits fits)
{
	if (end == begin + 1)
		return fits(begin, begin);
	const auto x = signedRun(begin, end, [&](std::size_t i) { return sign(false, i); });
	const auto y = signedRun(begin, end, [&](std::size_t j) { return sign(true, j); });
	std::vector<std::size_t> ofX, ofY;
	std::size_t i = 0, j = 0;
	while (i < x.size() && j < y.size())
		if (x[i].signature == y[j].signature && !fits(x[i].at, y[j].at))
			++i, ++j;
		else if (x[i].signature < y[j].signature)
			ofX.push_back(x[i++].at);
		else
			ofY.push_back(y[j++].at);
	for (; i < x.size(); ++i)
		ofX.push_back(x[i].at);
	for (; j < y.size(); ++j)
		ofY.push_back(y[j].at);
	for (const std::size_t a : ofX) {
		const Pair* wrong = nullptr;
		const auto found  = std::find_if(ofY.begin(), ofY.end(), [&](std::size_t b) {
            const Pair* now = fits(a, b);
            wrong           = wrong ? wrong : now;
            return now == nullptr;
        });
		if (found == ofY.end())
			return wrong;
		*found = ofY.back();
		ofY.pop_back();
	}
	return nullptr;
}

const Pair* checkFaces(const std::vector<Pair>& pairs, const LabelledMesh& a, const LabelledMesh& b)
{
	const std::vector<Key> x = keysOf(a), y = keysOf(b);
	const auto hasTurns = [&](std::size_t i) {
		const auto& labels = x[i].labels;
		return labels[0] == labels[1] && labels[1] == labels[2];
	};
	const auto sign = [&](bool isDecoded, std::size_t i) {
		const LabelledMesh& mesh = isDecoded ? b : a;
		const Key& key           = (isDecoded ? y : x)[i];
		Signature lowest         = signatureOf(pairs, mesh, key, 0, isDecoded);
		for (std::uint32_t turn = 1; hasTurns(i) && turn < 3; ++turn)
			lowest = std::min(lowest, signatureOf(pairs, mesh, key, turn, isDecoded));
		return lowest;
	};
	const auto fits = [&](std::size_t i, std::size_t j) {
		const Pair* first = disagreeing(pairs, a, b, x[i], y[j], 0);
		for (std::uint32_t turn = 1; first && hasTurns(i) && turn < 3; ++turn)
			if (!disagreeing(pairs, a, b, x[i], y[j], turn))
				return static_cast<const Pair*>(nullptr);
		return first;
	};
	const Pair* wrong = nullptr;
	for (std::size_t begin = 0, end = 0; begin < x.size() && !wrong; begin = end) {
		while (end < x.size() && x[end].labels == x[begin].labels)
			++end;
		wrong = layRun(begin, end, sign, fits);
	}
	return wrong;
}

const Pair*
checkIsolated(const std::vector<Pair>& pairs, const LabelledMesh& a, const LabelledMesh& b)
{
	const std::vector<std::uint32_t> x = isolatedVertices(a), y = isolatedVertices(b);
	const auto sign = [&](bool isDecoded, std::size_t i) {
		Signature signature;
		for (const Pair& p : pairs)
			if (p.of() == AttributeOf::Vertex)
				p.append(isDecoded, (isDecoded ? y : x)[i], signature);
		return signature;
	};
	const auto fits = [&](std::size_t i, std::size_t j) -> const Pair* {
		for (const Pair& p : pairs)
			if (p.of() == AttributeOf::Vertex && !p.agree(x[i], y[j]))
				return &p;
		return nullptr;
	};
	const Pair* wrong = nullptr;
	for (std::size_t begin = 0, end = 0; begin < x.size() && !wrong; begin = end) {
		while (end < x.size() && a.labels[x[end]] == a.labels[x[begin]])
			++end;
		wrong = layRun(begin, end, sign, fits);
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
