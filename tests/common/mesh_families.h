// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Meshes to test with. All are oriented 2-manifolds (mesh_check.h); coordinates are multiples of
/// 2^-20, so that no mathematical library changes them, and the same on every machine.
#pragma once

#include <wavemesh/mesh_data.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace wavemesh::test {

// ---- closed, genus 0
MeshData makeTetrahedron();
MeshData makeOctahedron();
MeshData makeCube(); ///< 8 vertices
MeshData makeIcosahedron();
/// Every face of an icosahedron divided into n^2: 10 n^2 + 2 vertices on the unit sphere. n >= 1
MeshData makeIcosphere(int n);
/// The icosphere with at least `vertices` vertices, bumpy, a sixth of its edges flipped.
MeshData makeBumpySphere(std::uint32_t vertices, std::uint64_t seed);
/// Two apices of valence n over a ring. n >= 3
MeshData makeBipyramid(int n);
/// Two cones, base to base, of `rings` rings each. n >= 3, rings >= 1
MeshData makeDoubleCone(int n, int rings);
/// Every face of a closed mesh capped by a vertex of valence 3.
MeshData makeKleetope(const MeshData& mesh, double height = 0.1);
/// A prism over a star with `points` points: sharp edges, flat caps fanned from their middle.
MeshData makeStarPrism(int points, int layers);

// ---- closed, with handles
MeshData makeTorus(int n, int m); ///< n x m vertices, n, m >= 3
/// A plate with `genus` holes, each of its cells n x n quads. n >= 1
MeshData makeHoledPlate(int genus, int n);

// ---- open
MeshData makeTriangle();
MeshData makeTwoTriangles();
MeshData makeGrid(int n, int m);     ///< n x m vertices, n, m >= 2, heights of a smooth function
MeshData makeFlatGrid(int n, int m); ///< all in the plane z = 0, diagonals alternating
/// A Delaunay triangulation of irregular points, as a height field.
MeshData makeTerrain(std::uint32_t vertices, std::uint64_t seed);
MeshData makeFan(int n);                 ///< a disc, its middle of valence n >= 3
MeshData makeStrip(int n);               ///< n >= 1 triangles in a row
MeshData makeAnnulus(int n);             ///< 2 n triangles, two boundary loops, n >= 3
MeshData makeCylinder(int n, int rings); ///< open at both ends
/// `mesh` without up to `holes` of its faces, chosen so that it stays manifold.
MeshData punch(const MeshData& mesh, int holes, std::uint64_t seed);

// ---- from others
MeshData joined(const std::vector<MeshData>& parts); ///< one after the other, moved nowhere
MeshData moved(MeshData mesh, double x, double y, double z);
MeshData scaled(MeshData mesh, double x, double y, double z);
/// Vertices, faces and first corners in random order: the same surface.
MeshData shuffled(const MeshData& mesh, std::uint64_t seed);
/// Every coordinate moved by up to `amount`.
MeshData jittered(MeshData mesh, double amount, std::uint64_t seed);
/// A sphere of about `vertices` vertices after many random flips, or collapses of half of them.
MeshData makeFlippedSphere(std::uint32_t vertices, std::uint64_t seed);
MeshData makeCollapsedSphere(std::uint32_t vertices, std::uint64_t seed);

struct NamedMesh
{
	std::string name; ///< letters, digits and underscores
	MeshData mesh;
};

/// One or several of each, all below 3000 vertices.
std::vector<NamedMesh> allFamilies();
/// Those of allFamilies() with at most `maxVertices` vertices.
std::vector<NamedMesh> smallFamilies(std::size_t maxVertices = 60);

} // namespace wavemesh::test
