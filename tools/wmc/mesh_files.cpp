// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_files.h"

#include "console.h"
#include "failure.h"
#include "file_io.h"
#include "full_mesh.h"
#include "mesh_guard.h"
#include "ply_properties.h"
#include "ply_reader.h"

#include <wavemesh/vcg_attributes.h>
#include <wavemesh/vcg_wmc.h>

#include <vcg/complex/algorithms/clean.h>

#include <wrap/io_trimesh/import_obj.h>
#include <wrap/io_trimesh/import_off.h>
#include <wrap/io_trimesh/import_ply.h>
#include <wrap/io_trimesh/import_stl.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <optional>

namespace wavemesh::tool {

namespace io = vcg::tri::io;

namespace {

/// VCGLib's importers report to a plain function.
ProgressLine* lineOfImport = nullptr;

bool showImport(const int percent, const char*)
{
	if (lineOfImport)
		lineOfImport->show(percent / 100.0);
	return true;
}

/// Text by VCGLib; binary here, because its importer looks for a colour beyond the end of its
/// buffer in every binary file. @pre whatIsWrongWithStl() found nothing
int importStl(FullMesh& m, const std::string& path)
{
	constexpr std::size_t kHead = 84, kFacet = 50, kNormal = 12;
	const Bytes file         = readFile(path);
	const std::size_t facets = file.size() < kHead ? 0 : (file.size() - kHead) / kFacet;
	std::uint32_t declared   = 0;
	if (file.size() >= kHead)
		std::memcpy(&declared, file.data() + kHead - 4, 4);
	if (file.size() < kHead || file.size() != kHead + kFacet * std::size_t {declared})
		return io::ImporterSTL<FullMesh>::OpenAscii(m, path.c_str(), showImport);
	MeshData data;
	for (std::size_t f = 0; f < facets; ++f) {
		const auto first = static_cast<std::uint32_t>(3 * f);
		data.triangles.push_back({first, first + 1, first + 2});
		for (std::size_t k = 0; k < 3; ++k) {
			float p[3];
			std::memcpy(p, file.data() + kHead + kFacet * f + kNormal + sizeof p * k, sizeof p);
			data.positions.push_back({p[0], p[1], p[2]});
		}
	}
	fromMeshData(data, m);
	return 0;
}

/// The importer of OBJ looks for materials in the working directory.
class InFolderOf
{
public:
	explicit InFolderOf(const std::string& path) : before_(std::filesystem::current_path())
	{
		const auto folder = std::filesystem::path(path).parent_path();
		if (!folder.empty())
			std::filesystem::current_path(folder);
	}
	~InFolderOf()
	{
		std::error_code ignored;
		std::filesystem::current_path(before_, ignored);
	}
	InFolderOf(const InFolderOf&)            = delete;
	InFolderOf& operator=(const InFolderOf&) = delete;

private:
	std::filesystem::path before_;
};

/// The importer of PLY gives a polygon's transparency and normal to the first triangle only.
void completePolygons(FullMesh& m)
{
	for (std::size_t f = 1; f < m.face.size(); ++f)
		if (m.face[f].IsF(0)) {
			m.face[f].C() = m.face[f - 1].C();
			m.face[f].N() = m.face[f - 1].N();
		}
}

/// A file's flags are those of another program: one of their bits would delete what has it.
void forgetFlags(FullMesh& m, bool hasPolygons)
{
	for (FullVertex& v : m.vert)
		v.Flags() = 0;
	for (FullFace& f : m.face)
		f.Flags() = hasPolygons ? f.Flags() & FullFace::FAUX012 : 0;
	m.vn = static_cast<int>(m.vert.size());
	m.fn = static_cast<int>(m.face.size());
}

/// What VCGLib's importer says: empty, or why the mesh is refused.
/// @param mask  [out] what the file has, bits of vcg::tri::io::Mask
std::string import(FullMesh& m, const std::string& path, Format format, int& mask)
{
	switch (format) {
	case Format::Ply: {
		// Never committed: removed at the end.
		std::optional<OutputFile> usual;
		if (const Bytes bytes = ply::withUsualTypes(readFile(path)); !bytes.empty()) {
			usual.emplace((std::filesystem::temp_directory_path() / "wmc.ply").string());
			usual->write(bytes.data(), bytes.size());
		}
		const std::string& read = usual ? usual->path() : path;
		const int error = io::ImporterPLY<FullMesh>::Open(m, read.c_str(), mask, showImport);
		forgetFlags(m, mask & io::Mask::IOM_BITPOLYGONAL);
		if (mask & io::Mask::IOM_BITPOLYGONAL)
			completePolygons(m);
		return error ? io::ImporterPLY<FullMesh>::ErrorMsg(error) : "";
	}
	case Format::Obj: {
		using Importer = io::ImporterOBJ<FullMesh>;
		const InFolderOf folder(path);
		const std::string name = std::filesystem::path(path).filename().string();
		const int error        = Importer::Open(m, name.c_str(), mask, showImport);
		// Faces left out are not the same mesh; without its materials it still is one.
		const bool refuse = Importer::ErrorCritical(error) ||
		                    error == Importer::E_VERTICES_WITH_SAME_IDX_IN_FACE ||
		                    error == Importer::E_LESS_THAN_3_VERT_IN_FACE;
		return refuse ? Importer::ErrorMsg(error) : "";
	}
	case Format::Off: {
		const int error = io::ImporterOFF<FullMesh>::Open(m, path.c_str(), mask, showImport);
		return error ? io::ImporterOFF<FullMesh>::ErrorMsg(error) : "";
	}
	case Format::Stl: {
		const int error = importStl(m, path);
		if (error)
			return io::ImporterSTL<FullMesh>::ErrorMsg(error);
		constexpr bool kRemoveDegenerate = false;
		vcg::tri::Clean<FullMesh>::RemoveDuplicateVertex(m, kRemoveDegenerate);
		return "";
	}
	case Format::Unknown:
		break;
	}
	return "only .ply, .obj, .off and .stl are read";
}

std::string whatIsWrong(const Bytes& file, Format format)
{
	switch (format) {
	case Format::Ply:
		return whatIsWrongWithPly(file);
	case Format::Obj:
		return whatIsWrongWithObj(file);
	case Format::Off:
		return whatIsWrongWithOff(file);
	case Format::Stl:
		return whatIsWrongWithStl(file);
	case Format::Unknown:
		break;
	}
	return "only .ply, .obj, .off and .stl are read";
}

/// The channels that a file has, of those that `m` has room for.
unsigned channelsIn(const FullMesh& m, int mask, Format format)
{
	using Mask                             = io::Mask;
	const std::pair<int, unsigned> names[] = {
	    {Mask::IOM_VERTCOLOR, kVertexColour},      {Mask::IOM_VERTNORMAL, kVertexNormal},
	    {Mask::IOM_VERTQUALITY, kVertexQuality},   {Mask::IOM_VERTRADIUS, kVertexRadius},
	    {Mask::IOM_VERTTEXCOORD, kVertexTexCoord}, {Mask::IOM_FACECOLOR, kFaceColour},
	    {Mask::IOM_FACENORMAL, kFaceNormal},       {Mask::IOM_FACEQUALITY, kFaceQuality},
	    {Mask::IOM_WEDGTEXCOORD, kWedgeTexCoord},  {Mask::IOM_BITPOLYGONAL, kFauxEdges}};
	unsigned channels = 0;
	for (const auto& [bit, channel] : names)
		if (mask & bit)
			channels |= channel;
	if (format == Format::Obj && (channels & kWedgeTexCoord)) // said to have both: the same ones
		channels &= ~unsigned(kVertexTexCoord);
	if (channels & (kVertexTexCoord | kWedgeTexCoord))
		channels |= kTextures;
	// An OBJ with materials is said to have colours even if none of them has one.
	const auto isFirst = [&](const FullFace& f) { return f.cC() == m.face[0].cC(); };
	if (format == Format::Obj && std::all_of(m.face.begin(), m.face.end(), isFirst))
		channels &= ~unsigned(kFaceColour);
	return channels;
}

/// As many as there is room for; the others are not read.
void addOwn(PlyProperties& own, unsigned channels, MeshData& mesh)
{
	constexpr std::size_t kMost = 64;
	for (Attribute& a : own.attributes) {
		const unsigned channel = a.kind == AttributeKind::Radius    ? kVertexRadius
		                         : a.kind == AttributeKind::Quality ? kVertexQuality
		                                                            : kCustom;
		if (!(channels & channel))
			continue;
		const bool ofFace      = a.of == AttributeOf::Face;
		const std::size_t rows = ofFace ? mesh.triangles.size() : mesh.positions.size();
		if (mesh.attributes.size() < kMost && a.name.size() < 256 &&
		    a.values.size() == rows * std::size_t(a.components))
			mesh.attributes.push_back(std::move(a));
		else
			own.notRead.push_back((ofFace ? "face '" : "vertex '") + a.name + "'");
	}
}

} // namespace

Format formatOf(const std::string& path)
{
	std::string e = std::filesystem::path(path).extension().string();
	std::transform(e.begin(), e.end(), e.begin(), [](char c) {
		return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
	});
	return e == ".ply"   ? Format::Ply
	       : e == ".obj" ? Format::Obj
	       : e == ".off" ? Format::Off
	       : e == ".stl" ? Format::Stl
	                     : Format::Unknown;
}

MeshData loadMesh(const std::string& path, unsigned channels, std::vector<std::string>* notRead)
{
	const Format format   = formatOf(path);
	const unsigned wanted = channels;
	MeshData mesh;
	PlyProperties own;
	std::vector<std::string> textures;
	{
		const Bytes file = readFile(path);
		if (file.empty())
			throw Failure(path + ": the file is empty");
		if (const std::string wrong = whatIsWrong(file, format); !wrong.empty())
			throw Failure(path + ": cannot be read as a mesh: " + wrong);
		if (format == Format::Ply && (channels & (kCustom | kVertexRadius | kVertexQuality)))
			own = readPlyProperties(file);
		if (format == Format::Ply)
			channels &= ~channelsNotToTake(file);
		if (ply::Head head; format == Format::Ply && ply::parseHead(file, head).empty())
			textures = ply::textureNames(file, head);
	}
	FullMesh m;
	ProgressLine line("reading " + path);
	lineOfImport            = &line;
	int mask                = 0;
	const std::string wrong = import(m, path, format, mask);
	lineOfImport            = nullptr;
	if (!wrong.empty())
		throw Failure(path + ": cannot be read as a mesh: " + wrong);
	mesh = toMeshData(m);
	addAttributes(m, channels & channelsIn(m, mask, format), mesh);
	addOwn(own, wanted, mesh);
	if (textures.size() == mesh.textures.size()) // VCGLib takes out blanks
		mesh.textures = textures;
	if (std::find(mesh.textures.begin(), mesh.textures.end(), "") != mesh.textures.end())
		own.notRead.push_back("the name of a texture");
	if (notRead)
		*notRead = own.notRead;
	// A PLY or OFF may say that it has none; in another file they were not understood.
	if (mesh.positions.empty() && format != Format::Ply && format != Format::Off)
		throw Failure(path + ": there are no vertices in it");
	return mesh;
}

} // namespace wavemesh::tool
