// SPDX-License-Identifier: GPL-3.0-or-later
// Optional channels of a VCG mesh through the codec and back.
#include "mesh_families.h"
#include "vcg_mesh.h"

#include <wavemesh/codec.h>
#include <wavemesh/vcg_attributes.h>
#include <wavemesh/vcg_wmc.h>

#include <gtest/gtest.h>

namespace wavemesh::test {
namespace {

class V;
class E;
class F;
struct Types
        : vcg::
              UsedTypes<vcg::Use<V>::AsVertexType, vcg::Use<E>::AsEdgeType, vcg::Use<F>::AsFaceType>
{
};
class V : public vcg::Vertex<
              Types,
              vcg::vertex::Coord3f,
              vcg::vertex::Normal3f,
              vcg::vertex::Color4b,
              vcg::vertex::Qualityf,
              vcg::vertex::TexCoord2f,
              vcg::vertex::Radiusf,
              vcg::vertex::BitFlags>
{
};
class E : public vcg::Edge<Types, vcg::edge::VertexRef, vcg::edge::BitFlags>
{
};
class F : public vcg::Face<
              Types,
              vcg::face::VertexRef,
              vcg::face::Normal3f,
              vcg::face::Color4b,
              vcg::face::Qualityf,
              vcg::face::WedgeTexCoord2f,
              vcg::face::BitFlags>
{
};
class FullMesh : public vcg::tri::TriMesh<std::vector<V>, std::vector<E>, std::vector<F>>
{
public:
	vcg::Matrix44f Tr;
};

void makeFull(FullMesh& m)
{
	fromMeshData(makeIcosphere(3), m);
	auto heat  = vcg::tri::Allocator<FullMesh>::GetPerVertexAttribute<float>(m, "heat");
	auto depth = vcg::tri::Allocator<FullMesh>::GetPerFaceAttribute<double>(m, "depth");
	auto flow  = vcg::tri::Allocator<FullMesh>::GetPerVertexAttribute<vcg::Point3f>(m, "flow");
	auto axis  = vcg::tri::Allocator<FullMesh>::GetPerFaceAttribute<vcg::Point3d>(m, "axis");
	for (std::size_t i = 0; i < m.vert.size(); ++i) {
		const int n = int(i);
		V& v        = m.vert[i];
		v.C()       = vcg::Color4b((unsigned char)(n % 256), 7, (unsigned char)(n * 3 % 256), 255);
		v.N()       = vcg::Point3f(0.1f * float(n), 1, -2);
		v.Q()       = 0.5f * float(n);
		v.R()       = 3;
		v.T().U()   = 0.25f;
		v.T().V()   = float(n);
		v.T().N()   = 1;
		if (n % 3 == 0)
			v.SetS();
		heat[i] = 0.7f * float(n);
		flow[i] = vcg::Point3f(0.1f * float(n), -1, 2);
	}
	for (std::size_t i = 0; i < m.face.size(); ++i) {
		const int n = int(i);
		F& f        = m.face[i];
		f.C()       = vcg::Color4b(1, 2, 3, (unsigned char)(n % 256));
		f.N()       = vcg::Point3f(1, float(n), 0.5f);
		f.Q()       = -1.5f * float(n);
		for (int k = 0; k < 3; ++k) {
			f.WT(k).U() = float(n % 7) + 0.1f * float(k);
			f.WT(k).V() = 0.5f;
			f.WT(k).N() = short(n % 2);
		}
		if (n % 5 == 0)
			f.SetS();
		if (n % 2 == 0)
			f.SetF(n % 3);
		depth[i] = 0.1 * n;
		axis[i]  = vcg::Point3d(0.1, n, 0.3 * n);
	}
	m.textures = {"a.png", "b.png"};
	m.Tr.SetIdentity();
	m.Tr.ElementAt(0, 3) = 12.5f;
}

TEST(VcgAttributes, EveryChannelComesBackThroughAFile)
{
	FullMesh m;
	makeFull(m);
	MeshData data = toMeshData(m);
	addAttributes(m, kAllChannels, data);
	EXPECT_EQ(channelsOf(data), unsigned(kAllChannels));
	EncodeOptions o;
	o.keepOrder     = true;
	o.exact         = true;
	const auto file = encode(data, o);
	ASSERT_TRUE(file.ok()) << file.status().what;
	const auto back = decode(file->bytes.data(), file->bytes.size());
	ASSERT_TRUE(back.ok()) << back.status().what;
	FullMesh n;
	n.Tr.SetIdentity();
	fromMeshData(back->mesh, n);
	setAttributes(back->mesh, n);
	MeshData again = toMeshData(n);
	addAttributes(n, kAllChannels, again);
	EXPECT_EQ(again.positions, data.positions);
	EXPECT_EQ(again.triangles, data.triangles);
	EXPECT_EQ(again.textures, data.textures);
	ASSERT_EQ(again.attributes.size(), data.attributes.size());
	for (std::size_t i = 0; i < data.attributes.size(); ++i) {
		EXPECT_EQ(again.attributes[i].kind, data.attributes[i].kind) << i;
		EXPECT_EQ(again.attributes[i].name, data.attributes[i].name) << i;
		EXPECT_EQ(again.attributes[i].values, data.attributes[i].values) << i;
	}
}

TEST(VcgAttributes, OnlyTheChannelsAskedForAreTaken)
{
	FullMesh m;
	makeFull(m);
	MeshData data = toMeshData(m);
	addAttributes(m, kVertexColour | kFauxEdges, data);
	EXPECT_EQ(channelsOf(data), kVertexColour | kFauxEdges);
	EXPECT_EQ(data.attributes.size(), 2u);
	EXPECT_TRUE(data.textures.empty());
}

TEST(VcgAttributes, DeletedElementsAreSkipped)
{
	FullMesh m;
	makeFull(m);
	vcg::tri::Allocator<FullMesh>::DeleteFace(m, m.face[4]);
	MeshData data = toMeshData(m);
	addAttributes(m, kAllChannels, data);
	const auto file = encode(data);
	EXPECT_TRUE(file.ok()) << file.status().what;
}

TEST(VcgAttributes, AMeshTypeWithoutChannelsTakesAndGivesNone)
{
	FullMesh full;
	makeFull(full);
	MeshData data = toMeshData(full);
	addAttributes(full, kAllChannels & ~(kVertexSelection | kFaceSelection | kFauxEdges), data);
	tool::VcgMesh plain;
	fromMeshData(data, plain);
	setAttributes(data, plain);
	MeshData again = toMeshData(plain);
	addAttributes(plain, kVertexColour | kVertexQuality | kFaceQuality | kWedgeTexCoord, again);
	EXPECT_TRUE(again.attributes.empty());
	EXPECT_EQ(again.triangles, data.triangles);
}

} // namespace
} // namespace wavemesh::test
