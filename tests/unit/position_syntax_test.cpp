// SPDX-License-Identifier: GPL-3.0-or-later
// Positions in the compact mode: what is written is read, and what is cut stays where it was.
#include "entropy/range_coder.h"
#include "multires/vertex_walk.h"
#include "stage_meshes.h"
#include "syntax/position_syntax.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

namespace wavemesh::test {
namespace {

using Cells = std::vector<LatticePoint>;

Cells cellsOf(const Cells& positions, std::size_t count, int shift)
{
	Cells cells(positions.begin(), positions.begin() + static_cast<std::ptrdiff_t>(count));
	for (auto& p : cells)
		for (auto& x : p)
			x >>= shift;
	return cells;
}

/// A plan for a whole mesh: the base's shift, then after each split so many bits.
struct Plan
{
	int baseShift = 0;
	std::vector<int> bits; ///< by split; the last is repeated. What is left comes at the end.
};

/// Runs a plan with one set of models, as a file does. Writing, `cells` follow the truth.
/// @return how many of the vertices of each coding were whole
template <class Coder>
class PlanRunner
{
public:
	PlanRunner(
	    Coder& coder,
	    const Levels& levels,
	    int fullBits,
	    const Glue& glue,
	    PredictorSet set = PredictorSet::Repeats) :
	        coder_(coder),
	        levels_(levels), fullBits_(fullBits), glue_(glue), set_(set),
	        models_(std::make_unique<CompactModels>(set))
	{
	}

	void run(const Plan& plan)
	{
		shift_              = plan.baseShift;
		const auto& all     = levels_.replay.levels;
		const auto baseSize = all.empty() ? levels_.positions.size() : all[0].parent.vertexCount;
		cells               = cellsOf(levels_.positions, baseSize, shift_);
		for (std::size_t i = 0; i < all.size(); ++i) {
			split(i);
			const int bits = plan.bits.empty() ? 0 : plan.bits[std::min(i, plan.bits.size() - 1)];
			sharpen(i + 1, std::min(bits, shift_));
		}
		sharpen(all.size(), shift_);
	}

	Cells cells;
	bool isRight = true; ///< after each step the cells are those of the truth

private:
	const CornerTable& table(std::size_t i) const
	{
		const auto& all = levels_.replay.levels;
		return i < all.size() ? all[i].parent : levels_.replay.finest;
	}

	void split(std::size_t i)
	{
		const ReplayedLevel& level = levels_.replay.levels[i];
		const CornerTable& child   = table(i + 1);
		if constexpr (Coder::kReading)
			cells.resize(child.vertexCount, {0, 0, 0});
		else
			cells = cellsOf(levels_.positions, child.vertexCount, shift_);
		const Index whole = withPositionSyntax<Coder>(
		    set_,
		    [&](auto syntax) {
			    return syntax.codeChildren(
			        level.parent, level.refinement, parentsOf(level.parent, level.refinement),
			        shift_, cells);
		    },
		    coder_, *models_, child, fullBits_, glue_);
		compare(child, whole, child.vertexCount - level.parent.vertexCount);
	}

	void sharpen(std::size_t i, int bits)
	{
		if (bits == 0)
			return;
		shift_ -= bits;
		const Cells truth = cellsOf(levels_.positions, cells.size(), shift_);
		const Index whole = withPositionSyntax<Coder>(
		    set_,
		    [&](auto syntax) {
			    return syntax.codeBits(shift_, bits, cells, Coder::kReading ? Cells {} : truth);
		    },
		    coder_, *models_, table(i), fullBits_, glue_);
		compare(table(i), whole, table(i).vertexCount);
	}

	void compare(const CornerTable& table, Index whole, Index wanted)
	{
		isRight = isRight && whole == wanted &&
		          cells == cellsOf(levels_.positions, table.vertexCount, shift_);
	}

	Coder& coder_;
	const Levels& levels_;
	const int fullBits_;
	const Glue& glue_;
	const PredictorSet set_;
	std::unique_ptr<CompactModels> models_;
	int shift_ = 0;
};

const Glue kNoGlue;
constexpr PredictorSet kSets[] = {PredictorSet::Few, PredictorSet::All, PredictorSet::Repeats};

std::string whatIsNotRead(
    const Levels& levels,
    int bits,
    const Plan& plan,
    const Glue& glue,
    PredictorSet set = PredictorSet::Repeats)
{
	RangeEncoder encoder;
	PlanRunner<RangeEncoder> writer(encoder, levels, bits, glue, set);
	writer.run(plan);
	if (!writer.isRight)
		return "writing changed the cells";
	const auto stream = encoder.finish();
	RangeDecoder decoder(stream.data(), stream.size());
	PlanRunner<RangeDecoder> reader(decoder, levels, bits, glue, set);
	reader.run(plan);
	if (decoder.exhausted())
		return "the stream is too short";
	if (!reader.isRight)
		return "other cells were read";
	return reader.cells == levels.positions ? "" : "the finest cells are not the positions";
}

class EveryFamilysPositions : public testing::TestWithParam<NamedMesh>
{
};

TEST_P(EveryFamilysPositions, OfEveryPlanAreRead)
{
	const MeshData& mesh = GetParam().mesh;
	for (const int bits : {1, 2, 10, 16, 17, 24}) {
		if (mesh.positions.size() > 500 && bits != 10)
			continue;
		const Levels levels = makeLevels(mesh, {}, bits);
		const int most      = bits - 1;
		const Plan plans[]  = {
		     {0, {}},     // full precision from the start
		     {most, {}},  // everything at the end
		     {most, {1}}, // a bit after each split
		     {most, {2}},
		     {most, {0, 3, 0, 1}},
		     {most, {most}}, // everything after the first split
		     {std::min(most, 5), {1}}};
		for (std::size_t i = 0; i < std::size(plans); ++i) {
			const PredictorSet set = kSets[(i + std::size_t(bits)) % std::size(kSets)];
			ASSERT_EQ(whatIsNotRead(levels, bits, plans[i], {}, set), "")
			    << bits << " bits, plan " << i << ", set " << int(set);
		}
	}
}

INSTANTIATE_TEST_SUITE_P(
    PositionSyntax,
    EveryFamilysPositions,
    testing::ValuesIn(allFamilies()),
    [](const auto& family) { return family.param.name; });

/// Positions that no surface has: thrown at random, all equal, or at the lattice's corners.
TEST(PositionSyntax, OfAnyPositionsAreRead)
{
	Rng rng(901);
	for (int round = 0; round < 4; ++round)
		for (const int bits : {1, 3, 12, 24}) {
			Levels levels          = makeLevels(makeFlippedSphere(120, 2), {}, 12);
			const std::int32_t top = (1 << bits) - 1;
			for (auto& p : levels.positions)
				for (auto& x : p)
					switch (round) {
					case 0:
						x = static_cast<std::int32_t>(rng.below(std::uint32_t(top) + 1));
						break;
					case 1:
						x = rng.below(2) ? top : 0;
						break;
					default:
						x = round == 2 ? top : 0;
					}
			for (const Plan& plan : {Plan {0, {}}, Plan {bits - 1, {}}, Plan {bits - 1, {1}}})
				for (const PredictorSet set : kSets)
					ASSERT_EQ(whatIsNotRead(levels, bits, plan, {}, set), "")
					    << round << ' ' << bits << ' ' << int(set);
		}
}

TEST(PositionSyntax, OfASmoothSurfaceAreSmallerThanTheirBits)
{
	const Levels levels = makeLevels(makeIcosphere(16), {}, 12);
	RangeEncoder encoder;
	PlanRunner<RangeEncoder> writer(encoder, levels, 12, kNoGlue);
	writer.run({7, {1}});
	EXPECT_LT(8 * encoder.finish().size(), 12 * levels.positions.size());
}

/// One coding of one level, written whole and read from every prefix.
class Cut : public testing::TestWithParam<NamedMesh>
{
protected:
	/// The vertices in the order in which they are coded.
	static std::vector<Index> coded(const CornerTable& table, Index from)
	{
		std::vector<Index> order = vertexWalk(table);
		order.erase(
		    std::remove_if(order.begin(), order.end(), [&](Index v) { return v < from; }),
		    order.end());
		return order;
	}
	static std::size_t stride(std::size_t size) { return 1 + size / 60; }
};

TEST_P(Cut, ChildrenThatArrivedAreExactAndTheOthersBetweenTheirParents)
{
	const Levels levels = makeLevels(GetParam().mesh, {}, 12);
	if (levels.replay.levels.empty())
		return;
	const ReplayedLevel& last = levels.replay.levels.back();
	const CornerTable& child  = levels.replay.finest;
	const Parents parents     = parentsOf(last.parent, last.refinement);
	for (const int shift : {0, 4}) {
		const Cells truth = cellsOf(levels.positions, child.vertexCount, shift);
		RangeEncoder encoder;
		Cells cells = truth;
		CompactModels models(PredictorSet::Repeats);
		PositionSyntax<RangeEncoder, PredictorSet::Repeats>(encoder, models, child, 12, {})
		    .codeChildren(last.parent, last.refinement, parents, shift, cells);
		const auto stream = encoder.finish();
		const auto order  = coded(child, last.parent.vertexCount);
		Index before      = 0;
		for (std::size_t n = 0;; n = std::min(n + stride(stream.size()), stream.size())) {
			Cells read(truth.begin(), truth.begin() + last.parent.vertexCount);
			read.resize(child.vertexCount, {0, 0, 0});
			const std::vector<std::uint8_t> cut(
			    stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(n));
			RangeDecoder decoder(cut.data(), cut.size());
			CompactModels learnt(PredictorSet::Repeats);
			const Index whole =
			    PositionSyntax<RangeDecoder, PredictorSet::Repeats>(decoder, learnt, child, 12, {})
			        .codeChildren(last.parent, last.refinement, parents, shift, read);
			ASSERT_GE(whole, before);
			before = whole;
			for (Index i = 0; i < order.size(); ++i) {
				const Index v = order[i];
				const LatticePoint expected =
				    i < whole ? truth[v] : middle(read, parents[v - last.parent.vertexCount]);
				ASSERT_EQ(read[v], expected) << n << " bytes, vertex " << v;
			}
			if (n == stream.size())
				break;
		}
		EXPECT_EQ(before, order.size());
	}
}

TEST_P(Cut, BitsThatArrivedAreExactAndTheOthersInsideTheirOldCell)
{
	const StageMesh mesh = stageMesh(GetParam().mesh, 12);
	for (const int bits : {1, 2, 12}) {
		const Cells coarse = cellsOf(mesh.positions, mesh.positions.size(), bits);
		RangeEncoder encoder;
		Cells cells = coarse;
		CompactModels models(PredictorSet::Repeats);
		PositionSyntax<RangeEncoder, PredictorSet::Repeats>(encoder, models, mesh.table, 12, {})
		    .codeBits(0, bits, cells, mesh.positions);
		ASSERT_EQ(cells, mesh.positions);
		const auto stream = encoder.finish();
		const auto order  = coded(mesh.table, 0);
		Index before      = 0;
		for (std::size_t n = 0;; n = std::min(n + stride(stream.size()), stream.size())) {
			Cells read = coarse;
			const std::vector<std::uint8_t> cut(
			    stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(n));
			RangeDecoder decoder(cut.data(), cut.size());
			CompactModels learnt(PredictorSet::Repeats);
			const Index whole = PositionSyntax<RangeDecoder, PredictorSet::Repeats>(
			                        decoder, learnt, mesh.table, 12, {})
			                        .codeBits(0, bits, read, {});
			ASSERT_GE(whole, before);
			before = whole;
			for (Index i = 0; i < order.size(); ++i) {
				const Index v = order[i];
				if (i < whole) {
					ASSERT_EQ(read[v], mesh.positions[v]) << n << " bytes, vertex " << v;
				}
				for (std::size_t k = 0; k < 3; ++k)
					ASSERT_EQ(read[v][k] >> bits, coarse[v][k]) << n << " bytes, vertex " << v;
			}
			if (n == stream.size())
				break;
		}
		EXPECT_EQ(before, order.size());
	}
}

INSTANTIATE_TEST_SUITE_P(
    PositionSyntax, Cut, testing::ValuesIn(smallFamilies()), [](const auto& family) {
	    return family.param.name;
    });

/// Two triangles that are the same vertices of the original, and some copies more.
struct Glued
{
	StageMesh mesh;
	Glue glue;
};

Glued gluedMesh()
{
	Glued out;
	out.mesh = stageMesh(joined({makeIcosphere(2), makeIcosphere(2)}), 12);
	std::vector<Index> group(out.mesh.table.vertexCount, kNone);
	const Index half = out.mesh.table.vertexCount / 2;
	for (Index v = 0; v < half; v += 3)
		group[v] = group[half + v] = v;
	out.glue = glueOf(group);
	return out;
}

TEST(PositionSyntax, OfCopiesAreCodedOnceAndStayTogetherEvenWhenCut)
{
	const auto [mesh, glue] = gluedMesh();
	const Cells coarse      = cellsOf(mesh.positions, mesh.positions.size(), 5);
	const auto coded        = [&, &mesh = mesh](const Glue& g) {
        RangeEncoder encoder;
        Cells cells = coarse;
        CompactModels models(PredictorSet::Repeats);
        PositionSyntax<RangeEncoder, PredictorSet::Repeats>(encoder, models, mesh.table, 12, g)
            .codeBits(0, 5, cells, mesh.positions);
        EXPECT_EQ(cells, mesh.positions);
        return encoder.finish();
	};
	const auto stream = coded(glue);
	EXPECT_LT(stream.size(), coded({}).size());
	for (std::size_t n = 0; n <= stream.size(); ++n) {
		const std::vector<std::uint8_t> cut(
		    stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(n));
		RangeDecoder decoder(cut.data(), cut.size());
		CompactModels models(PredictorSet::Repeats);
		Cells read        = coarse;
		const Index whole = PositionSyntax<RangeDecoder, PredictorSet::Repeats>(
		                        decoder, models, mesh.table, 12, glue)
		                        .codeBits(0, 5, read, {});
		for (Index v = 0; v < mesh.table.vertexCount; ++v) {
			if (glue.isCopy(v)) {
				ASSERT_EQ(read[v], read[glue.first[v]]) << n;
			}
			for (std::size_t k = 0; k < 3; ++k)
				ASSERT_EQ(read[v][k] >> 5, coarse[v][k]);
		}
		if (n == stream.size()) {
			EXPECT_EQ(whole, mesh.table.vertexCount);
			EXPECT_EQ(read, mesh.positions);
		}
	}
}

TEST(PositionSyntax, FromGarbageStaysOnTheLattice)
{
	Rng rng(902);
	const Levels levels = makeLevels(makeFlippedSphere(60, 2), {}, 12);
	ASSERT_FALSE(levels.replay.levels.empty());
	for (int round = 0; round < 100; ++round) {
		std::vector<std::uint8_t> garbage(4000);
		for (auto& b : garbage)
			b = static_cast<std::uint8_t>(rng.next());
		const int bits = 1 + static_cast<int>(rng.below(24));
		const Levels other {
		    levels.replay,
		    cellsOf(levels.positions, levels.positions.size(), std::max(0, 12 - bits))};
		RangeDecoder decoder(garbage.data(), garbage.size());
		PlanRunner<RangeDecoder> reader(decoder, other, bits, kNoGlue);
		reader.run({static_cast<int>(rng.below(std::uint32_t(bits))), {1}});
		for (const auto& p : reader.cells)
			for (const std::int32_t x : p) {
				ASSERT_GE(x, 0);
				ASSERT_LT(x, 1 << bits);
			}
	}
}

} // namespace
} // namespace wavemesh::test
