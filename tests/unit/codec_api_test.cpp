// SPDX-License-Identifier: GPL-3.0-or-later
// What the public interface promises besides the mesh: refusals, progress, limits.
#include "allocation_watch.h"
#include "codec_check.h"
#include "container/container.h"
#include "mesh_families.h"
#include "wmc_files.h"

#include <wavemesh/detail_pyramid.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wavemesh::test {
namespace {

StatusCode codeOf(const MeshData& mesh, const EncodeOptions& o = {})
{
	const auto file = encode(mesh, o);
	if (!file.ok()) {
		EXPECT_FALSE(file.hasValue());
		EXPECT_FALSE(file.status().what.empty());
	}
	return file.status().code;
}

/// Before whatever the codec's own files initialise, if they come later in the program.
const Result<EncodedMesh> kBeforeMain = encode(makeTorus(12, 9));

TEST(Encode, GivesTheSameFileBeforeMain)
{
	ASSERT_TRUE(kBeforeMain.ok());
	EXPECT_EQ(kBeforeMain->bytes, encode(makeTorus(12, 9))->bytes);
	EXPECT_TRUE(decode(kBeforeMain->bytes.data(), kBeforeMain->bytes.size()).ok());
}

TEST(Encode, RefusesOptionsOutOfRange)
{
	const MeshData mesh = makeTetrahedron();
	const auto with     = [&](auto set) {
        EncodeOptions o;
        set(o);
        return codeOf(mesh, o);
	};
	constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
	for (const int bits : {0, -3, 25, 64})
		EXPECT_EQ(with([&](auto& o) { o.bits = bits; }), StatusCode::InvalidArgument) << bits;
	for (const int lifting : {-2, 3})
		EXPECT_EQ(with([&](auto& o) { o.lifting = lifting; }), StatusCode::InvalidArgument);
	for (const double step : {-1.0, kNaN, 1e-12})
		EXPECT_EQ(with([&](auto& o) { o.step = step; }), StatusCode::InvalidArgument) << step;
	for (const double x : {-0.1, 1.1, kNaN})
		EXPECT_EQ(with([&](auto& o) { o.wgcSharpness = x; }), StatusCode::InvalidArgument) << x;
	for (const double x : {0.0, -1.0, kNaN})
		EXPECT_EQ(with([&](auto& o) { o.wgcDeviation = x; }), StatusCode::InvalidArgument) << x;
	EXPECT_EQ(with([](auto& o) { o.mode = static_cast<Mode>(7); }), StatusCode::InvalidArgument);
	EXPECT_EQ(with([](auto& o) { o.wgc = static_cast<Wgc>(3); }), StatusCode::InvalidArgument);
	EXPECT_EQ(with([](auto&) {}), StatusCode::Ok);
}

TEST(Encode, RefusesWhatIsNoMeshAndNamesIt)
{
	MeshData m        = makeTetrahedron();
	m.triangles[2][1] = 99;
	EXPECT_EQ(codeOf(m), StatusCode::InvalidArgument);
	m                 = makeTetrahedron();
	m.positions[3][2] = std::numeric_limits<double>::infinity();
	EXPECT_EQ(codeOf(m), StatusCode::InvalidArgument);
	EXPECT_NE(encode(m).status().what.find("vertex 3"), std::string::npos);
}

TEST(Encode, NeverModifiesItsInput)
{
	const MeshData mesh = makeFlippedSphere(100, 121), copy = mesh;
	ASSERT_TRUE(encode(mesh).ok());
	EXPECT_EQ(mesh.positions, copy.positions);
	EXPECT_EQ(mesh.triangles, copy.triangles);
}

TEST(Encode, WgcAuto_ForSize_IsAsSmallAsTheSmallerOfBothInClassicFilesAndAtEffort3)
{
	for (const MeshData& mesh :
	     {makeStarPrism(16, 20), makeBumpySphere(400, 122), makeHoledPlate(2, 4)})
		for (const Mode mode : {Mode::Classic, Mode::Compact}) {
			EncodeOptions o;
			o.mode          = mode;
			o.effort        = mode == Mode::Classic ? 2 : 3;
			o.optimize      = Optimize::Size;
			const auto size = [&](Wgc wgc) {
				o.wgc = wgc;
				return encode(mesh, o)->bytes.size();
			};
			const std::size_t off = size(Wgc::Off), on = size(Wgc::On);
			EXPECT_LE(size(Wgc::Auto), std::min(off, on));
		}
}

TEST(Encode, WgcAuto_IsOffForLevels)
{
	const MeshData mesh = makeStarPrism(16, 20);
	const auto bytes    = [&](int effort, Wgc wgc) {
        EncodeOptions o;
        o.effort   = effort;
        o.optimize = Optimize::Levels;
        o.wgc      = wgc;
        return encode(mesh, o)->bytes;
	};
	for (const int effort : {1, 2, 3})
		EXPECT_EQ(bytes(effort, Wgc::Auto), bytes(effort, Wgc::Off));
}

TEST(Encode, OfASmallMesh_ForSize_IsTheSmallestAndBalancedWithin3Percent)
{
	for (const MeshData& mesh :
	     {makeStarPrism(16, 20), makeBumpySphere(500, 122), makeHoledPlate(2, 4), makeCube(),
	      makeTerrain(300, 3), makeFlatGrid(9, 12)})
		for (const Mode mode : {Mode::Classic, Mode::Compact})
			for (const int effort : {1, 2, 3}) {
				EncodeOptions o;
				o.mode             = mode;
				o.effort           = effort;
				const auto sizeFor = [&](Optimize optimize) {
					o.optimize = optimize;
					return double(encode(mesh, o)->bytes.size());
				};
				const double size = sizeFor(Optimize::Size), balanced = sizeFor(Optimize::Balanced);
				EXPECT_LE(size, balanced) << effort;
				EXPECT_LE(size, sizeFor(Optimize::Levels)) << effort;
				EXPECT_LE(balanced, 1.03 * size) << effort;
			}
}

TEST(Encode, OfAMeshOfMiddleSize_Balanced_IsWithin3PercentOfSize)
{
	for (const MeshData& mesh : {makeBumpySphere(5000, 7), makeHoledPlate(3, 13)}) {
		ASSERT_GE(mesh.positions.size(), 4096u);
		EncodeOptions o;
		const auto balanced = encode(mesh, o)->bytes.size();
		o.optimize          = Optimize::Size;
		EXPECT_LE(double(balanced), 1.03 * double(encode(mesh, o)->bytes.size()));
	}
}

TEST(Encode, SameInput_GivesTheSameBytes)
{
	const MeshData mesh = makeTerrain(600, 123);
	EXPECT_EQ(encode(mesh)->bytes, encode(mesh)->bytes);
}

// ---- progress ----

TEST(Progress, OfEncode_IsMonotoneFrom0To1)
{
	const MeshData mesh = makeBumpySphere(1500, 124);
	for (const Mode mode : {Mode::Classic, Mode::Compact})
		for (const int effort : {1, 2, 3})
			for (const Wgc wgc : {Wgc::Off, Wgc::Auto}) {
				EncodeOptions o;
				o.mode        = mode;
				o.effort      = effort;
				o.wgc         = wgc;
				o.keepOrder   = wgc == Wgc::Off;
				double before = 0;
				int calls     = 0;
				o.progress    = [&](double fraction) {
                    EXPECT_GE(fraction, before - 1e-12);
                    before = fraction;
                    ++calls;
                    return true;
				};
				ASSERT_TRUE(encode(mesh, o).ok());
				EXPECT_GE(calls, 5);
				EXPECT_NEAR(before, 1, 1e-12);
			}
}

TEST(Progress, MovesWithinALargeLevel)
{
	const MeshData mesh = makeBumpySphere(20000, 127);
	double before = 0, largest = 0;
	const auto progress = [&](double fraction) {
		largest = std::max(largest, fraction - before);
		before  = fraction;
		return true;
	};
	EncodeOptions o;
	o.effort        = 3;
	o.progress      = progress;
	const auto file = encode(mesh, o);
	EXPECT_LT(largest, 0.1);

	// The last split is about half of the work, a third of that its connectivity, in one piece.
	before = largest = 0;
	DecodeOptions d;
	d.progress = progress;
	ASSERT_TRUE(decode(file->bytes.data(), file->bytes.size(), d).ok());
	EXPECT_LT(largest, 0.2);
}

TEST(Progress, MovesThroughWhatFollowsTheLevels)
{
	MeshData mesh = makeBumpySphere(20000, 131);
	Attribute normal;
	normal.of         = AttributeOf::Vertex;
	normal.kind       = AttributeKind::Normal;
	normal.components = 3;
	normal.bits       = 12;
	for (const auto& p : mesh.positions) {
		const double length = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
		for (const double x : p)
			normal.values.push_back(double(float(x / length)));
	}
	mesh.attributes = {normal};
	for (const bool exact : {false, true}) {
		EncodeOptions o;
		o.keepOrder   = true;
		o.exact       = exact;
		double before = 0, largest = 0;
		std::vector<double> steps;
		const auto progress = [&](double fraction) {
			largest = std::max(largest, fraction - before);
			before  = fraction;
			if (steps.empty() || fraction > steps.back())
				steps.push_back(fraction);
			return true;
		};
		o.progress      = progress;
		const auto file = encode(mesh, o);
		ASSERT_TRUE(file.ok());
		EXPECT_LT(largest, 0.15);

		steps.clear();
		before = largest = 0;
		DecodeOptions d;
		d.progress = progress;
		ASSERT_TRUE(decode(file->bytes.data(), file->bytes.size(), d).ok());
		EXPECT_LT(largest, 0.15);
		const double levels = decodingShares(file->info, file->info.finestLevel()).back();
		ASSERT_LT(levels, 0.9);
		const auto behind = std::lower_bound(steps.begin(), steps.end(), levels);
		EXPECT_GE(steps.end() - behind, 20) << "steps behind the levels";

		int calls       = 0;
		const auto last = std::size_t(behind - steps.begin()) + 10;
		d.progress      = [&](double fraction) { return ++calls, fraction < steps[last]; };
		const auto back = decode(file->bytes.data(), file->bytes.size(), d);
		EXPECT_EQ(back.status().code, StatusCode::Cancelled);
	}
}

TEST(Progress, OfLevels_IsByTheirWork)
{
	EncodeOptions o;
	for (const bool keepOrder : {false, true}) {
		o.keepOrder           = keepOrder;
		const auto file       = encode(makeBumpySphere(20000, 129), o);
		const StreamInfo info = file->info;
		const int finest      = info.finestLevel();
		const auto shares     = decodingShares(info, finest);
		ASSERT_EQ(shares.size(), info.levels.size());
		for (std::size_t l = 1; l < shares.size(); ++l)
			EXPECT_GT(shares[l], shares[l - 1]);
		if (keepOrder)
			EXPECT_LT(shares.back(), 0.9);
		else
			EXPECT_EQ(shares.back(), 1);
		EXPECT_LT(shares[std::size_t(finest / 2)], 0.05) << "these are small levels";
		const auto below = decodingShares(info, finest - 1);
		EXPECT_EQ(below.size(), shares.size() - 1);
		EXPECT_EQ(below.back(), 1);
	}
}

TEST(Progress, OfALevelCancels_AndTheDecoderHasNoMeshAnyMore)
{
	const auto file = encode(makeBumpySphere(5000, 128));
	auto decoder    = Decoder::open(file->bytes.data(), file->bytes.size());
	while (decoder->info().levels[std::size_t(decoder->level() + 1)].vertices < 2000)
		ASSERT_TRUE(decoder->advance().ok());
	const int level = decoder->level();
	EXPECT_EQ(decoder->advance([](double) { return false; }).code, StatusCode::Cancelled);
	EXPECT_EQ(decoder->level(), level);
	EXPECT_EQ(decoder->advance().code, StatusCode::Cancelled);
	EXPECT_TRUE(decoder->mesh().positions.empty());
}

TEST(Progress, CancelsEveryLevel_AndNoMeshIsLeft)
{
	const MeshData mesh = makeBumpySphere(900, 128);
	for (const Mode mode : {Mode::Compact, Mode::Classic}) {
		EncodeOptions o;
		o.mode          = mode;
		const auto file = encode(mesh, o);
		for (int level = 0; level <= file->info.finestLevel(); ++level) {
			auto decoder = Decoder::open(file->bytes.data(), file->bytes.size());
			while (decoder->level() + 1 < level)
				ASSERT_TRUE(decoder->advance().ok());
			const Status s = decoder->advance([](double) { return false; });
			EXPECT_EQ(s.code, StatusCode::Cancelled) << level;
			EXPECT_TRUE(decoder->mesh().positions.empty()) << level;
		}
	}
}

TEST(Progress, CancelsALargeBaseMeshAndItsAttributesAtAnyCall)
{
	MeshData mesh; // of triangles that cannot be coarsened
	for (std::uint32_t v = 0; v < 3 * 5000; ++v)
		mesh.positions.push_back({double(v % 101), double(v % 103), double(v % 107)});
	for (std::uint32_t f = 0; f < 5000; ++f)
		mesh.triangles.push_back({3 * f, 3 * f + 1, 3 * f + 2});
	Attribute colour;
	colour.values.assign(mesh.positions.size(), 1);
	for (std::size_t v = 0; v < colour.values.size(); ++v)
		colour.values[v] = double(v % 109);
	mesh.attributes = {colour, colour};
	const auto file = encode(mesh);
	ASSERT_TRUE(file.ok());
	ASSERT_EQ(file->info.levels[0].vertices, mesh.positions.size());
	std::vector<double> asked;
	auto whole = Decoder::open(file->bytes.data(), file->bytes.size());
	ASSERT_TRUE(whole->advance([&](double x) { return asked.push_back(x), true; }).ok());
	ASSERT_GE(asked.size(), 7u);
	EXPECT_TRUE(std::is_sorted(asked.begin(), asked.end()));
	EXPECT_LT(asked[4], 0.9) << "there are attributes, too";
	for (std::size_t call = 0; call < asked.size(); ++call) {
		auto decoder      = Decoder::open(file->bytes.data(), file->bytes.size());
		std::size_t calls = 0;
		EXPECT_EQ(
		    decoder->advance([&](double) { return calls++ < call; }).code, StatusCode::Cancelled);
		EXPECT_EQ(calls, call + 1);
		EXPECT_TRUE(decoder->mesh().positions.empty());
	}
}

TEST(Progress, CancelsEncodeAtEveryCall)
{
	const MeshData mesh = makeBumpySphere(60, 125);
	const auto whole    = encode(mesh)->bytes;
	for (int limit = 0;; ++limit) {
		ASSERT_LT(limit, 1000);
		EncodeOptions o;
		int calls       = 0;
		o.progress      = [&](double) { return calls++ < limit; };
		const auto file = encode(mesh, o);
		if (file.ok()) {
			EXPECT_EQ(file->bytes, whole);
			EXPECT_GT(limit, 5);
			break;
		}
		ASSERT_EQ(file.status().code, StatusCode::Cancelled);
		ASSERT_FALSE(file.hasValue());
		ASSERT_EQ(calls, limit + 1) << "asked again after it was told to stop";
	}
}

TEST(Progress, OfDecode_IsMonotoneAndCancels)
{
	const auto file = encode(makeBumpySphere(400, 126));
	for (int limit = 0;; ++limit) {
		ASSERT_LT(limit, 1000);
		DecodeOptions o;
		int calls     = 0;
		double before = 0;
		o.progress    = [&](double fraction) {
            EXPECT_GE(fraction, before);
            EXPECT_LE(fraction, 1);
            before = fraction;
            return calls++ < limit;
		};
		const auto back = decode(file->bytes.data(), file->bytes.size(), o);
		if (back.ok()) {
			EXPECT_GE(limit, static_cast<int>(file->info.levels.size()) - 1);
			EXPECT_EQ(before, 1);
			break;
		}
		ASSERT_EQ(back.status().code, StatusCode::Cancelled);
		ASSERT_FALSE(back.hasValue());
	}
}

// ---- memory ----

/// Has each allocation fail in turn. @return how many there were until `work` was ok
template <class Work>
std::size_t failEachAllocation(const Work& work)
{
	for (std::size_t n = 0;; ++n) {
		AllocationFailure failure(n);
		const StatusCode code = work();
		failure.end();
		if (code == StatusCode::Ok)
			return n;
		EXPECT_EQ(code, StatusCode::OutOfMemory) << n;
		if (n == 100'000)
			return 0;
	}
}

TEST(Memory, ThatRunsOutAnywhereIsAStatus)
{
	const MeshData mesh = makeTorus(7, 5);
	EncodeOptions o;
	o.effort        = 1;
	const auto file = encode(mesh, o);
	const auto& b   = file->bytes;
	EXPECT_GT(failEachAllocation([&] { return readInfo(b.data(), b.size()).status().code; }), 2u);
	EXPECT_GT(
	    failEachAllocation([&] { return Decoder::open(b.data(), b.size()).status().code; }), 3u);
	const auto byLevels = [&] {
		auto decoder = Decoder::open(b.data(), b.size());
		Status s     = decoder.status();
		while (s.ok() && decoder->level() < decoder->info().finestLevel())
			s = decoder->advance([](double) { return true; });
		return s.code;
	};
	EXPECT_GT(failEachAllocation(byLevels), 50u);
	EXPECT_GT(failEachAllocation([&] { return decode(b.data(), b.size()).status().code; }), 50u);
	EXPECT_GT(failEachAllocation([&] { return encode(mesh, o).status().code; }), 50u);
	EXPECT_GT(failEachAllocation([&] { return Multiresolution::of(mesh).status().code; }), 50u);
	EXPECT_GT(failEachAllocation([&] { return DetailPyramid::of(mesh).status().code; }), 50u);
}

// ---- limits ----

TEST(DecodeLimits, RefuseMoreVerticesOrFacesThanAllowed)
{
	const auto file = encode(makeTorus(12, 9));
	const auto code = [&](std::uint64_t vertices, std::uint64_t faces) {
		DecodeOptions o;
		o.limits.maxVertices = vertices;
		o.limits.maxFaces    = faces;
		const auto back      = decode(file->bytes.data(), file->bytes.size(), o);
		const auto opened    = Decoder::open(file->bytes.data(), file->bytes.size(), o.limits);
		EXPECT_EQ(back.status().code, opened.status().code);
		EXPECT_EQ(back.hasValue(), back.ok());
		return back.status().code;
	};
	EXPECT_EQ(code(108, 216), StatusCode::Ok);
	EXPECT_EQ(code(107, 216), StatusCode::LimitExceeded);
	EXPECT_EQ(code(108, 215), StatusCode::LimitExceeded);
	EXPECT_EQ(code(0, 0), StatusCode::LimitExceeded);
}

/// A file that declares a huge mesh and holds little more than that.
Bytes hugeFile(std::uint32_t vertices, std::uint32_t faces, const Bytes& payload)
{
	Head h;
	h.lattice.bits = 12;
	h.lattice.step = 0.5;
	LevelRow row;
	row.vertices  = vertices;
	row.faces     = faces;
	row.bytes     = static_cast<std::uint32_t>(payload.size());
	row.endsChunk = true;
	h.rows.push_back(row);
	Bytes file;
	writeHead(h, file);
	writeChunk(kLevelChunk, payload, file);
	return file;
}

constexpr std::size_t kLittle = 16u << 20; ///< bytes: the decoder's models take a few megabytes

TEST(DecodeLimits, RefuseBeforeMemoryIsTaken)
{
	const Bytes file = hugeFile(500'000'000, 600'000'000, {1, 2, 3});
	AllocationWatch watch;
	EXPECT_EQ(decode(file.data(), file.size()).status().code, StatusCode::LimitExceeded);
	EXPECT_LT(watch.peak(), kLittle);
}

TEST(DecodeLimits, ADeclaredButAbsentMesh_TakesNoMemory)
{
	// Within the limits, but the bytes for it are not there.
	for (const std::uint8_t fill : {std::uint8_t {0}, std::uint8_t {0x55}, std::uint8_t {255}}) {
		const Bytes file = hugeFile(190'000'000, 380'000'000, Bytes(200, fill));
		AllocationWatch watch;
		const auto back = decode(file.data(), file.size());
		EXPECT_FALSE(back.ok());
		EXPECT_FALSE(back.hasValue());
		EXPECT_LT(watch.peak(), kLittle) << int(fill);
	}
}

TEST(DecodeLimits, OnADeclaredButAbsentSplit_TakeNoMemory)
{
	// A true base mesh; behind it a level that claims the most a split can give, again and again.
	const auto file = encode(makeTetrahedron());
	std::size_t end = 0;
	Head head       = *readHead(file->bytes.data(), file->bytes.size(), end);
	ASSERT_EQ(head.rows.size(), 1u);
	const ChunkPlace base = chunksOf(file->bytes)[1];
	LevelRow row          = head.rows[0];
	while (row.faces < 300'000'000 / 4) {
		row.kind = LevelKind::Split;
		row.vertices += 3 * row.faces / 2;
		row.faces *= 4;
		row.bytes = row.connectivityBytes = 0;
		head.rows.push_back(row);
	}
	Bytes lie;
	writeHead(head, lie);
	lie.insert(
	    lie.end(), file->bytes.begin() + static_cast<std::ptrdiff_t>(base.begin),
	    file->bytes.end());
	AllocationWatch watch;
	const auto back = decode(lie.data(), lie.size());
	EXPECT_EQ(back.status().code, StatusCode::Truncated) << back.status().what;
	EXPECT_LT(watch.peak(), kLittle);
}

TEST(Decoder, AdvancePastTheFinest_IsTheCallersMistake)
{
	const auto file = encode(makeIcosphere(3));
	auto decoder    = Decoder::open(file->bytes.data(), file->bytes.size());
	ASSERT_TRUE(decoder.ok());
	EXPECT_EQ(decoder->level(), -1);
	while (decoder->level() < decoder->info().finestLevel())
		ASSERT_TRUE(decoder->advance().ok());
	const MeshData finest = decoder->mesh();
	EXPECT_EQ(decoder->advance().code, StatusCode::InvalidArgument);
	EXPECT_EQ(decoder->mesh().positions, finest.positions);
	Decoder moved = std::move(*decoder);
	EXPECT_EQ(moved.level(), moved.info().finestLevel());
}

} // namespace
} // namespace wavemesh::test
