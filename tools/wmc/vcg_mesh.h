// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// VCGLib's mesh in double precision: what files are read into, checked with and measured on.
/// Expensive to include; keep it out of headers.
#pragma once

#include <vcg/complex/complex.h>

namespace wavemesh::tool {

class VcgVertex;
class VcgEdge;
class VcgFace;
struct VcgTypes : vcg::UsedTypes<
                      vcg::Use<VcgVertex>::AsVertexType,
                      vcg::Use<VcgEdge>::AsEdgeType,
                      vcg::Use<VcgFace>::AsFaceType>
{
};
class VcgVertex
        : public vcg::
              Vertex<VcgTypes, vcg::vertex::Coord3d, vcg::vertex::BitFlags, vcg::vertex::Mark>
{
};
class VcgEdge : public vcg::Edge<VcgTypes, vcg::edge::VertexRef, vcg::edge::BitFlags>
{
};
class VcgFace : public vcg::Face<
                    VcgTypes,
                    vcg::face::VertexRef,
                    vcg::face::FFAdj,
                    vcg::face::Normal3d,
                    vcg::face::Mark,
                    vcg::face::BitFlags>
{
};
class VcgMesh : public vcg::tri::
                    TriMesh<std::vector<VcgVertex>, std::vector<VcgEdge>, std::vector<VcgFace>>
{
};

} // namespace wavemesh::tool
