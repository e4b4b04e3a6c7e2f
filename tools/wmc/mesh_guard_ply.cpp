// SPDX-License-Identifier: GPL-3.0-or-later
// PLY: the head says what follows; walk through it all and look at the faces' indices.
#include "mesh_guard.h"
#include "ply_reader.h"

namespace wavemesh::tool {

namespace {

using namespace ply;

std::string checkFaceList(Numbers& numbers, const Property& p, double count, double vertices)
{
	// The importer keeps the count in a byte.
	if (!(count >= 3 && count <= 255))
		return "a face with " + std::to_string(static_cast<long long>(count)) + " corners";
	for (int i = 0; i < static_cast<int>(count); ++i) {
		double v = 0;
		if (!numbers.next(p.item, v))
			return "it ends before its last face";
		if (!(v >= 0 && v < vertices))
			return "a face refers to a vertex that does not exist";
	}
	return {};
}

} // namespace

std::string whatIsWrongWithPly(const Bytes& file)
{
	Head head;
	if (std::string s = parseHead(file, head); !s.empty())
		return s;
	Numbers numbers(file, head);
	double vertices = 0, count = 0;
	for (const Element& e : head.elements) {
		const std::string shortFile = "it ends before its last " + e.name;
		if (e.properties.empty() && e.number > 0)
			return "its head is damaged";
		for (std::uint64_t i = 0; i < e.number; ++i)
			for (const Property& p : e.properties) {
				if (!p.isList) {
					if (!numbers.skip(1, p.item))
						return shortFile;
					continue;
				}
				if (!numbers.next(p.count, count) || !(count >= 0))
					return shortFile;
				if (isFaceList(e, p)) {
					if (std::string s = checkFaceList(numbers, p, count, vertices); !s.empty())
						return s;
				}
				else if (!numbers.skip(static_cast<std::uint64_t>(count), p.item))
					return shortFile;
			}
		if (e.name == "vertex")
			vertices = static_cast<double>(e.number);
	}
	return {};
}

} // namespace wavemesh::tool
