// SPDX-License-Identifier: GPL-3.0-or-later
// STL: corners of triangles, in 32-bit floats.
#include "failure.h"
#include "mesh_readers.h"
#include "text_lines.h"

#include <algorithm>
#include <cstring>
#include <map>

namespace wavemesh::tool {

namespace {

/// Corners of triangles in a row.
class Triangles
{
public:
	void add(const std::array<float, 3>& p)
	{
		// Bit patterns, of which -0 is 0: not-a-numbers are places too.
		std::array<std::uint32_t, 3> key;
		for (std::size_t k = 0; k < 3; ++k) {
			const float x = p[k] + 0.0f;
			std::memcpy(&key[k], &x, sizeof x);
		}
		const auto [it, isNew] = rowOf_.insert({key, std::uint32_t(mesh_.positions.size())});
		if (isNew)
			mesh_.positions.push_back({p[0], p[1], p[2]});
		if (corners_ % 3 == 0)
			mesh_.triangles.emplace_back();
		mesh_.triangles.back()[corners_++ % 3] = it->second;
	}
	bool isWhole() const { return corners_ % 3 == 0; }
	MeshData take() { return std::move(mesh_); }

private:
	MeshData mesh_;
	std::size_t corners_ = 0;
	std::map<std::array<std::uint32_t, 3>, std::uint32_t> rowOf_;
};

MeshData readBinary(const Bytes& file, std::size_t head, std::size_t facet)
{
	constexpr std::size_t kNormal = 12;
	Triangles out;
	for (std::size_t at = head; at < file.size(); at += facet)
		for (std::size_t k = 0; k < 3; ++k) {
			std::array<float, 3> p;
			std::memcpy(p.data(), file.data() + at + kNormal + sizeof p * k, sizeof p);
			out.add(p);
		}
	return out.take();
}

bool isWord(std::string_view word, std::string_view lowerCase)
{
	return std::equal(
	    word.begin(), word.end(), lowerCase.begin(), lowerCase.end(),
	    [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

MeshData readText(const Bytes& file)
{
	TextLines lines(file);
	Triangles out;
	bool isInside = false; // of a solid; its first line has a name, which may be any
	while (true) {
		const auto& words = lines.next();
		if (words.empty() && isInside)
			throw Failure("it ends before 'endsolid'");
		if (words.empty())
			return out.take();
		const bool isEnd = isWord(words[0], "endsolid");
		if ((isEnd || isWord(words[0], "endfacet")) && !out.isWhole())
			throw Failure(lines.where() + ": a facet that has not three corners");
		if (isEnd || isWord(words[0], "solid")) {
			isInside = !isEnd;
			continue;
		}
		for (std::size_t i = 0; i < words.size(); ++i) {
			if (!isWord(words[i], "vertex"))
				continue;
			std::array<float, 3> p {};
			for (std::size_t k = 0; k < 3; ++k) {
				double x = 0;
				if (i + k + 1 >= words.size() || !leadingNumber(words[i + k + 1], x))
					throw Failure(lines.where() + " is not a vertex");
				p[k] = float(x);
			}
			out.add(p);
		}
	}
}

} // namespace

MeshData readStl(const Bytes& file)
{
	constexpr std::size_t kHead = 84, kFacet = 50;
	std::uint32_t facets = 0;
	if (file.size() >= kHead)
		std::memcpy(&facets, file.data() + kHead - sizeof facets, sizeof facets);
	if (file.size() >= kHead && file.size() == kHead + kFacet * std::size_t {facets})
		return readBinary(file, kHead, kFacet);
	if (std::string(
	        file.begin(),
	        file.begin() + std::min<std::ptrdiff_t>(5, std::ptrdiff_t(file.size()))) != "solid" ||
	    std::any_of(file.begin(), file.end(), [](std::uint8_t c) { return c == 0 || c > 126; }))
		throw Failure("it is not text, and its length is not that of the facets it declares");
	return readText(file);
}

} // namespace wavemesh::tool
