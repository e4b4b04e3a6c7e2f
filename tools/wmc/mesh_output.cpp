// SPDX-License-Identifier: GPL-3.0-or-later
#include "attribute_options.h"
#include "console.h"
#include "failure.h"
#include "file_io.h"
#include "full_mesh.h"
#include "mesh_files.h"
#include "ply_names.h"
#include "polygons.h"

#include <wavemesh/vcg_attributes.h>
#include <wavemesh/vcg_wmc.h>

#include <wrap/io_trimesh/export_ply.h>
#include <wrap/io_trimesh/export_stl.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <sstream>

namespace wavemesh::tool {

namespace io = vcg::tri::io;

namespace {

/// OBJ and OFF, each number with as many digits as give it back exactly (VCGLib writes 16).
class TextMesh
{
public:
	explicit TextMesh(OutputFile& out) : out_(out) {}

	TextMesh& operator<<(const std::string& s)
	{
		text_ += s;
		return *this;
	}
	TextMesh& operator<<(const char* s)
	{
		text_ += s;
		return *this;
	}
	template <class Number>
	TextMesh& operator<<(Number x)
	{
		char digits[40];
		const auto end = std::to_chars(digits, digits + sizeof digits, x).ptr;
		text_.append(digits, end);
		if (text_.size() > (1 << 20))
			flush();
		return *this;
	}
	void flush()
	{
		out_.write(text_.data(), text_.size());
		text_.clear();
	}

private:
	OutputFile& out_;
	std::string text_;
};

/// The attribute, if the mesh has it with so many columns.
const Attribute* find(const MeshData& mesh, AttributeOf of, AttributeKind kind, int columns)
{
	for (const Attribute& a : mesh.attributes)
		if (a.of == of && a.kind == kind && a.components == columns)
			return &a;
	return nullptr;
}

const double* rowOf(const Attribute& a, std::size_t row)
{
	return a.values.data() + row * std::size_t(a.components);
}

int byteOf(double x)
{
	return vcg_detail::narrowed<std::uint8_t>(x);
}

/// " r g b", and alpha if it is not 255 everywhere.
class Colours
{
public:
	explicit Colours(const Attribute* a) : a_(a)
	{
		for (std::size_t i = 3; a && i < a->values.size(); i += 4)
			count_ = a->values[i] != 255 ? 4 : count_;
	}
	/// @param fractions  0..1 as VCGLib reads them back: it rounds down
	void write(TextMesh& text, std::size_t row, bool fractions) const
	{
		for (int k = 0; a_ && k < count_; ++k) {
			const int c = byteOf(rowOf(*a_, row)[k]);
			text << " ";
			if (!fractions)
				text << c;
			else if (c == 0 || c == 255)
				text << c / 255;
			else
				text << double(float((c + 0.25) / 255));
		}
	}

private:
	const Attribute* a_;
	int count_ = 3;
};

/// Texture coordinates of corners: distinct pairs in the order in which they come.
struct CornerPlaces
{
	std::vector<std::size_t> index; ///< #corners
	std::vector<const double*> place;

	/// @param a  must stay; nullptr: there are none
	explicit CornerPlaces(const Attribute* a)
	{
		std::map<std::pair<double, double>, std::size_t> known;
		for (std::size_t c = 0; a && 3 * c < a->values.size(); ++c) {
			const double* row           = rowOf(*a, c);
			const auto [it, isNewPlace] = known.insert({{row[0], row[1]}, place.size()});
			if (isNewPlace)
				place.push_back(row);
			index.push_back(it->second);
		}
	}
};

std::string materialsPath(const std::string& path)
{
	return std::filesystem::path(path).replace_extension(".mtl").string();
}

void writeMaterials(const MeshData& mesh, const std::string& path)
{
	OutputFile out(materialsPath(path));
	TextMesh text(out);
	for (std::size_t i = 0; i < mesh.textures.size(); ++i)
		text << "newmtl texture" << i << "\nKd 1 1 1\nmap_Kd " << visible(mesh.textures[i]) << "\n";
	text.flush();
	out.commit();
}

bool isTextured(const MeshData& mesh)
{
	return !mesh.textures.empty() && (find(mesh, AttributeOf::Corner, AttributeKind::TexCoord, 3) ||
	                                  find(mesh, AttributeOf::Vertex, AttributeKind::TexCoord, 3));
}

/// @return whether all polygons are in it
bool writeObj(const MeshData& mesh, const std::string& path, OutputFile& out)
{
	const Attribute* normals = find(mesh, AttributeOf::Vertex, AttributeKind::Normal, 3);
	const Attribute* wedges  = find(mesh, AttributeOf::Corner, AttributeKind::TexCoord, 3);
	const Attribute* places =
	    wedges ? nullptr : find(mesh, AttributeOf::Vertex, AttributeKind::TexCoord, 3);
	const bool textured = isTextured(mesh);
	const Colours colours(find(mesh, AttributeOf::Vertex, AttributeKind::Colour, 4));
	TextMesh text(out);
	if (textured)
		text << "mtllib " << std::filesystem::path(materialsPath(path)).filename().string() << "\n";
	for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
		const auto& p = mesh.positions[v];
		text << "v " << p[0] << " " << p[1] << " " << p[2];
		colours.write(text, v, true);
		text << "\n";
	}
	for (std::size_t v = 0; normals && v < mesh.positions.size(); ++v)
		text << "vn " << rowOf(*normals, v)[0] << " " << rowOf(*normals, v)[1] << " "
		     << rowOf(*normals, v)[2] << "\n";
	const CornerPlaces corners(wedges);
	for (const double* row : corners.place)
		text << "vt " << row[0] << " " << row[1] << "\n";
	for (std::size_t v = 0; places && v < mesh.positions.size(); ++v)
		text << "vt " << rowOf(*places, v)[0] << " " << rowOf(*places, v)[1] << "\n";
	const auto textureOf = [&](std::uint32_t c) {
		return !textured ? -1
		       : wedges  ? rowOf(*wedges, c)[2]
		                 : rowOf(*places, mesh.triangles[c / 3][0])[2];
	};
	const Polygons faces = polygonsOf(mesh, [&](std::uint32_t c, std::uint32_t d) {
		return textureOf(c) == textureOf(d) && (!wedges || corners.index[c] == corners.index[d]);
	});
	double texture       = -1;
	for (std::size_t f = 0; f < faces.count(); ++f) {
		const double now = textureOf(faces.corners[faces.begin[f]]);
		if (now != texture)
			text << "usemtl texture" << vcg_detail::narrowed<std::uint16_t>(now) << "\n";
		texture = now;
		text << "f";
		for (std::size_t i = faces.begin[f]; i < faces.begin[f + 1]; ++i) {
			const std::uint32_t c = faces.corners[i], v = mesh.triangles[c / 3][c % 3];
			text << " " << v + 1;
			if (wedges)
				text << "/" << corners.index[c] + 1;
			else if (places)
				text << "/" << v + 1;
			if (normals)
				text << (wedges || places ? "/" : "//") << v + 1;
		}
		text << "\n";
	}
	text.flush();
	return faces.complete;
}

/// @return whether all polygons are in it
bool writeOff(const MeshData& mesh, OutputFile& out)
{
	const Attribute* ofVertices = find(mesh, AttributeOf::Vertex, AttributeKind::Colour, 4);
	const Attribute* normals    = find(mesh, AttributeOf::Vertex, AttributeKind::Normal, 3);
	const Colours colours(ofVertices);
	const Attribute* ofFaces = find(mesh, AttributeOf::Face, AttributeKind::Colour, 4);
	const Colours faceColours(ofFaces);
	const Polygons faces = polygonsOf(mesh, [&](std::uint32_t c, std::uint32_t d) {
		return !ofFaces ||
		       std::equal(
		           rowOf(*ofFaces, c / 3), rowOf(*ofFaces, c / 3) + 4, rowOf(*ofFaces, d / 3));
	});
	TextMesh text(out);
	text << (ofVertices ? "C" : "") << (normals ? "N" : "") << "OFF\n"
	     << mesh.positions.size() << " " << faces.count() << " 0\n";
	for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
		const auto& p = mesh.positions[v];
		text << p[0] << " " << p[1] << " " << p[2];
		for (int k = 0; normals && k < 3; ++k)
			text << " " << rowOf(*normals, v)[k];
		colours.write(text, v, false);
		text << "\n";
	}
	for (std::size_t f = 0; f < faces.count(); ++f) {
		text << faces.begin[f + 1] - faces.begin[f];
		for (std::size_t i = faces.begin[f]; i < faces.begin[f + 1]; ++i)
			text << " " << mesh.triangles[faces.corners[i] / 3][faces.corners[i] % 3];
		faceColours.write(text, faces.corners[faces.begin[f]] / 3, false);
		text << "\n";
	}
	text.flush();
	return faces.complete;
}

/// Bytes of a binary PLY with triangles, from its own head. 0 if there is none.
std::size_t lengthOfPly(const std::string& path)
{
	const Bytes head = readFile(path, 1 << 20);
	std::string text(reinterpret_cast<const char*>(head.data()), head.size());
	const auto end = text.find("end_header\n");
	if (end == text.npos)
		return 0;
	std::istringstream lines(text.substr(0, end));
	std::size_t length = end + 11, count = 0;
	for (std::string line; std::getline(lines, line);) {
		std::istringstream words(line);
		std::string what, type, name;
		words >> what >> type >> name;
		if (what == "element")
			count = std::stoul(name);
		else if (what == "property" && type == "list") // of indices, of texture coordinates
			length += count * (line.find(" float texcoord") != line.npos ? 1 + 6 * 4
			                   : line.find(" double ") != line.npos      ? 1 + 3 * 8
			                                                             : 1 + 3 * 4);
		else if (what == "property")
			length += count * (type == "double" ? 8 : type == "uchar" ? 1 : 4);
	}
	return length;
}

int maskOf(unsigned channels)
{
	using Mask = io::Mask;
	int mask   = 0;
	for (const auto& [channel, bit] :
	     {std::pair<unsigned, int> {kVertexColour, Mask::IOM_VERTCOLOR},
	      {kVertexNormal, Mask::IOM_VERTNORMAL},
	      {kVertexQuality, Mask::IOM_VERTQUALITY},
	      {kVertexRadius, Mask::IOM_VERTRADIUS},
	      {kVertexTexCoord, Mask::IOM_VERTTEXCOORD},
	      {kFaceColour, Mask::IOM_FACECOLOR},
	      {kFaceNormal, Mask::IOM_FACENORMAL},
	      {kFaceQuality, Mask::IOM_FACEQUALITY},
	      {kWedgeTexCoord, Mask::IOM_WEDGTEXCOORD}})
		mask |= channels & channel ? bit : 0;
	return mask;
}

/// Can a PLY have it as a property of its own, and will reading give it back?
bool isOwnProperty(const MeshData& mesh, const Attribute& a)
{
	constexpr std::size_t kLongest = 100;
	const auto isFirst             = [&](const Attribute& b) {
        return b.of == a.of && b.kind == a.kind && b.name == a.name;
	};
	const auto isVisible = [](char c) { return c > ' ' && c <= '~'; };
	return a.kind == AttributeKind::Custom &&
	       (a.of == AttributeOf::Vertex || a.of == AttributeOf::Face) &&
	       (a.components == 1 || (a.components == 3 && a.type != NumberType::Integer)) &&
	       !a.name.empty() && a.name.size() <= kLongest &&
	       std::all_of(a.name.begin(), a.name.end(), isVisible) &&
	       !isNameInPly(mesh, a.of, a.name) &&
	       &*std::find_if(mesh.attributes.begin(), mesh.attributes.end(), isFirst) == &a;
}

/// Whole numbers, which setAttributes() has as doubles, as ints under another name.
/// @return the name
std::string addAsInts(const Attribute& a, FullMesh& m)
{
	using Allocator        = vcg::tri::Allocator<FullMesh>;
	const std::string name = "int " + a.name;
	const auto set         = [&](auto handle) {
        for (std::size_t i = 0; i < a.values.size(); ++i)
            handle[i] = static_cast<int>(a.values[i]);
	};
	if (a.of == AttributeOf::Vertex)
		set(Allocator::AddPerVertexAttribute<int>(m, name));
	else
		set(Allocator::AddPerFaceAttribute<int>(m, name));
	return name;
}

/// @pre setAttributes(mesh, m)
void addOwnProperties(const MeshData& mesh, FullMesh& m, io::PlyInfo& ply)
{
	const auto isInt = [](double x) { return x >= -2147483648.0 && x <= 2147483647.0; };
	for (const Attribute& a : mesh.attributes) {
		if (!isOwnProperty(mesh, a))
			continue;
		const bool whole =
		    a.type == NumberType::Integer && std::all_of(a.values.begin(), a.values.end(), isInt);
		const auto type      = whole                         ? vcg::ply::T_INT
		                       : a.type == NumberType::Float ? vcg::ply::T_FLOAT
		                                                     : vcg::ply::T_DOUBLE;
		const std::string in = whole ? addAsInts(a, m) : a.name;
		const int of         = a.of == AttributeOf::Vertex ? 0 : 1; // older VCGLibs have no names
		if (a.components == 3)
			ply.addPerElemPointAttribute(of, type, in, a.name);
		else
			ply.addPerElemScalarAttribute(of, type, in, a.name);
	}
}

/// PLY and STL by VCGLib. Its exporters do not see a disk that is full when they close the file:
/// the length tells.
void writeBinary(const MeshData& mesh, const std::string& path, const OutputFile& out, bool isStl)
{
	FullMesh m;
	fromMeshData(mesh, m);
	setAttributes(mesh, m);
	for (std::string& name : m.textures)
		name = visible(name);
	io::PlyInfo ply;
	ply.mask = maskOf(channelsOf(mesh));
	if (!isStl)
		addOwnProperties(mesh, m, ply);
	const int error        = isStl ? io::ExporterSTL<FullMesh>::Save(m, out.path().c_str())
	                               : io::ExporterPLY<FullMesh>::Save(m, out.path().c_str(), true, ply);
	const std::size_t want = isStl ? 84 + 50 * mesh.triangles.size() : lengthOfPly(out.path());
	if (error || want == 0 || fileSize(out.path()) != want)
		throw Failure(path + ": the mesh could not be written whole; is the disk full?");
}

/// Can a file of this format hold the attribute?
bool holds(Format format, const MeshData& mesh, const Attribute& a)
{
	const bool ofVertex = a.of == AttributeOf::Vertex;
	switch (a.kind) {
	case AttributeKind::Colour:
		return format == Format::Ply || (ofVertex && format == Format::Obj) ||
		       format == Format::Off;
	case AttributeKind::Normal:
		return format == Format::Ply ||
		       (ofVertex && (format == Format::Obj || format == Format::Off));
	case AttributeKind::TexCoord:
		return format == Format::Ply || format == Format::Obj;
	case AttributeKind::Quality:
	case AttributeKind::Radius:
		return format == Format::Ply;
	case AttributeKind::Custom:
		return format == Format::Ply && isOwnProperty(mesh, a);
	case AttributeKind::FauxEdges:
		return format == Format::Obj || format == Format::Off;
	default:
		return false;
	}
}

/// @param polygonsWhole  no polygon is in the file as triangles
std::vector<std::string> whatIsNotHeld(const MeshData& mesh, Format format, bool polygonsWhole)
{
	std::vector<std::string> names;
	for (const Attribute& a : mesh.attributes)
		if (a.kind == AttributeKind::FauxEdges && holds(format, mesh, a)) {
			if (!polygonsWhole)
				names.push_back("some " + nameOf(a.of, a.kind, a.name));
		}
		else if (!holds(format, mesh, a))
			names.push_back(nameOf(a.of, a.kind, a.name));
	if (format == Format::Stl) {
		std::vector<bool> used(mesh.positions.size(), false);
		for (const auto& t : mesh.triangles)
			for (const std::uint32_t v : t)
				used[v] = true;
		if (std::find(used.begin(), used.end(), false) != used.end())
			names.push_back("vertices without faces");
	}
	for (const std::string& name : mesh.textures) // of lines of text
		if (visible(name) != name && isTextured(mesh) &&
		    (format == Format::Ply || format == Format::Obj))
			names.push_back("the name of texture '" + visible(name) + "'");
	return names;
}

} // namespace

bool isNamedAsMesh(const std::string& path)
{
	return formatOf(path) != Format::Unknown;
}

void checkMeshFormat(const std::string& path)
{
	if (!isNamedAsMesh(path))
		throw UsageError(path + ": only .ply, .obj, .off and .stl can be written");
}

std::vector<std::string> saveMesh(const MeshData& mesh, const std::string& path)
{
	checkMeshFormat(path);
	const Format format = formatOf(path);
	OutputFile out(path);
	bool polygonsWhole = true;
	if (format == Format::Obj)
		polygonsWhole = writeObj(mesh, path, out);
	else if (format == Format::Off)
		polygonsWhole = writeOff(mesh, out);
	else
		writeBinary(mesh, path, out, format == Format::Stl);
	out.commit();
	if (format == Format::Obj && isTextured(mesh))
		writeMaterials(mesh, path);
	return whatIsNotHeld(mesh, format, polygonsWhole);
}

} // namespace wavemesh::tool
