// SPDX-License-Identifier: GPL-3.0-or-later
// PLY: the head says which properties are columns of which attribute, then rows are read once.
#include "failure.h"
#include "mesh_readers.h"
#include "ply_names.h"

#include <wavemesh/vcg_attributes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>

namespace wavemesh::tool {
namespace {

using namespace ply;

/// An attribute while it is read.
struct Sink
{
	struct From
	{
		std::size_t property, column;
	};

	Group group;
	Attribute attribute;
	std::vector<From> from;
	bool isBroken = false; ///< a list that has other than three numbers somewhere

	/// @param corners  of the row's polygon that become a face; of other rows any
	void
	append(const std::vector<std::vector<double>>& row, const std::array<std::size_t, 3>& corners)
	{
		for (std::size_t k = 0; k < (group == kWedges ? 3 : 1); ++k) {
			const std::size_t at = attribute.values.size();
			attribute.values.resize(at + std::size_t(attribute.components));
			double* to = attribute.values.data() + at;
			if (group == kColour)
				to[3] = 255;
			for (const From& f : from)
				put(row[f.property], f.column, 2 * corners[k], to);
		}
	}

private:
	void put(const std::vector<double>& numbers, std::size_t column, std::size_t uv, double* to)
	{
		const auto components = std::size_t(attribute.components);
		if (group == kWedges && column == 0) // of a list that is too short, zeros
			for (std::size_t k = 0; k < 2; ++k)
				to[k] = uv + k < numbers.size() ? double(float(numbers[uv + k])) : 0;
		else if (group == kColour) // a text may have anything
			to[column] = vcg_detail::narrowed<std::uint8_t>(numbers[0]);
		else if (group == kTexture)
			to[column] = double(float(numbers[0]));
		else if (group == kOwn && numbers.size() != components)
			isBroken = true;
		else if (group == kOwn)
			std::copy(numbers.begin(), numbers.end(), to);
		else
			to[column] = numbers[0];
	}
};

std::vector<Sink> sinksOf(AttributeOf of, const Element& e)
{
	std::vector<Sink> sinks;
	for (std::size_t i = 0; i < e.properties.size(); ++i) {
		const Property& p = e.properties[i];
		if (find(e, p.name) != &p) // a second of the same name
			continue;
		const Known* k    = whatItIs(of, e, p);
		const Group group = k ? k->group : kOwn;
		auto s            = std::find_if(
		               sinks.begin(), sinks.end(), [&](const Sink& x) { return k && x.group == group; });
		if (s == sinks.end()) {
			s = sinks.insert(s, {group, attributeOf(of, group), {}});
			if (!k) {
				s->attribute.name       = p.name;
				s->attribute.components = p.isList ? 3 : 1;
				s->attribute.type       = !p.item.isFloating  ? NumberType::Integer
				                          : p.item.bytes == 4 ? NumberType::Float
				                                              : NumberType::Double;
			}
		}
		s->from.push_back({i, k ? k->column : 0});
	}
	return sinks;
}

bool isWholeNumber(double x)
{
	return std::abs(x) <= 9007199254740992.0 && x == std::floor(x);
}

constexpr std::size_t kMostAttributes = 64;

class PlyMesh
{
public:
	PlyMesh(
	    const Bytes& file,
	    unsigned channels,
	    std::vector<std::string>& notRead,
	    const Progress& progress) :
	        head_(parseHead(file)),
	        numbers_(file, head_), channels_(channels), notRead_(notRead), progress_(progress)
	{
	}

	MeshData read()
	{
		const Element* vertex = only("vertex");
		const Element* face   = only("face");
		if (!vertex || !isWhole(AttributeOf::Vertex, *vertex, kPlace))
			throw Failure("its vertices have no coordinates");
		vertices_ = double(vertex->number);
		// Else there are faces of a kind that a file with polygons has no need of.
		const bool hasFaces   = face && face->number > 0;
		const bool hasCorners = face && (isWhole(AttributeOf::Face, *face, kPlace) ||
		                                 isWhole(AttributeOf::Face, *face, kPlace, 1));
		for (const Element& e : head_.elements) {
			if (&e == vertex)
				readVertices(e);
			else if (&e == face && hasCorners)
				readFaces(e);
			else if (e.name == "tristrips" && !hasFaces && find(e, "vertex_indices"))
				readStrips(e);
			else if (e.name == "range_grid" && !hasFaces && find(e, "vertex_indices"))
				readGrid(e);
			else {
				readRows(e, [](const Row&) {});
				if (e.number > 0)
					dropped("element '" + e.name + "'");
			}
		}
		addAttributes();
		return std::move(mesh_);
	}

private:
	using Row = std::vector<std::vector<double>>;

	void dropped(const std::string& what)
	{
		if (channels_ & kCustom)
			notRead_.push_back(what);
	}
	void dropped(const Attribute& a, const std::string& what = "")
	{
		dropped((a.of == AttributeOf::Face ? "face " : "vertex ") + what + "'" + a.name + "'");
	}

	const Element* only(const char* name) const
	{
		const Element* found = nullptr;
		for (const Element& e : head_.elements)
			if (e.name == name) {
				if (found)
					throw Failure("its head is damaged");
				found = &e;
			}
		return found;
	}

	template <class Take>
	void readRows(const Element& e, Take take)
	{
		constexpr std::uint64_t kOften = 1 << 14;
		Row row;
		for (std::uint64_t i = 0; i < e.number; ++i) {
			if (i % kOften == 0 && progress_)
				progress_(numbers_.fraction());
			if (!numbers_.nextRow(e, row))
				throw Failure("it ends before its last " + e.name);
			take(row);
		}
	}

	std::uint32_t vertexOf(double index) const
	{
		if (!(index >= 0 && index < vertices_ && index == std::floor(index)))
			throw Failure("a face refers to a vertex that does not exist");
		return static_cast<std::uint32_t>(index);
	}

	/// What becomes of a row: attributes that are wanted, and what the mesh itself is made of.
	struct Sinks
	{
		std::vector<Sink::From> place;
		std::vector<Sink> wanted;
	};

	Sinks sinksFor(AttributeOf of, const Element& e)
	{
		Sinks sinks;
		for (Sink& s : sinksOf(of, e)) {
			if (s.group == kPlace)
				sinks.place = s.from;
			else if (channels_ & channelOf(of, s.group)) {
				if (s.group != kOwn ||
				    (sinks.wanted.size() < kMostAttributes && s.attribute.name.size() < 256))
					sinks.wanted.push_back(std::move(s));
				else
					dropped(s.attribute);
			}
		}
		return sinks;
	}

	void keep(std::vector<Sink> sinks)
	{
		std::move(sinks.begin(), sinks.end(), std::back_inserter(sinks_));
	}

	void readVertices(const Element& e)
	{
		Sinks sinks = sinksFor(AttributeOf::Vertex, e);
		readRows(e, [&](const Row& row) {
			auto& p = mesh_.positions.emplace_back();
			for (const Sink::From& f : sinks.place)
				p[f.column] = row[f.property][0];
			for (Sink& s : sinks.wanted)
				s.append(row, {});
		});
		keep(std::move(sinks.wanted));
	}

	/// A fan, of which each triangle has all that the polygon has.
	void readFaces(const Element& e)
	{
		Sinks sinks = sinksFor(AttributeOf::Face, e);
		Sink faux {kFaux, attributeOf(AttributeOf::Face, kFaux), {}};
		auto& inside = faux.attribute.values;
		readRows(e, [&](const Row& row) {
			const std::vector<double>& face = row[sinks.place[0].property];
			if (face.size() < 3)
				throw Failure("a face with " + std::to_string(face.size()) + " corners");
			for (std::size_t k = 1; k + 1 < face.size(); ++k) {
				mesh_.triangles.push_back(
				    {vertexOf(face[0]), vertexOf(face[k]), vertexOf(face[k + 1])});
				for (Sink& s : sinks.wanted)
					s.append(row, {0, k, k + 1});
				if (face.size() == 3)
					continue;
				inside.resize(mesh_.triangles.size());
				inside.back() = edgesInside(k, face.size());
			}
		});
		if (!inside.empty() && (channels_ & kFauxEdges)) {
			inside.resize(mesh_.triangles.size());
			sinks.wanted.push_back(std::move(faux));
		}
		keep(std::move(sinks.wanted));
	}

	/// Every corner but the first two makes a triangle; -1 begins a new strip.
	void readStrips(const Element& e)
	{
		const auto list = std::size_t(find(e, "vertex_indices") - e.properties.data());
		readRows(e, [&](const Row& row) {
			const std::vector<double>& strip = row[list];
			bool isOdd                       = false;
			for (std::size_t k = 0; k + 2 < strip.size(); ++k, isOdd = !isOdd) {
				if (strip[k + 2] == -1) {
					k += 2;
					isOdd = true; // so that the next is even
					continue;
				}
				std::array<std::uint32_t, 3> t {
				    vertexOf(strip[k]), vertexOf(strip[k + 1]), vertexOf(strip[k + 2])};
				if (isOdd)
					std::swap(t[0], t[1]);
				mesh_.triangles.push_back(t);
			}
		});
	}

	std::uint64_t numberInComment(const std::string& name) const
	{
		std::uint64_t number = 0;
		for (const std::string& comment : head_.comments) {
			std::istringstream words(comment);
			std::string key;
			if (words >> key && key == name)
				words >> number;
		}
		return number;
	}

	/// Of a scanner: lists with one vertex, or none where it saw nothing. Two triangles between
	/// four vertices, one between three.
	void readGrid(const Element& e)
	{
		const auto list = std::size_t(find(e, "vertex_indices") - e.properties.data());
		std::vector<double> grid;
		readRows(e, [&](const Row& row) { grid.push_back(row[list].empty() ? -1 : row[list][0]); });
		const std::uint64_t columns = numberInComment("num_cols");
		if (columns == 0 || grid.size() % columns != 0)
			return dropped("element '" + e.name + "'");
		const auto add = [&](double a, double b, double c) {
			if (a >= 0 && b >= 0 && c >= 0)
				mesh_.triangles.push_back({vertexOf(a), vertexOf(b), vertexOf(c)});
		};
		for (std::size_t i = 0; i + columns < grid.size(); ++i) {
			if ((i + 1) % columns == 0)
				continue;
			const double a = grid[i], b = grid[i + 1];
			const double c = grid[i + columns], d = grid[i + columns + 1];
			const std::size_t before = mesh_.triangles.size();
			add(d, c, a);
			add(a, b, d);
			if (mesh_.triangles.size() == before) { // cut along the other diagonal
				add(c, a, b);
				add(b, d, c);
			}
		}
	}

	void addTextures()
	{
		for (const std::string& comment : head_.comments) {
			std::istringstream words(comment);
			std::string key, name;
			if (!(words >> key) || key != "TextureFile")
				continue;
			std::getline(words >> std::ws, name); // blanks inside included
			mesh_.textures.push_back(name);
		}
	}

	void addAttributes()
	{
		std::stable_sort(sinks_.begin(), sinks_.end(), [](const Sink& a, const Sink& b) {
			const auto rank = [](const Sink& s) {
				return s.group == kOwn ? 99
				                       : s.group + (s.attribute.of == AttributeOf::Vertex ? 0 : 10);
			};
			return rank(a) < rank(b);
		});
		for (Sink& s : sinks_) {
			Attribute& a       = s.attribute;
			const bool ofFaces = a.of != AttributeOf::Vertex && !mesh_.triangles.empty();
			if (a.values.empty() && (s.group == kOwn || ofFaces)) // of no row, or of strips
				continue;
			if (s.isBroken || mesh_.attributes.size() == kMostAttributes) {
				dropped(a, s.isBroken ? "list " : "");
				continue;
			}
			// A text may have anything.
			if (s.group == kOwn && a.type == NumberType::Integer &&
			    !std::all_of(a.values.begin(), a.values.end(), isWholeNumber))
				a.type = NumberType::Double;
			mesh_.attributes.push_back(std::move(a));
		}
		if ((channels_ & kTextures) && (channelsOf(mesh_) & (kVertexTexCoord | kWedgeTexCoord)))
			addTextures();
	}

	Head head_;
	Numbers numbers_;
	unsigned channels_;
	std::vector<std::string>& notRead_;
	const Progress& progress_;
	double vertices_ = 0;
	std::vector<Sink> sinks_;
	MeshData mesh_;
};

} // namespace

MeshData readPly(
    const Bytes& file,
    unsigned channels,
    std::vector<std::string>& notRead,
    const Progress& progress)
{
	return PlyMesh(file, channels, notRead, progress).read();
}

} // namespace wavemesh::tool
