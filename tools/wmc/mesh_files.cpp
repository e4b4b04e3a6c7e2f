// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh_files.h"

#include "console.h"
#include "failure.h"
#include "file_io.h"
#include "mesh_readers.h"

#include <algorithm>
#include <filesystem>

namespace wavemesh::tool {

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
	const Bytes file = readFile(path);
	if (file.empty())
		throw Failure(path + ": the file is empty");
	ProgressLine line("reading " + path);
	const Progress progress = line.callback();
	std::vector<std::string> ignored;
	const auto read = [&] {
		switch (formatOf(path)) {
		case Format::Ply:
			return readPly(file, channels, notRead ? *notRead : ignored, progress);
		case Format::Obj:
			return readObj(file, path, channels, progress);
		case Format::Off:
			return readOff(file, channels, progress);
		case Format::Stl:
			return readStl(file);
		case Format::Unknown:
			break;
		}
		throw Failure("only .ply, .obj, .off and .stl are read");
	};
	MeshData mesh;
	try {
		mesh = read();
	}
	catch (const Failure& f) {
		throw Failure(path + ": cannot be read as a mesh: " + f.what());
	}
	if (notRead && std::find(mesh.textures.begin(), mesh.textures.end(), "") != mesh.textures.end())
		notRead->push_back("the name of a texture");
	// A PLY or OFF may say that it has none; in another file they were not understood.
	const Format format = formatOf(path);
	if (mesh.positions.empty() && format != Format::Ply && format != Format::Off)
		throw Failure(path + ": there are no vertices in it");
	return mesh;
}

} // namespace wavemesh::tool
