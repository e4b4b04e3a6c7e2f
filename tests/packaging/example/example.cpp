// SPDX-License-Identifier: GPL-3.0-or-later
// Encodes a VCG mesh of one's own, and decodes it at every level.
#include <wavemesh/codec.h>
#include <wavemesh/vcg_wmc.h>

#include <vcg/complex/algorithms/create/platonic.h>

#include <cstdio>

class Vertex;
class Face;
struct Types : vcg::UsedTypes<vcg::Use<Vertex>::AsVertexType, vcg::Use<Face>::AsFaceType> {};
class Vertex : public vcg::Vertex<Types, vcg::vertex::Coord3f, vcg::vertex::BitFlags> {};
class Face : public vcg::Face<Types, vcg::face::VertexRef, vcg::face::FFAdj, vcg::face::BitFlags> {};
class Mesh : public vcg::tri::TriMesh<std::vector<Vertex>, std::vector<Face>> {};

int main()
{
	Mesh sphere;
	vcg::tri::Sphere(sphere, 4);

	const auto file = wavemesh::encode(wavemesh::toMeshData(sphere));
	if (!file.ok())
		return std::printf("%s\n", file.status().what.c_str()), 1;
	for (int level = 0; level <= file->info.finestLevel(); ++level) {
		wavemesh::DecodeOptions options;
		options.level      = level;
		const auto decoded = wavemesh::decode(file->bytes.data(), file->bytes.size(), options);
		Mesh mesh;
		wavemesh::fromMeshData(decoded->mesh, mesh);
		std::printf("level %d: %d vertices, %d faces\n", level, mesh.VN(), mesh.FN());
	}
}
