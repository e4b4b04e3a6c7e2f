// SPDX-License-Identifier: GPL-3.0-or-later
// Base mesh, connectivity and details: what is written is read, what is cut is noticed.
#include "mesh_check.h"
#include "multires/refine.h"
#include "stage_meshes.h"
#include "syntax/base_syntax.h"
#include "syntax/connectivity_syntax.h"
#include "syntax/detail_syntax.h"

#include <gtest/gtest.h>

#include <limits>

namespace wavemesh::test {
namespace {

TEST(BaseSyntax, OfEveryFamily_ComesBackInTheCodedOrder)
{
	for (const NamedMesh& m : allFamilies())
		for (int bits : {1, 10, 24}) {
			const StageMesh stage = stageMesh(m.mesh, bits);
			RangeEncoder encoder;
			std::vector<Index> source;
			const BaseMesh written = BaseSyntax<RangeEncoder>(encoder, bits)
			                             .write({stage.table, stage.positions}, source);
			const auto stream = encoder.finish();
			RangeDecoder decoder(stream.data(), stream.size());
			const auto read = BaseSyntax<RangeDecoder>(decoder, bits)
			                      .read(stage.table.vertexCount, stage.table.faceCount());
			ASSERT_TRUE(read.ok()) << m.name << ": " << read.status().what;
			ASSERT_EQ(read->table.vertex, written.table.vertex) << m.name;
			ASSERT_EQ(read->table.opposite, written.table.opposite) << m.name;
			ASSERT_EQ(read->positions, written.positions) << m.name;
			// `source` is a renumbering that makes it the mesh given.
			ASSERT_EQ(source.size(), stage.table.vertexCount);
			auto faces = facesOf(read->table);
			for (auto& t : faces)
				for (auto& v : t)
					v = source[v];
			ASSERT_EQ(sortedFaces(std::move(faces)), sortedFaces(m.mesh.triangles)) << m.name;
			for (Index v = 0; v < source.size(); ++v)
				ASSERT_EQ(read->positions[v], stage.positions[source[v]]) << m.name;
		}
}

TEST(BaseSyntax, EveryPrefix_IsTruncated)
{
	const StageMesh stage = stageMesh(makeFlippedSphere(60, 1), 10);
	RangeEncoder encoder;
	std::vector<Index> source;
	(void)BaseSyntax<RangeEncoder>(encoder, 10).write({stage.table, stage.positions}, source);
	const auto stream = encoder.finish();
	for (std::size_t n = 0; n < stream.size(); ++n) {
		const std::vector<std::uint8_t> cut(
		    stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(n));
		RangeDecoder decoder(cut.data(), cut.size());
		const auto read = BaseSyntax<RangeDecoder>(decoder, 10)
		                      .read(stage.table.vertexCount, stage.table.faceCount());
		ASSERT_EQ(read.status().code, StatusCode::Truncated) << n;
	}
}

TEST(BaseSyntax, RandomBytes_AreRefusedOrAManifold)
{
	Rng rng(101);
	int accepted = 0;
	for (int round = 0; round < 3000; ++round) {
		std::vector<std::uint8_t> noise(40);
		for (auto& b : noise)
			b = static_cast<std::uint8_t>(rng.next());
		RangeDecoder decoder(noise.data(), noise.size());
		const Index vertices = 3 + rng.below(5);
		const auto read =
		    BaseSyntax<RangeDecoder>(decoder, 12).read(vertices, 1 + rng.below(2 * vertices));
		if (!read.ok()) {
			ASSERT_TRUE(
			    read.status().code == StatusCode::Corrupt ||
			    read.status().code == StatusCode::Truncated);
			continue;
		}
		++accepted;
		std::string wrong = whatIsNotManifold(meshOf(read->table, {}));
		if (wrong == "two faces have the same three vertices")
			wrong.clear(); // a closed surface of two faces, and a manifold still
		ASSERT_EQ(wrong, "");
		ASSERT_EQ(whatIsNotLinked(read->table), "");
	}
	EXPECT_GT(accepted, 0);
}

std::vector<LatticePoint> latticeNoise(Index count, Rng& rng)
{
	std::vector<LatticePoint> out(count);
	for (LatticePoint& p : out)
		for (std::int32_t& x : p)
			x = static_cast<std::int32_t>(rng.below(1 << 12));
	return out;
}

TEST(ConnectivitySyntax, AnyRefinement_ComesBack)
{
	Rng rng(102);
	int number = 0;
	for (const NamedMesh& m : smallFamilies(200)) {
		const StageMesh parent  = stageMesh(m.mesh);
		const Contexts contexts = ++number % 2 == 0 ? Contexts::Fast : Contexts::Rich;
		ConnectivityModels writeModels(contexts), readModels(contexts);
		RangeEncoder encoder;
		std::vector<Refinement> all;
		for (int i = 0; i < 5; ++i) {
			all.push_back(randomRefinement(parent.table, rng));
			ConnectivitySyntax<RangeEncoder>(encoder, writeModels, parent.table, parent.positions)
			    .code(all.back());
		}
		const auto stream = encoder.finish();
		RangeDecoder decoder(stream.data(), stream.size());
		for (const Refinement& r : all) {
			Refinement read;
			ConnectivitySyntax<RangeDecoder>(decoder, readModels, parent.table, parent.positions)
			    .code(read);
			ASSERT_FALSE(decoder.exhausted()) << m.name;
			ASSERT_EQ(read.parentVertices, r.parentVertices);
			ASSERT_EQ(read.childVertices, r.childVertices) << m.name;
			ASSERT_EQ(read.childOnEdge, r.childOnEdge) << m.name;
			ASSERT_EQ(read.faceCode, r.faceCode) << m.name;
			ASSERT_EQ(read.hasCentres, r.hasCentres);
		}
	}
}

TEST(ConnectivitySyntax, OfRandomBytes_IsARefinementThatRefineCanDo)
{
	Rng rng(103);
	for (const NamedMesh& m : smallFamilies(100)) {
		const StageMesh parent = stageMesh(m.mesh);
		for (int round = 0; round < 10; ++round) {
			std::vector<std::uint8_t> noise(600);
			for (auto& b : noise)
				b = static_cast<std::uint8_t>(rng.next());
			RangeDecoder decoder(noise.data(), noise.size());
			ConnectivityModels models(round % 2 == 0 ? Contexts::Fast : Contexts::Rich);
			Refinement r;
			ConnectivitySyntax<RangeDecoder>(decoder, models, parent.table, parent.positions)
			    .code(r);
			if (decoder.exhausted())
				continue;
			const CornerTable fine = refine(parent.table, r);
			ASSERT_EQ(fine.vertexCount, r.childVertices);
			ASSERT_EQ(whatIsNotLinked(fine), "") << m.name;
		}
	}
}

TEST(DetailSyntax, AnyDetails_ComeBack)
{
	Rng rng(104);
	for (const NamedMesh& m : smallFamilies(200)) {
		const StageMesh parent = stageMesh(m.mesh);
		const Refinement r     = randomRefinement(parent.table, rng);
		std::vector<LatticePoint> details(r.childVertices - r.parentVertices);
		for (LatticePoint& d : details)
			for (std::int32_t& x : d) {
				// Up to the longest magnitude there is, 31 bits.
				x = static_cast<std::int32_t>(
				    (rng.next() >> 33) >> (rng.below(4) ? rng.below(31) : 0));
				if (rng.below(2))
					x = -x;
				if (rng.below(50) == 0)
					x = std::numeric_limits<std::int32_t>::max();
			}
		DetailModels writeModels, readModels;
		RangeEncoder encoder;
		auto copy = details;
		EXPECT_EQ(
		    DetailSyntax<RangeEncoder>(encoder, writeModels, parent.table, r, parent.positions)
		        .code(copy),
		    details.size());
		const auto stream = encoder.finish();
		RangeDecoder decoder(stream.data(), stream.size());
		std::vector<LatticePoint> read(details.size(), LatticePoint {0, 0, 0});
		ASSERT_EQ(
		    DetailSyntax<RangeDecoder>(decoder, readModels, parent.table, r, parent.positions)
		        .code(read),
		    details.size());
		ASSERT_FALSE(decoder.exhausted());
		ASSERT_EQ(read, details) << m.name;
		ASSERT_EQ(readModels.magnitude, writeModels.magnitude);
	}
}

TEST(DetailSyntax, OfEveryPrefix_GivesWholeDetailsAndZeros)
{
	Rng rng(105);
	const StageMesh parent = stageMesh(makeFlippedSphere(40, 5));
	const Refinement r     = randomRefinement(parent.table, rng);
	auto details           = latticeNoise(r.childVertices - r.parentVertices, rng);
	DetailModels models;
	RangeEncoder encoder;
	DetailSyntax<RangeEncoder>(encoder, models, parent.table, r, parent.positions).code(details);
	const auto stream   = encoder.finish();
	std::size_t longest = 0;
	for (std::size_t n = 0; n <= stream.size(); ++n) {
		const std::vector<std::uint8_t> cut(
		    stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(n));
		RangeDecoder decoder(cut.data(), cut.size());
		DetailModels fresh;
		std::vector<LatticePoint> read(details.size(), LatticePoint {0, 0, 0});
		const std::size_t whole =
		    DetailSyntax<RangeDecoder>(decoder, fresh, parent.table, r, parent.positions)
		        .code(read);
		ASSERT_EQ(decoder.exhausted(), n < stream.size());
		ASSERT_GE(whole, longest);
		longest = whole;
		for (std::size_t i = 0; i < details.size(); ++i)
			ASSERT_EQ(read[i], i < whole ? details[i] : (LatticePoint {0, 0, 0})) << n;
	}
	EXPECT_EQ(longest, details.size());
}

} // namespace
} // namespace wavemesh::test
