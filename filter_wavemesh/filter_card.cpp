// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_card.h"

#include "filter_wavemesh.h"

namespace wavemesh {
namespace {

constexpr char kReference[] =
    "<br>See:<br><i>S. Valette, R. Prost</i><br>"
    "<b>\"A Wavelet-Based Progressive Compression Scheme for Triangle Meshes: Wavemesh\"</b><br>"
    "IEEE Transactions on Visualization and Computer Graphics, 2004.";

const FilterCard kSimplify = {
    "Simplification: Wavemesh", "meshing_decimation_wavemesh",
    QString(
        "Replaces the mesh by a coarser level of its own hierarchy, made by inverse irregular "
        "subdivision: over the whole mesh, groups of two, three or four faces are merged into one. "
        "The result is the finest level within the target, not an exact count. If that is the "
        "finest level, the mesh stays as it is.<br>") +
        kReference,
    FilterPlugin::Remeshing, MeshModel::MM_GEOMETRY_AND_TOPOLOGY_CHANGE};

const FilterCard kBrowse = {
    "Wavemesh: Browse Levels", "apply_wavemesh_level",
    "Shows the layer at a level of detail: tick <i>Preview</i> and drag the slider. 0 is the base "
    "mesh, the coarsest; the finest level is the layer as it was, colours and all. Nothing is lost "
    "in either direction.<br>"
    "A layer opened from a .wmc file has its levels at hand; those of another layer were made when "
    "this dialog opened. Colours and selections made on a level stay with that level; a layer "
    "whose shape was edited gets new levels, made from what it shows.",
    FilterPlugin::Remeshing | FilterPlugin::Layer,
    // The preview is offered only to filters that change no counts. It would restore what is named
    // here; the levels themselves are restored by LayerLevels. The true mask goes out when applied.
    MeshModel::MM_TRANSFMATRIX};

const FilterCard kLayers = {
    "Wavemesh: Layers from Levels", "generate_wavemesh_levels",
    "Makes one new layer of each chosen level of the layer, from the base mesh (level 0) up to the "
    "finest level. The layer itself is not changed, and the new ones can be browsed as well.",
    FilterPlugin::Layer | FilterPlugin::MeshCreation, MeshModel::MM_NONE};

const FilterCard kReport = {
    "Wavemesh: Rate-Distortion Report", "get_wavemesh_report",
    QString(
        "Tells what each level costs and how close it is to the mesh: vertices, faces, bytes, bits "
        "per vertex, RMS and maximum surface distance; of the .wmc the layer came from, and of the "
        "paper's configurations side by side. The table appears in the log, and as a CSV file and "
        "a picture of the curves if files are named.<br>") +
        kReference,
    FilterPlugin::Measure, MeshModel::MM_NONE};

const FilterCard kColour = {
    "Wavemesh: Colour by Detail", "compute_scalar_by_wavemesh_detail_per_vertex",
    "Gives every vertex its wavelet coefficient, the detail that it adds to the next coarser "
    "level, as quality, and colours it by that: where the mesh is rough, where it is smooth, and "
    "which vertices the coarse levels keep. The colour ramp of lengths leaves out a tenth of the "
    "vertices at either end; MeshLab's quality mapper and histogram work on the quality. The mesh "
    "has to be an oriented manifold.",
    FilterPlugin::Quality | FilterPlugin::VertexColoring,
    MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR};

const FilterCard kEqualise = {
    "Wavemesh: Equalise Detail", "apply_coord_wavemesh_equaliser",
    "An equaliser for shape: makes the details of each band of levels weaker or stronger, from "
    "coarse shapes to the finest bumps, and takes noise off with a threshold. Tick <i>Preview</i> "
    "and move the sliders. Vertices move; connectivity, colours, texture coordinates and all else "
    "stay, and gains of 1 leave the mesh exactly as it is. The mesh has to be an oriented "
    "manifold.",
    FilterPlugin::Smoothing,
    MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_FACENORMAL};

} // namespace

const FilterCard& filterCard(int filter)
{
	static const FilterCard none = {};
	switch (filter) {
	case FilterWavemeshPlugin::FP_SIMPLIFY:
		return kSimplify;
	case FilterWavemeshPlugin::FP_BROWSE:
		return kBrowse;
	case FilterWavemeshPlugin::FP_LAYERS:
		return kLayers;
	case FilterWavemeshPlugin::FP_REPORT:
		return kReport;
	case FilterWavemeshPlugin::FP_COLOUR:
		return kColour;
	case FilterWavemeshPlugin::FP_EQUALISE:
		return kEqualise;
	default:
		return none;
	}
}

} // namespace wavemesh
