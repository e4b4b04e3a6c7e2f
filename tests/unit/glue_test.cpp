// SPDX-License-Identifier: GPL-3.0-or-later
// Copies of vertices in the base mesh, of any number.
#include "container/container.h"
#include "rng.h"
#include "syntax/base_syntax.h"
#include "wmc_files.h"

#include <gtest/gtest.h>

#include <chrono>

namespace wavemesh::test {
namespace {

/// Triangles that share nothing but the vertices of the original.
BaseMesh loose(const std::vector<std::array<Index, 3>>& originals, std::vector<Index>& group)
{
	std::vector<std::array<Index, 3>> triangles;
	group.clear();
	for (const auto& t : originals) {
		const Index v = Index(group.size());
		triangles.push_back({v, v + 1, v + 2});
		group.insert(group.end(), t.begin(), t.end());
	}
	BaseMesh base;
	base.table = std::move(buildCornerTable(triangles, Index(group.size())).value());
	for (const Index original : group)
		base.positions.push_back({std::int32_t(original), 0, 0});
	return base;
}

struct Written
{
	Bytes stream;
	BaseMesh mesh;
};

Written written(const BaseMesh& base, const std::vector<Index>& group)
{
	RangeEncoder encoder;
	std::vector<Index> source;
	BaseMesh mesh = BaseSyntax<RangeEncoder>(encoder, 12, true).write(base, source, &group);
	return {encoder.finish(), std::move(mesh)};
}

Result<BaseMesh> read(const Written& base)
{
	RangeDecoder decoder(base.stream.data(), base.stream.size());
	return BaseSyntax<RangeDecoder>(decoder, 12, true)
	    .read(base.mesh.table.vertexCount, base.mesh.table.faceCount());
}

TEST(Glue, AHundredThousandCopiesWithTheSameNeighbours_TakeNoMoreThanOthers)
{
	std::vector<Index> group;
	const std::vector<std::array<Index, 3>> same(100'000, {0, 1, 2});
	const auto begin   = std::chrono::steady_clock::now();
	const Written base = written(loose(same, group), group);
	const auto back    = read(base);
	ASSERT_TRUE(back.ok());
	EXPECT_EQ(back->table.vertex, base.mesh.table.vertex);
	EXPECT_EQ(back->glue.first, base.mesh.glue.first);
	// Well below a second, on any machine; looking at every copy of every vertex takes minutes.
	EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

/// The candidates as the format's document lists them.
struct ListedCandidates
{
	std::vector<Index> first;
	std::vector<std::vector<Index>> around;

	void append(Index v, std::vector<Index>& list) const
	{
		for (Index w = 0; w < first.size(); ++w)
			if (w != v && first[w] == first[v])
				for (std::size_t i = 0; i < std::min<std::size_t>(around[w].size(), 24); ++i) {
					const Index u = first[around[w][i]];
					if (list.size() < 32 && std::find(list.begin(), list.end(), u) == list.end())
						list.push_back(u);
				}
	}
};

TEST(Glue, CandidatesAreTheOnesThatTheDocumentLists)
{
	Rng rng(7);
	for (int round = 0; round < 60; ++round) {
		Glue glue;
		GlueNeighbours neighbours(glue);
		ListedCandidates listed;
		const Index originals = 1 + rng.below(round % 3 == 0 ? 200 : 4);
		std::vector<Index> firstOf(originals, kNone);
		for (int step = 0; step < 1500; ++step) {
			if (glue.first.size() < 2 || rng.below(8) == 0) {
				const Index v = Index(glue.first.size());
				Index& first  = firstOf[rng.below(originals)];
				if (first == kNone)
					first = v;
				glue.first.push_back(first);
				glue.shared.push_back(first != v);
				if (first != v)
					glue.shared[first] = 1;
				neighbours.addVertex();
				listed.first.push_back(first);
				listed.around.emplace_back();
				continue;
			}
			const Index count = Index(glue.first.size());
			const Index v = rng.below(count), to = rng.below(count);
			neighbours.add(v, to);
			listed.around[v].push_back(to);
			std::vector<Index> found, expected;
			for (const Index at : {rng.below(count), rng.below(count)}) {
				neighbours.append(at, found);
				listed.append(at, expected);
			}
			ASSERT_EQ(found, expected) << round << " " << step;
		}
	}
}

TEST(Glue, OfAnyOriginals_ComesBack)
{
	Rng rng(8);
	for (const Index originals : {3u, 5u, 40u, 2000u}) {
		std::vector<std::array<Index, 3>> faces;
		for (int f = 0; f < 700; ++f) {
			const Index a = rng.below(originals - 2), b = a + 1 + rng.below(originals - 2 - a);
			faces.push_back({a, b, originals - 1});
		}
		std::vector<Index> group;
		const Written base = written(loose(faces, group), group);
		const auto back    = read(base);
		ASSERT_TRUE(back.ok()) << back.status().what;
		EXPECT_EQ(back->glue.first, base.mesh.glue.first);
		EXPECT_EQ(back->glue.shared, base.mesh.glue.shared);
		EXPECT_EQ(back->positions, base.mesh.positions);
	}
}

} // namespace
} // namespace wavemesh::test
