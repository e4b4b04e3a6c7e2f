// SPDX-License-Identifier: GPL-3.0-or-later
// What the thumbnailer reads of a file, and what it takes for it.
#include "allocation_watch.h"
#include "coarse_level.h"
#include "codec_check.h"
#include "container/container.h"
#include "mesh_families.h"
#include "wmc_files.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

namespace wavemesh::test {
namespace {

constexpr std::size_t kLittle = 16u << 20;

/// A file on disk as long as this lives.
class OnDisk
{
public:
	explicit OnDisk(const Bytes& bytes) :
	        name_(
	            testing::TempDir() + "coarse_level_" +
	            testing::UnitTest::GetInstance()->current_test_info()->name() + ".wmc")
	{
		std::ofstream(name_, std::ios::binary)
		    .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
	}
	~OnDisk() { std::remove(name_.c_str()); }
	const std::string& name() const { return name_; }

private:
	std::string name_;
};

/// A head alone, of a base mesh that is not there.
Bytes headOf(std::uint32_t vertices, std::uint32_t faces, std::uint64_t bytes)
{
	Head head;
	head.lattice.bits = 10;
	LevelRow row;
	row.vertices  = vertices;
	row.faces     = faces;
	row.bytes     = bytes;
	row.endsChunk = true;
	head.rows     = {row};
	Bytes file;
	writeHead(head, file);
	return file;
}

TEST(CoarseLevel, ADeclaredPrefixThatIsNotThereTakesNoMemory)
{
	for (const std::uint64_t bytes : {1'000'000ull, 100'000'000ull, 4'200'000'000ull}) {
		const OnDisk file(headOf(30, 10, bytes));
		AllocationWatch watch;
		EXPECT_FALSE(readCoarseLevel(file.name()).hasValue());
		EXPECT_LT(watch.peak(), kLittle / 8) << bytes;
	}
}

TEST(CoarseLevel, ABaseMeshOfMillionsIsRefused)
{
	const OnDisk file(headOf(30'000'000, 10'000'000, 1000));
	const auto level = readCoarseLevel(file.name());
	EXPECT_EQ(level.status().code, StatusCode::LimitExceeded);
	EXPECT_EQ(level.status().what, "its base mesh is too large for a small picture");
}

TEST(CoarseLevel, ManyVerticesOutsideFacesAreNotDrawn)
{
	MeshData mesh = makeIcosphere(6);
	mesh.positions.resize(200'000, {0, 0, 1});
	const auto encoded = encode(mesh);
	ASSERT_TRUE(encoded.ok());
	const OnDisk file(encoded->bytes);
	const auto level = readCoarseLevel(file.name());
	ASSERT_TRUE(level.ok());
	EXPECT_LT(level->mesh.positions.size(), 1000u);
	EXPECT_GT(level->mesh.triangles.size(), 100u);
}

TEST(CoarseLevel, IsTheFinestThatIsSmall)
{
	const auto encoded = encode(makeBumpySphere(30'000, 3));
	ASSERT_TRUE(encoded.ok());
	const OnDisk file(encoded->bytes);
	const auto level = readCoarseLevel(file.name());
	ASSERT_TRUE(level.ok());
	EXPECT_LT(level->level, encoded->info.finestLevel());
	EXPECT_LE(level->mesh.triangles.size(), CoarseLimits().faces);
	EXPECT_GE(level->mesh.triangles.size(), CoarseLimits().faces / 4);
	CoarseLimits all;
	all.faces = 100'000;
	all.bytes = encoded->bytes.size();
	EXPECT_EQ(readCoarseLevel(file.name(), all)->level, encoded->info.finestLevel());
}

TEST(CoarseLevel, ManyAttributesMakeItCoarser)
{
	MeshData mesh = makeBumpySphere(1'000, 3);
	Attribute colour;
	colour.of         = AttributeOf::Corner;
	colour.components = 16;
	colour.values.assign(3 * 16 * mesh.triangles.size(), 1);
	mesh.attributes.assign(8, colour);
	const auto encoded = encode(mesh);
	ASSERT_TRUE(encoded.ok());
	const OnDisk file(encoded->bytes);
	CoarseLimits limits;
	limits.numbers   = 200'000;
	const auto level = readCoarseLevel(file.name(), limits);
	ASSERT_TRUE(level.ok());
	EXPECT_LE(8 * 3 * 16 * level->mesh.triangles.size(), limits.numbers);
	EXPECT_GT(level->mesh.triangles.size(), 100u);
}

TEST(CoarseLevel, OfNoFileIsAStatus)
{
	EXPECT_EQ(readCoarseLevel("/nowhere/none.wmc").status().code, StatusCode::NotWmc);
	const OnDisk empty({});
	EXPECT_EQ(readCoarseLevel(empty.name()).status().code, StatusCode::NotWmc);
}

} // namespace
} // namespace wavemesh::test
