// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// VCGLib's mesh in double precision with every channel that mesh files have: what they are written
/// from. Texture coordinates are floats, as VCGLib's files have them.
/// Expensive to include; keep it out of headers.
#pragma once

#include <vcg/complex/complex.h>

namespace wavemesh::tool {

/// VCGLib has the float one only.
template <class Base>
class RadiusInDouble : public vcg::vertex::Radius<double, Base>
{
public:
	static void Name(std::vector<std::string>& name)
	{
		name.push_back("Radiusd");
		Base::Name(name);
	}
};

class FullVertex;
class FullEdge;
class FullFace;
struct FullTypes : vcg::UsedTypes<
                       vcg::Use<FullVertex>::AsVertexType,
                       vcg::Use<FullEdge>::AsEdgeType,
                       vcg::Use<FullFace>::AsFaceType>
{
};
class FullVertex : public vcg::Vertex<
                       FullTypes,
                       vcg::vertex::Coord3d,
                       vcg::vertex::Normal3d,
                       vcg::vertex::Color4b,
                       vcg::vertex::Qualityd,
                       RadiusInDouble,
                       vcg::vertex::TexCoord2f,
                       vcg::vertex::BitFlags,
                       vcg::vertex::Mark>
{
};
class FullEdge : public vcg::Edge<FullTypes, vcg::edge::VertexRef, vcg::edge::BitFlags>
{
};
class FullFace : public vcg::Face<
                     FullTypes,
                     vcg::face::VertexRef,
                     vcg::face::FFAdj,
                     vcg::face::Normal3d,
                     vcg::face::Color4b,
                     vcg::face::Qualityd,
                     vcg::face::WedgeTexCoord2f,
                     vcg::face::Mark,
                     vcg::face::BitFlags>
{
};
class FullMesh : public vcg::tri::
                     TriMesh<std::vector<FullVertex>, std::vector<FullEdge>, std::vector<FullFace>>
{
};

} // namespace wavemesh::tool
