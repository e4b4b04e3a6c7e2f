// SPDX-License-Identifier: GPL-3.0-or-later
// Colours (hashes of labels and surroundings) are refined on both meshes alike. They must agree as
// multisets. Then each component of a is laid onto b: one face on a face of the same colour decides
// about all others, across the edges. Colours only choose what is tried first; what counts is the
// map found, which is checked corner by corner.
#include "isomorphism.h"

#include <algorithm>
#include <unordered_map>

namespace wavemesh::tool {

namespace {

constexpr std::uint32_t kNone = 0xffffffffu;

std::uint64_t mix(std::uint64_t a, std::uint64_t b)
{
	std::uint64_t z = a * 0x9e3779b97f4a7c15u + b + 0x632be59bd9b4e019u;
	z               = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
	z               = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
	return z ^ (z >> 31);
}

/// A mesh with its half-edges' opposites and the colours of vertices and faces.
struct Coloured
{
	const LabelledMesh& mesh;
	std::vector<std::uint32_t> twin; ///< of half-edge 3 f + k, from corner k to k + 1
	std::vector<std::uint64_t> vertex, face;
	bool isManifold = true;

	explicit Coloured(const LabelledMesh& m) : mesh(m)
	{
		for (const auto& p : m.labels) {
			std::uint64_t h = 0;
			for (std::int64_t x : p)
				h = mix(h, static_cast<std::uint64_t>(x));
			vertex.push_back(h);
		}
		face.resize(m.triangles.size());
		findTwins();
	}

	std::uint32_t corner(std::uint32_t f, std::uint32_t k) const
	{
		return mesh.triangles[f][k % 3];
	}

	void findTwins()
	{
		struct Edge
		{
			std::uint64_t key;
			std::uint32_t h;
		};
		std::vector<Edge> edges;
		edges.reserve(face.size() * 3);
		for (std::uint32_t f = 0; f < face.size(); ++f)
			for (std::uint32_t k = 0; k < 3; ++k) {
				const std::uint64_t a = corner(f, k), b = corner(f, k + 1);
				edges.push_back({std::min(a, b) << 32 | std::max(a, b), 3 * f + k});
			}
		std::sort(edges.begin(), edges.end(), [](const Edge& x, const Edge& y) {
			return x.key != y.key ? x.key < y.key : x.h < y.h;
		});
		twin.assign(edges.size(), kNone);
		for (std::size_t i = 1; i < edges.size(); ++i) {
			const std::uint32_t g = edges[i - 1].h, h = edges[i].h;
			if (edges[i].key != edges[i - 1].key)
				continue;
			if (twin[g] != kNone || corner(g / 3, g % 3) == corner(h / 3, h % 3))
				isManifold = false;
			twin[g] = h;
			twin[h] = g;
		}
	}

	/// One round: a face's colour from its corners', a vertex's from its faces'.
	void refine()
	{
		std::vector<std::uint64_t> sum(vertex.size(), 0);
		for (std::uint32_t f = 0; f < face.size(); ++f) {
			face[f] = 0;
			for (std::uint32_t k = 0; k < 3; ++k) {
				const std::uint64_t seen = mix(
				    mix(vertex[corner(f, k)], vertex[corner(f, k + 1)]), vertex[corner(f, k + 2)]);
				sum[corner(f, k)] += seen;
				face[f] += mix(seen, 1);
			}
		}
		for (std::size_t v = 0; v < vertex.size(); ++v)
			vertex[v] = mix(vertex[v], sum[v]);
	}
};

using Groups = std::unordered_map<std::uint64_t, std::vector<std::uint32_t>>;

Groups groupByColour(const std::vector<std::uint64_t>& colours)
{
	Groups groups;
	for (std::uint32_t i = 0; i < colours.size(); ++i)
		groups[colours[i]].push_back(i);
	return groups;
}

bool sameMultiset(std::vector<std::uint64_t> a, std::vector<std::uint64_t> b)
{
	std::sort(a.begin(), a.end());
	std::sort(b.begin(), b.end());
	return a == b;
}

class Matcher
{
public:
	Matcher(const Coloured& a, const Coloured& b) :
	        a_(a), b_(b), faceTo_(a.face.size(), kNone), turn_(a.face.size(), 0),
	        isTaken_(b.face.size(), false), vertexTo_(a.vertex.size(), kNone),
	        vertexFrom_(b.vertex.size(), kNone)
	{
	}

	bool isMapped(std::uint32_t f) const { return faceTo_[f] != kNone; }
	bool isTaken(std::uint32_t g) const { return isTaken_[g]; }

	/// Lays the component of face f onto b, corner 0 of f on corner `turn` of g. False, and nothing
	/// done, if they do not fit.
	bool lay(std::uint32_t f, std::uint32_t g, std::uint32_t turn)
	{
		faces_.clear();
		vertices_.clear();
		bool fits = put(f, g, turn);
		for (std::size_t i = 0; fits && i < faces_.size(); ++i)
			fits = spread(faces_[i]);
		if (!fits)
			undo();
		return fits;
	}

private:
	bool put(std::uint32_t f, std::uint32_t g, std::uint32_t turn)
	{
		if (faceTo_[f] != kNone)
			return faceTo_[f] == g && turn_[f] == turn;
		if (isTaken_[g])
			return false;
		faceTo_[f]  = g;
		turn_[f]    = static_cast<std::uint8_t>(turn);
		isTaken_[g] = true;
		faces_.push_back(f);
		for (std::uint32_t k = 0; k < 3; ++k) {
			const std::uint32_t v = a_.corner(f, k), w = b_.corner(g, k + turn);
			if (vertexTo_[v] == w)
				continue;
			if (vertexTo_[v] != kNone || vertexFrom_[w] != kNone ||
			    a_.mesh.labels[v] != b_.mesh.labels[w])
				return false;
			vertexTo_[v]   = w;
			vertexFrom_[w] = v;
			vertices_.push_back(v);
		}
		return true;
	}

	bool spread(std::uint32_t f)
	{
		for (std::uint32_t k = 0; k < 3; ++k) {
			const std::uint32_t h = a_.twin[3 * f + k];
			const std::uint32_t e = b_.twin[3 * faceTo_[f] + (k + turn_[f]) % 3];
			if ((h == kNone) != (e == kNone))
				return false;
			if (h != kNone && !put(h / 3, e / 3, (e % 3 + 3 - h % 3) % 3))
				return false;
		}
		return true;
	}

	void undo()
	{
		for (std::uint32_t f : faces_) {
			isTaken_[faceTo_[f]] = false;
			faceTo_[f]           = kNone;
		}
		for (std::uint32_t v : vertices_) {
			vertexFrom_[vertexTo_[v]] = kNone;
			vertexTo_[v]              = kNone;
		}
	}

	const Coloured& a_;
	const Coloured& b_;
	std::vector<std::uint32_t> faceTo_;
	std::vector<std::uint8_t> turn_;
	std::vector<bool> isTaken_;
	std::vector<std::uint32_t> vertexTo_, vertexFrom_;
	std::vector<std::uint32_t> faces_, vertices_; ///< touched by the current lay()
};

std::string describe(const LabelledMesh& m, std::uint32_t f)
{
	std::string s = "face " + std::to_string(f) + " with lattice points";
	for (std::uint32_t v : m.triangles[f]) {
		const auto& p = m.labels[v];
		s += " (" + std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " +
		     std::to_string(p[2]) + ")";
	}
	return s;
}

/// Rarest colours first: their faces have the fewest counterparts to try.
std::vector<std::uint32_t> facesByRarity(const Coloured& a, const Groups& groups)
{
	std::vector<std::uint32_t> order(a.face.size()), count(a.face.size());
	for (std::uint32_t f = 0; f < order.size(); ++f) {
		order[f] = f;
		count[f] = static_cast<std::uint32_t>(groups.at(a.face[f]).size());
	}
	std::sort(order.begin(), order.end(), [&](std::uint32_t x, std::uint32_t y) {
		return count[x] != count[y] ? count[x] < count[y] : x < y;
	});
	return order;
}

bool layComponent(Matcher& matcher, std::uint32_t f, std::vector<std::uint32_t>& candidates)
{
	for (std::size_t i = 0; i < candidates.size();) {
		if (matcher.isTaken(candidates[i])) { // and stays taken: forget it for good
			candidates[i] = candidates.back();
			candidates.pop_back();
			continue;
		}
		for (std::uint32_t turn = 0; turn < 3; ++turn)
			if (matcher.lay(f, candidates[i], turn))
				return true;
		++i;
	}
	return false;
}

} // namespace

std::string whatDiffers(const LabelledMesh& a, const LabelledMesh& b)
{
	if (a.labels.size() != b.labels.size())
		return std::to_string(b.labels.size()) + " vertices in place of " +
		       std::to_string(a.labels.size());
	if (a.triangles.size() != b.triangles.size())
		return std::to_string(b.triangles.size()) + " faces in place of " +
		       std::to_string(a.triangles.size());
	Coloured ca(a), cb(b);
	if (!ca.isManifold)
		return "the original is not an oriented manifold";
	if (!cb.isManifold)
		return "the decoded mesh is not an oriented manifold";
	if (!sameMultiset(ca.vertex, cb.vertex))
		return "the vertices are not on the same lattice points";
	// Further rounds tell faces apart that look alike; where all are unique already, few do.
	constexpr int kMostRounds = 24;
	std::size_t colours = 0, before = 0;
	Groups ga;
	for (int round = 0; round < kMostRounds; ++round) {
		ca.refine();
		cb.refine();
		if (round < 2)
			continue;
		ga      = groupByColour(ca.face);
		before  = colours;
		colours = ga.size();
		if (colours == before || colours == a.triangles.size())
			break;
	}
	if (!sameMultiset(ca.face, cb.face)) {
		const Groups gb = groupByColour(cb.face);
		for (std::uint32_t f = 0; f < ca.face.size(); ++f)
			if (gb.find(ca.face[f]) == gb.end())
				return "the connectivity is not the same: nothing is like " + describe(a, f) +
				       " and its surroundings";
		return "the connectivity is not the same";
	}
	Groups gb = groupByColour(cb.face);
	Matcher matcher(ca, cb);
	for (std::uint32_t f : facesByRarity(ca, ga))
		if (!matcher.isMapped(f) && !layComponent(matcher, f, gb[ca.face[f]]))
			return "the connectivity is not the same around " + describe(a, f);
	return {};
}

} // namespace wavemesh::tool
