// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_files.h"

#include "console.h"
#include "failure.h"
#include "file_io.h"
#include "mesh_guard.h"
#include "vcg_mesh.h"

#include <wavemesh/vcg_wmc.h>

#include <vcg/complex/algorithms/clean.h>

#include <wrap/io_trimesh/export_ply.h>
#include <wrap/io_trimesh/export_stl.h>
#include <wrap/io_trimesh/import_obj.h>
#include <wrap/io_trimesh/import_off.h>
#include <wrap/io_trimesh/import_ply.h>
#include <wrap/io_trimesh/import_stl.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <filesystem>

namespace wavemesh::tool {

namespace io = vcg::tri::io;

namespace {

enum class Format { Ply, Obj, Off, Stl, Unknown };

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
int importStl(VcgMesh& m, const std::string& path)
{
	constexpr std::size_t kHead = 84, kFacet = 50, kNormal = 12;
	const Bytes file         = readFile(path);
	const std::size_t facets = file.size() < kHead ? 0 : (file.size() - kHead) / kFacet;
	std::uint32_t declared   = 0;
	if (file.size() >= kHead)
		std::memcpy(&declared, file.data() + kHead - 4, 4);
	if (file.size() < kHead || file.size() != kHead + kFacet * std::size_t {declared})
		return io::ImporterSTL<VcgMesh>::OpenAscii(m, path.c_str(), showImport);
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

/// What VCGLib's importer says: empty, or why the mesh is refused.
std::string import(VcgMesh& m, const std::string& path, Format format)
{
	int mask = 0;
	switch (format) {
	case Format::Ply: {
		const int error = io::ImporterPLY<VcgMesh>::Open(m, path.c_str(), mask, showImport);
		return error ? io::ImporterPLY<VcgMesh>::ErrorMsg(error) : "";
	}
	case Format::Obj: {
		using Importer  = io::ImporterOBJ<VcgMesh>;
		const int error = Importer::Open(m, path.c_str(), mask, showImport);
		// Faces left out are not the same mesh; materials are none of our business.
		const bool refuse = Importer::ErrorCritical(error) ||
		                    error == Importer::E_VERTICES_WITH_SAME_IDX_IN_FACE ||
		                    error == Importer::E_LESS_THAN_3_VERT_IN_FACE;
		return refuse ? Importer::ErrorMsg(error) : "";
	}
	case Format::Off: {
		const int error = io::ImporterOFF<VcgMesh>::Open(m, path.c_str(), mask, showImport);
		return error ? io::ImporterOFF<VcgMesh>::ErrorMsg(error) : "";
	}
	case Format::Stl: {
		const int error = importStl(m, path);
		if (error)
			return io::ImporterSTL<VcgMesh>::ErrorMsg(error);
		vcg::tri::Clean<VcgMesh>::RemoveDuplicateVertex(m);
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

/// OBJ and OFF, each number with as many digits as give it back exactly (VCGLib writes 16).
class TextMesh
{
public:
	explicit TextMesh(OutputFile& out) : out_(out) {}
	~TextMesh() = default;

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

void writeObj(const MeshData& mesh, OutputFile& out)
{
	TextMesh text(out);
	for (const auto& p : mesh.positions)
		text << "v " << p[0] << " " << p[1] << " " << p[2] << "\n";
	for (const auto& t : mesh.triangles)
		text << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
	text.flush();
}

void writeOff(const MeshData& mesh, OutputFile& out)
{
	TextMesh text(out);
	text << "OFF\n" << mesh.positions.size() << " " << mesh.triangles.size() << " 0\n";
	for (const auto& p : mesh.positions)
		text << p[0] << " " << p[1] << " " << p[2] << "\n";
	for (const auto& t : mesh.triangles)
		text << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
	text.flush();
}

/// PLY and STL by VCGLib. Its exporters do not see a disk that is full when they close the file:
/// the length tells.
void writeBinary(const MeshData& mesh, const OutputFile& out, bool isStl)
{
	VcgMesh m;
	fromMeshData(mesh, m);
	const int error  = isStl ? io::ExporterSTL<VcgMesh>::Save(m, out.path().c_str())
	                         : io::ExporterPLY<VcgMesh>::Save(m, out.path().c_str(), 0, true);
	std::size_t want = 84 + 50 * mesh.triangles.size();
	if (!isStl) {
		const Bytes head = readFile(out.path(), 4096);
		const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
		const auto end = text.find("end_header\n");
		want           = (end == text.npos ? 0 : end + 11) + mesh.positions.size() * 24 +
		       mesh.triangles.size() * 13;
	}
	if (error || fileSize(out.path()) != want)
		throw Failure("the mesh could not be written whole; is the disk full?");
}

} // namespace

MeshData loadMesh(const std::string& path)
{
	const Format format = formatOf(path);
	MeshData mesh;
	{
		const Bytes file = readFile(path);
		if (file.empty())
			throw Failure(path + ": the file is empty");
		if (const std::string wrong = whatIsWrong(file, format); !wrong.empty())
			throw Failure(path + ": cannot be read as a mesh: " + wrong);
	}
	VcgMesh m;
	ProgressLine line("reading " + path);
	lineOfImport            = &line;
	const std::string wrong = import(m, path, format);
	lineOfImport            = nullptr;
	if (!wrong.empty())
		throw Failure(path + ": cannot be read as a mesh: " + wrong);
	mesh = toMeshData(m);
	if (mesh.positions.empty())
		throw Failure(path + ": there are no vertices in it");
	return mesh;
}

void checkMeshFormat(const std::string& path)
{
	if (formatOf(path) == Format::Unknown)
		throw UsageError(path + ": only .ply, .obj, .off and .stl can be written");
}

void saveMesh(const MeshData& mesh, const std::string& path)
{
	checkMeshFormat(path);
	const Format format = formatOf(path);
	OutputFile out(path);
	if (format == Format::Obj)
		writeObj(mesh, out);
	else if (format == Format::Off)
		writeOff(mesh, out);
	else
		writeBinary(mesh, out, format == Format::Stl);
	out.commit();
}

} // namespace wavemesh::tool
