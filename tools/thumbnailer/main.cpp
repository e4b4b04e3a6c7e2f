// SPDX-License-Identifier: GPL-3.0-or-later
// wmc-thumbnailer FILE.wmc PICTURE.png [--size N]: for file managers, which call it with a file and
// the name of the picture to write. Exit codes: 0 fine; 1 no picture; 2 usage.
#include "coarse_level.h"
#include "mesh_picture.h"

#include <QFile>
#include <QSaveFile>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>

namespace {

constexpr int kUsage = 2;

int usage()
{
	std::fprintf(
	    stderr, "usage: wmc-thumbnailer FILE.wmc PICTURE.png [--size N]\n"
	            "Draws a coarse level, from the first bytes of the file; N pixels, 16 to 2048 "
	            "(256).\n");
	return kUsage;
}

int fail(const std::string& file, const std::string& why)
{
	std::fprintf(stderr, "wmc-thumbnailer: %s: %s\n", file.c_str(), why.c_str());
	return 1;
}

int run(const char* file, const char* picture, int size)
{
	const auto level = wavemesh::readCoarseLevel(file);
	if (!level.hasValue())
		return fail(file, level.status().what);
	if (level->mesh.triangles.empty())
		return fail(file, "the mesh has no faces");
	QSaveFile out(QFile::decodeName(picture));
	if (!out.open(QIODevice::WriteOnly) ||
	    !wavemesh::pictureOf(level->mesh, size).save(&out, "PNG") || !out.commit())
		return fail(picture, "cannot be written");
	return 0;
}

} // namespace

int main(int argc, char** argv)
{
	long size = 256;
	const char* names[2];
	int given = 0;
	for (int i = 1; i < argc; ++i) {
		if (std::strcmp(argv[i], "--size") == 0 && i + 1 < argc) {
			char* end = nullptr;
			size      = std::strtol(argv[++i], &end, 10);
			if (*end != '\0')
				return usage();
		}
		else if (given < 2 && argv[i][0] != '-')
			names[given++] = argv[i];
		else
			return usage();
	}
	if (given != 2 || size < 16 || size > 2048)
		return usage();
	try {
		return run(names[0], names[1], int(size));
	}
	catch (const std::exception& e) {
		return fail(names[0], e.what());
	}
}
