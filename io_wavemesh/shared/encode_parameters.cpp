// SPDX-License-Identifier: GPL-3.0-or-later
#include "encode_parameters.h"

#include "plugin_support.h"

namespace wavemesh {

void addPromiseParameters(RichParameterList& list)
{
	list.addParam(RichBool(
	    "exact", false, "Exact coordinates",
	    "Keep every coordinate bit for bit, not only its place on the lattice, and every number of "
	    "texture coordinates, quality and the like. Such a file is two to six times as large."));
	list.addParam(RichBool(
	    "keep_order", false, "Keep the order",
	    "Keep the order of vertices and faces, and the first corner of each face. The file grows "
	    "by 2 bits per vertex where the order follows the surface, by up to 30 where it does not.",
	    true));
}

void addEncodeParameters(RichParameterList& list, const EncodeOptions& defaults, Offered offered)
{
	const bool hideMethod = offered == Offered::Precision, hideAim = offered != Offered::All;
	list.addParam(RichInt(
	    "bits", defaults.bits, "Precision (bits per coordinate)",
	    "Vertices are moved to a lattice of 2^bits points over the largest extent of the bounding "
	    "box, 1 to 24 bits. 12 bits keep about 1/8000 of the extent, 16 bits about 1/130000.",
	    offered == Offered::Method));
	list.addParam(RichFloat(
	    "step", Scalarm(defaults.step), "Lattice step (model units, 0 = use bits)",
	    "Distance of two lattice points in model units, in place of the number of bits: no "
	    "coordinate moves by more than half of it. 0: the step follows from the bits.",
	    hideAim));
	list.addParam(RichEnum(
	    "mode", int(defaults.mode), {"classic", "compact"}, "Mode",
	    "<b>compact</b>: positions get more precise as the mesh gets denser; the smaller file. "
	    "<b>classic</b>: the method of the paper: every level is one subdivision step at full "
	    "precision, with lifting if asked for.",
	    hideMethod));
	list.addParam(RichEnum(
	    "optimize", int(defaults.optimize), {"size", "balanced", "levels"}, "Optimize for",
	    "<b>size</b>: the fewest bytes, coarse levels as they come. <b>balanced</b>: coarse levels "
	    "close to the original, for up to 3 % more bytes. <b>levels</b>: the closest at any low "
	    "rate, for up to 40 % more.",
	    hideAim));
	list.addParam(RichInt(
	    "effort", defaults.effort, "Effort (1 to 3)",
	    "1 is the fastest to save and to open, for a larger file: it always writes the classic "
	    "mode. 2 chooses one way by a look at the mesh (of up to fourteen if the mesh is small), "
	    "and 3 tries many, keeps the best file, and takes four to twenty times as long to save.",
	    hideMethod));
	list.addParam(RichEnum(
	    "wgc", int(defaults.wgc), {"off", "on", "auto"}, "Geometrical criterion (WGC)",
	    "Wavelet geometrical criterion: keep the vertices of sharp edges and corners in the coarse "
	    "levels. <b>off</b>: it has no say. <b>on</b>: better coarse levels of mechanical parts. "
	    "<b>auto</b>: both are tried and the smaller file is kept if <i>Optimize for</i> is size, "
	    "in classic mode or with effort 3, and below 4096 vertices with effort 1 or 3; else off. "
	    "With levels it does not matter.",
	    hideMethod));
	list.addParam(RichEnum(
	    "lifting", defaults.lifting - kLiftingOff, {"off", "0-disc", "1-disc", "2-disc"},
	    "Lifting (classic mode)",
	    "Coarse vertices are moved to make the coarse levels smoother and closer to the original, "
	    "using the details around them. <b>off</b>: coarse vertices are vertices of the original. "
	    "<b>k-disc</b>: how far around a vertex the details are gathered.",
	    hideMethod));
	list.addParam(RichFloat(
	    "wgc_sharpness", Scalarm(defaults.wgcSharpness), "WGC: sharpness",
	    "A vertex is sharp if it lies on the border or if two of its faces meet at an angle whose "
	    "sine is above this, 0 to 1.",
	    true));
	list.addParam(RichFloat(
	    "wgc_deviation", Scalarm(defaults.wgcDeviation), "WGC: deviation",
	    "A sharp vertex may vanish from the next coarser level only if it lies closer than this to "
	    "the edge that replaces it, relative to the length of that edge.",
	    true));
}

void addAttributeParameters(RichParameterList& list)
{
	list.addParam(RichInt(
	    "texcoord_bits", usualBits(AttributeKind::TexCoord),
	    "Texture coordinates (bits, 0 = exact)",
	    "Texture coordinates are rounded to 2^bits steps over their range, 1 to 24 bits. 12 bits "
	    "are half a texel of a 2048 pixel texture. 0, and <i>Exact coordinates</i>, keep every "
	    "number. The log says what was rounded."));
	list.addParam(RichInt(
	    "normal_bits", usualBits(AttributeKind::Normal), "Normals (bits, 0 = exact)",
	    "The same of normals, if they are saved. 10 bits turn a normal by less than a tenth of a "
	    "degree on average, by a quarter at most.",
	    true));
	list.addParam(RichInt(
	    "quality_bits", usualBits(AttributeKind::Quality), "Quality and radius (bits, 0 = exact)",
	    "The same of quality and radius of vertices and faces. Whole numbers are always exact, as "
	    "colours are.",
	    true));
}

void setAttributeBits(const RichParameterList& list, bool exact, MeshData& mesh)
{
	const auto bitsOf = [&](const char* name, AttributeKind kind) {
		const int bits = integerOf(list, name, usualBits(kind));
		if (bits < 0 || bits > 24)
			throw MLException(QString("Wavemesh: '%1' has to be 0 to 24.").arg(name));
		return bits;
	};
	const int texCoord = bitsOf("texcoord_bits", AttributeKind::TexCoord);
	const int normal   = bitsOf("normal_bits", AttributeKind::Normal);
	const int quality  = bitsOf("quality_bits", AttributeKind::Quality);
	for (Attribute& a : mesh.attributes)
		a.bits = exact                                                                 ? 0
		         : a.kind == AttributeKind::TexCoord                                   ? texCoord
		         : a.kind == AttributeKind::Normal                                     ? normal
		         : a.kind == AttributeKind::Quality || a.kind == AttributeKind::Radius ? quality
		                                                                               : 0;
}

static int choiceOf(const RichParameterList& list, const QString& name, int missing, int last)
{
	const int choice = integerOf(list, name, missing);
	if (choice < 0 || choice > last)
		throw MLException(QString("Wavemesh: '%1' has to be 0 to %2.").arg(name).arg(last));
	return choice;
}

EncodeOptions encodeOptions(const RichParameterList& list, const EncodeOptions& defaults)
{
	EncodeOptions options = defaults;
	options.bits          = integerOf(list, "bits", defaults.bits);
	options.step          = numberOf(list, "step", defaults.step);
	options.mode          = Mode(choiceOf(list, "mode", int(defaults.mode), int(Mode::Compact)));
	options.optimize =
	    Optimize(choiceOf(list, "optimize", int(defaults.optimize), int(Optimize::Levels)));
	options.effort = integerOf(list, "effort", defaults.effort);
	options.wgc    = Wgc(choiceOf(list, "wgc", int(defaults.wgc), int(Wgc::Auto)));
	options.lifting =
	    kLiftingOff + choiceOf(list, "lifting", defaults.lifting - kLiftingOff, 2 - kLiftingOff);
	options.exact        = flagOf(list, "exact", defaults.exact);
	options.keepOrder    = flagOf(list, "keep_order", defaults.keepOrder);
	options.wgcSharpness = numberOf(list, "wgc_sharpness", defaults.wgcSharpness);
	options.wgcDeviation = numberOf(list, "wgc_deviation", defaults.wgcDeviation);
	return options;
}

} // namespace wavemesh
