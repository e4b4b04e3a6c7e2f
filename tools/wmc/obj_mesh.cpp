// SPDX-License-Identifier: GPL-3.0-or-later
// OBJ, through VCGLib.
#include "failure.h"
#include "full_mesh.h"
#include "mesh_readers.h"
#include "text_lines.h"

#include <wavemesh/vcg_attributes.h>
#include <wavemesh/vcg_wmc.h>

#include <wrap/io_trimesh/import_obj.h>

#include <algorithm>
#include <filesystem>

namespace wavemesh::tool {

namespace {

/// VCGLib's importers report to a plain function.
const Progress* progressOfImport = nullptr;

bool showImport(const int percent, const char*)
{
	if (progressOfImport && *progressOfImport)
		(*progressOfImport)(percent / 100.0);
	return true;
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

/// The importer counts vertices by the look of raw lines before it reads them: an indented one is
/// read, and stored past the end. And it looks for the last character of an empty line after `\\`.
std::string whatIsWrongWithObjLines(const Bytes& file)
{
	const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
	std::uint64_t number = 0;
	bool wasJoined       = false;
	for (std::size_t at = 0; at <= text.size(); ++number) {
		const std::size_t end = std::min(text.find('\n', at), text.size());
		std::string_view line = text.substr(at, end - at);
		at                    = end + 1;
		if (wasJoined && (line.empty() || line == "\r"))
			return "line " + std::to_string(number) + " continues on an empty line";
		const std::size_t first = line.find_first_not_of(" \t\r");
		const bool isVertex     = first != line.npos && line[first] == 'v' &&
		                      (first + 1 == line.size() || line[first + 1] == ' ' ||
		                       line[first + 1] == '\t' || line[first + 1] == '\r');
		if (isVertex && (first > 0 || wasJoined))
			return "line " + std::to_string(number + 1) + ": a vertex must begin its line";
		if (!line.empty() && line.back() == '\r')
			line.remove_suffix(1);
		wasJoined = !line.empty() && line.back() == '\\';
	}
	return {};
}

/// Empty, or what is wrong: VCGLib would read outside its arrays, or not end.
std::string whatIsWrongWithObj(const Bytes& file)
{
	if (std::string s = whatIsWrongWithObjLines(file); !s.empty())
		return s;
	TextLines text(file);
	long long vertices = 0;
	double x           = 0;
	while (true) {
		const auto& words = text.next();
		if (words.empty())
			return {};
		if (words[0] == "v") {
			if (words.size() < 4 || !leadingNumber(words[1], x) || !leadingNumber(words[2], x) ||
			    !leadingNumber(words[3], x))
				return text.where() + " is not a vertex";
			++vertices;
		}
		const bool zeroBased = words[0] == "q";
		if (words[0] != "f" && !zeroBased)
			continue;
		if (words.size() < 4)
			return text.where() + ": a face with fewer than three corners";
		for (std::size_t i = 1; i < words.size(); ++i) {
			long long v = 0;
			if (!leadingInteger(words[i], v))
				return text.where() + " is not a face";
			v = zeroBased ? v : v > 0 ? v - 1 : v == 0 ? -1 : v + vertices;
			if (v < 0 || v >= vertices)
				return text.where() + ": a face refers to a vertex that does not exist";
		}
	}
}

/// The channels that a file has.
unsigned channelsIn(const FullMesh& m, int mask)
{
	using Mask                             = vcg::tri::io::Mask;
	const std::pair<int, unsigned> names[] = {
	    {Mask::IOM_VERTCOLOR, kVertexColour},
	    {Mask::IOM_VERTNORMAL, kVertexNormal},
	    {Mask::IOM_VERTTEXCOORD, kVertexTexCoord | kTextures},
	    {Mask::IOM_FACECOLOR, kFaceColour},
	    {Mask::IOM_FACENORMAL, kFaceNormal},
	    {Mask::IOM_WEDGTEXCOORD, kWedgeTexCoord | kTextures},
	    {Mask::IOM_BITPOLYGONAL, kFauxEdges}};
	unsigned channels = 0;
	for (const auto& [bit, channel] : names)
		if (mask & bit)
			channels |= channel;
	if (channels & kWedgeTexCoord) // said to have both: the same ones
		channels &= ~unsigned(kVertexTexCoord);
	// With materials it is said to have colours even if none of them has one.
	const auto isFirst = [&](const FullFace& f) { return f.cC() == m.face[0].cC(); };
	if (std::all_of(m.face.begin(), m.face.end(), isFirst))
		channels &= ~unsigned(kFaceColour);
	return channels;
}

} // namespace

MeshData
readObj(const Bytes& file, const std::string& path, unsigned channels, const Progress& progress)
{
	if (const std::string wrong = whatIsWrongWithObj(file); !wrong.empty())
		throw Failure(wrong);
	using Importer = vcg::tri::io::ImporterOBJ<FullMesh>;
	FullMesh m;
	int mask         = 0;
	progressOfImport = &progress;
	const InFolderOf folder(path);
	const std::string name = std::filesystem::path(path).filename().string();
	const int error        = Importer::Open(m, name.c_str(), mask, showImport);
	progressOfImport       = nullptr;
	// Faces left out are not the same mesh; without its materials it still is one.
	if (Importer::ErrorCritical(error) || error == Importer::E_VERTICES_WITH_SAME_IDX_IN_FACE ||
	    error == Importer::E_LESS_THAN_3_VERT_IN_FACE)
		throw Failure(Importer::ErrorMsg(error));
	MeshData mesh = toMeshData(m);
	addAttributes(m, channels & channelsIn(m, mask), mesh);
	return mesh;
}

} // namespace wavemesh::tool
