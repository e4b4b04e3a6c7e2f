// SPDX-License-Identifier: GPL-3.0-or-later
// OBJ, and the materials beside it. What a file means is decided as VCGLib does.
#include "failure.h"
#include "mesh_readers.h"
#include "text_lines.h"

#include <wavemesh/vcg_attributes.h>

#include <algorithm>
#include <filesystem>

namespace wavemesh::tool {

namespace {

using Words  = std::vector<std::string_view>;
using Colour = std::array<double, 4>;

struct Material
{
	std::string name;
	Colour colour {255, 255, 255, 255};
	double texture = -1;
};

/// Blanks inside included.
std::string afterFirst(const Words& words)
{
	const char* end = words.back().data() + words.back().size();
	return words.size() < 2 ? std::string() : std::string(words[1].data(), end);
}

double byteOf(double x)
{
	return vcg_detail::narrowed<std::uint8_t>(x);
}

class ObjMesh
{
public:
	ObjMesh(const Bytes& file, const std::string& path, unsigned channels) :
	        lines_(file), path_(path), channels_(channels)
	{
	}

	MeshData read(const Progress& progress)
	{
		constexpr std::uint64_t kOften = 1 << 14;
		for (std::uint64_t i = 0;; ++i) {
			if (i % kOften == 0 && progress)
				progress(lines_.fraction());
			const Words& words = lines_.next();
			if (words.empty())
				break;
			if (words[0] == "v")
				readVertex(words);
			else if (words[0] == "vt")
				readNumbers<2>(words, places_);
			else if (words[0] == "vn")
				readNumbers<3>(words, normals_);
			else if (words[0] == "f" || words[0] == "q")
				readFace(words, words[0] == "q");
			else if (words[0] == "mtllib" && words.size() > 1)
				readMaterials(std::filesystem::path(path_).parent_path() / afterFirst(words));
			else if (words[0] == "usemtl" && words.size() > 1)
				useMaterial(afterFirst(words));
		}
		addAttributes();
		return std::move(mesh_);
	}

private:
	using Kind = AttributeKind;

	/// What is right of a face's corner, from 0; range checked when all is read.
	struct Corner
	{
		long long vertex, place = 0, normal;
	};

	template <std::size_t n>
	void readNumbers(const Words& words, std::vector<std::array<double, n>>& to) const
	{
		auto& row = to.emplace_back();
		for (std::size_t k = 0; k < n; ++k)
			if (k + 1 >= words.size() || !leadingNumber(words[k + 1], row[k]))
				throw Failure(
				    lines_.where() + " is not " + (words[0] == "v" ? "a vertex" : "whole"));
	}

	/// Perhaps with a colour, 0..1 or 0..255; the first vertex tells.
	void readVertex(const Words& words)
	{
		readNumbers<3>(words, mesh_.positions);
		if (mesh_.positions.size() == 1)
			hasColours_ = words.size() >= 7;
		Colour colour = colour_;
		if (words.size() >= 7) {
			Colour x {0, 0, 0, 1};
			for (std::size_t k = 0; k < 4 && k + 4 < words.size(); ++k)
				(void)leadingNumber(words[k + 4], x[k]);
			const double scale = x[0] <= 1 && x[1] <= 1 && x[2] <= 1 ? 255 : 1;
			for (std::size_t k = 0; k < 4; ++k)
				colour[k] = byteOf(x[k] * scale);
		}
		vertexColours_.values.insert(vertexColours_.values.end(), colour.begin(), colour.end());
	}

	/// From 1 on, or from behind; of what is not written, `other`.
	static long long index(std::string_view word, std::size_t count, long long other)
	{
		long long i = 0;
		if (!leadingInteger(word, i))
			return other;
		return i > 0 ? i - 1 : i == 0 ? -1 : i + static_cast<long long>(count);
	}

	Corner cornerOf(std::string_view word, bool isZeroBased) const
	{
		const auto part = [&] {
			const std::size_t end       = std::min(word.find('/'), word.size());
			const std::string_view left = word.substr(0, end);
			word.remove_prefix(std::min(end + 1, word.size()));
			return left;
		};
		Corner c {};
		const std::string_view vertex = part(), place = part(), normal = part();
		if (!leadingInteger(vertex, c.vertex))
			throw Failure(lines_.where() + " is not a face");
		if (!isZeroBased)
			c.vertex = index(vertex, mesh_.positions.size(), 0);
		if (c.vertex < 0 || c.vertex >= static_cast<long long>(mesh_.positions.size()))
			throw Failure(lines_.where() + ": a face refers to a vertex that does not exist");
		c.place  = index(place, places_.size(), 0);
		c.normal = index(normal, normals_.size(), c.vertex);
		return c;
	}

	/// A polygon is a fan. With `q` a square, its vertices from 0 on.
	void readFace(const Words& words, bool isZeroBased)
	{
		const std::size_t n = words.size() - 1;
		if (n < 3 || (isZeroBased && n != 4))
			throw Failure(lines_.where() + ": a face with " + std::to_string(n) + " corners");
		std::vector<Corner> face;
		for (std::size_t i = 1; i <= n; ++i)
			face.push_back(cornerOf(words[i], isZeroBased));
		hasPolygons_ = hasPolygons_ || n > 3;
		for (std::size_t k = 1; k + 1 < n; ++k) {
			auto& t = mesh_.triangles.emplace_back();
			for (std::size_t i = 0; i < 3; ++i) {
				corners_.push_back(face[i == 0 ? 0 : k + i - 1]);
				t[i] = static_cast<std::uint32_t>(corners_.back().vertex);
			}
			if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
				throw Failure(lines_.where() + ": a face that has a vertex twice");
			inside_.values.push_back(edgesInside(k, n));
			textures_.push_back(materials_[material_].texture);
			faceColours_.values.insert(faceColours_.values.end(), colour_.begin(), colour_.end());
		}
	}

	/// Those of one file take the place of others; without it the mesh is the same.
	void readMaterials(const std::filesystem::path& path)
	{
		Bytes file;
		try {
			file = readFile(path.string());
		}
		catch (const Failure&) {
			return;
		}
		auto& textures = mesh_.textures;
		TextLines lines(file);
		materials_.assign(1, {});
		for (bool isFirst = true;;) {
			const Words& words = lines.next();
			if (words.empty())
				break;
			if (words[0] == "newmtl") {
				if (!isFirst)
					materials_.emplace_back();
				isFirst                = false;
				materials_.back().name = afterFirst(words);
			}
			else if (words[0] == "Kd" && words.size() >= 4)
				for (std::size_t k = 0; k < 3; ++k) {
					double x = 0;
					(void)leadingNumber(words[k + 1], x);
					materials_.back().colour[k] = byteOf(double(float(x)) * 255);
				}
			else if (words[0] == "map_Kd") {
				const std::string name(words.size() == 2 ? words[1] : ""); // else options
				const auto known          = std::find(textures.begin(), textures.end(), name);
				materials_.back().texture = double(known - textures.begin());
				if (known == textures.end())
					textures.push_back(name);
			}
		}
		for (Material& m : materials_)
			if (!textures.empty() && (m.texture < 0 || textures[std::size_t(m.texture)].empty()))
				m.texture = 0;
		material_ = std::min(material_, materials_.size() - 1);
	}

	static std::size_t checked(long long index, std::size_t count, const char* what)
	{
		if (index < 0 || index >= static_cast<long long>(count))
			throw Failure(std::string("a face refers to a ") + what + " that does not exist");
		return static_cast<std::size_t>(index);
	}

	/// Of each vertex; there are as many.
	void addNormals()
	{
		vertexNormals_.values.assign(3 * mesh_.positions.size(), 0);
		for (const Corner& c : corners_) {
			const auto& n = normals_[checked(c.normal, normals_.size(), "normal")];
			std::copy(
			    n.begin(), n.end(), vertexNormals_.values.begin() + std::ptrdiff_t(3 * c.vertex));
		}
	}

	void addPlaces()
	{
		for (std::size_t i = 0; i < corners_.size(); ++i) {
			const auto& p =
			    places_[checked(corners_[i].place, places_.size(), "texture coordinate")];
			for (const double x : {double(float(p[0])), double(float(p[1])), textures_[i / 3]})
				wedges_.values.push_back(x);
		}
	}

	void useMaterial(const std::string& name)
	{
		if (materials_.size() == 1 && materials_[0].name.empty()) // a file of the same name
			readMaterials(std::filesystem::path(path_).replace_extension(".mtl"));
		const auto found =
		    std::find_if(materials_.begin(), materials_.end(), [&](const Material& m) {
			    return m.name == name;
		    });
		material_ = found == materials_.end() ? 0 : std::size_t(found - materials_.begin());
		if (found != materials_.end())
			colour_ = found->colour;
	}

	void addAttributes()
	{
		// Without materials all are grey.
		const auto& colours = faceColours_.values;
		bool isOneColour    = true;
		for (std::size_t i = 4; i < colours.size() && isOneColour; ++i)
			isOneColour = colours[i] == colours[i - 4];
		const auto add = [&](bool has, unsigned channel, Attribute& a) {
			if (has && (channels_ & channel))
				mesh_.attributes.push_back(std::move(a));
		};
		const bool hasNormals = !normals_.empty() && normals_.size() == mesh_.positions.size();
		if (hasNormals)
			addNormals();
		if (!places_.empty())
			addPlaces();
		if (places_.empty() || !(channels_ & kTextures))
			mesh_.textures.clear();
		add(hasColours_, kVertexColour, vertexColours_);
		add(hasNormals, kVertexNormal, vertexNormals_);
		add(!isOneColour, kFaceColour, faceColours_);
		add(hasPolygons_, kFauxEdges, inside_);
		add(!places_.empty(), kWedgeTexCoord, wedges_);
	}

	TextLines lines_;
	std::string path_;
	unsigned channels_;
	std::vector<std::array<double, 2>> places_;
	std::vector<std::array<double, 3>> normals_;
	std::vector<Corner> corners_;  ///< 3 a triangle
	std::vector<double> textures_; ///< of triangles
	std::vector<Material> materials_ {{"", {255, 255, 255, 255}, 0}};
	std::size_t material_ = 0;
	Colour colour_ {192, 192, 192, 255}; ///< of the material, or grey
	bool hasColours_ = false, hasPolygons_ = false;
	Attribute vertexColours_ =
	    vcg_detail::attribute(AttributeOf::Vertex, Kind::Colour, NumberType::Integer, 4);
	Attribute vertexNormals_ =
	    vcg_detail::attribute(AttributeOf::Vertex, Kind::Normal, NumberType::Double, 3);
	Attribute faceColours_ =
	    vcg_detail::attribute(AttributeOf::Face, Kind::Colour, NumberType::Integer, 4);
	Attribute inside_ =
	    vcg_detail::attribute(AttributeOf::Face, Kind::FauxEdges, NumberType::Integer, 1);
	Attribute wedges_ =
	    vcg_detail::attribute(AttributeOf::Corner, Kind::TexCoord, NumberType::Double, 3);
	MeshData mesh_;
};

} // namespace

MeshData
readObj(const Bytes& file, const std::string& path, unsigned channels, const Progress& progress)
{
	return ObjMesh(file, path, channels).read(progress);
}

} // namespace wavemesh::tool
