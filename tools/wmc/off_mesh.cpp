// SPDX-License-Identifier: GPL-3.0-or-later
// OFF: [ST][C][N]OFF, counts, vertices, and a line for each face.
#include "failure.h"
#include "full_mesh.h"
#include "mesh_readers.h"
#include "text_lines.h"

#include <wavemesh/vcg_attributes.h>

#include <vcg/complex/algorithms/bitquad_support.h>

#include <wrap/io_trimesh/import_off.h>

namespace wavemesh::tool {

namespace {

using Words = std::vector<std::string_view>;

/// The colours that files name by a number.
class Palette : vcg::tri::io::ImporterOFF<FullMesh>
{
public:
	static constexpr long long kSize = 148;
	static vcg::Color4f at(long long i) { return ColorMap(static_cast<int>(i)); }
};

class OffMesh
{
public:
	OffMesh(const Bytes& file, unsigned channels) : lines_(file), channels_(channels) {}

	MeshData read(const Progress& progress)
	{
		readHead();
		for (long long v = 0; v < vertexCount_; ++v) {
			show(progress, v);
			readVertex();
		}
		if (vertexCount_ > 0 && at_ < words().size())
			throw Failure(lines_.where() + ": more coordinates than vertices");
		for (long long f = 0; f < faceCount_; ++f) {
			show(progress, f);
			readFace();
		}
		for (auto& [channel, a] :
		     {std::pair<unsigned, Attribute&> {kVertexColour, vertexColours_},
		      {kVertexNormal, normals_},
		      {kVertexTexCoord, places_},
		      {kFaceColour, faceColours_},
		      {kFauxEdges, inside_}})
			if (channels_ & has_ & channel)
				mesh_.attributes.push_back(std::move(a));
		return std::move(mesh_);
	}

private:
	using Kind = AttributeKind;

	const Words& words() const { return *words_; }

	void show(const Progress& progress, long long i) const
	{
		constexpr long long kOften = 1 << 14;
		if (i % kOften == 0 && progress)
			progress(lines_.fraction());
	}

	void readHead()
	{
		Words head = lines_.next();
		if (head.empty() || head[0].size() < 3 || head[0].substr(head[0].size() - 3) != "OFF")
			throw Failure("it does not begin with OFF");
		const std::string_view prefix = head[0].substr(0, head[0].size() - 3);
		if (prefix.find_first_of("4n") != prefix.npos)
			throw Failure("its vertices have other than three coordinates");
		hasColours_ = prefix.find('C') != prefix.npos;
		has_ |= prefix.find('N') != prefix.npos ? kVertexNormal : 0u;
		has_ |= prefix.find("ST") != prefix.npos ? kVertexTexCoord : 0u;
		head.erase(head.begin());
		if (head.empty())
			head = lines_.next();
		if (head.size() < 3 || !leadingInteger(head[0], vertexCount_) ||
		    !leadingInteger(head[1], faceCount_) || vertexCount_ < 0 || faceCount_ < 0)
			throw Failure("it does not tell how many vertices and faces it has");
	}

	/// Of a vertex; these may be on lines of their own.
	double number()
	{
		if (!words_ || at_ == words().size()) {
			words_ = &lines_.next();
			at_    = 0;
		}
		double x = 0;
		if (words().empty())
			throw Failure("it ends before its last vertex");
		if (!leadingNumber(words()[at_++], x))
			throw Failure(lines_.where() + " is not a vertex");
		return x;
	}

	void readVertex()
	{
		auto& p = mesh_.positions.emplace_back();
		for (double& x : p)
			x = number();
		for (int k = 0; (has_ & kVertexNormal) && k < 3; ++k)
			normals_.values.push_back(number());
		if (hasColours_) { // up to the end of the line
			const std::size_t n = words().size() - at_, more = has_ & kVertexTexCoord ? 2 : 0;
			if (n < more || n > more + 4)
				throw Failure(lines_.where() + " is not a vertex");
			has_ |= n > more ? kVertexColour : 0u;
			addColour(n - more, 1, vertexColours_);
			at_ += n - more;
		}
		for (int k = 0; (has_ & kVertexTexCoord) && k < 3; ++k)
			places_.values.push_back(k < 2 ? double(float(number())) : 0);
	}

	/// Of words from at_ on: a number of the palette, or red, green, blue and perhaps alpha, 0..255
	/// or, with a point, 0..1.
	void addColour(std::size_t count, std::size_t times, Attribute& to) const
	{
		std::array<double, 4> colour {255, 255, 255, 255};
		if (count == 1) {
			long long i = 0;
			(void)leadingInteger(words()[at_], i);
			if (i < 0 || i >= Palette::kSize)
				throw Failure(lines_.where() + ": a colour that does not exist");
			for (int k = 0; k < 4; ++k)
				colour[std::size_t(k)] = std::uint8_t(Palette::at(i)[k] * 255.0f);
		}
		else if (count == 3 || count == 4) {
			const bool isFraction = words()[at_].find('.') != words()[at_].npos;
			for (std::size_t k = 0; k < count; ++k) {
				long long whole = 0;
				double x        = 0;
				if (isFraction ? !leadingNumber(words()[at_ + k], x)
				               : !leadingInteger(words()[at_ + k], whole))
					throw Failure(lines_.where() + ": a colour that is no number");
				colour[k] = isFraction
				                ? vcg_detail::narrowed<std::uint8_t>(double(float(x) * 255.0f))
				                : std::uint8_t(whole);
			}
		}
		for (; times > 0; --times)
			to.values.insert(to.values.end(), colour.begin(), colour.end());
	}

	void readFace()
	{
		words_            = &lines_.next();
		long long corners = 0;
		if (words().empty())
			throw Failure("it ends before its last face");
		if (!leadingInteger(words()[0], corners) || corners < 3 ||
		    words().size() <= static_cast<std::size_t>(corners))
			throw Failure(lines_.where() + " is not a face");
		std::vector<std::uint32_t> face;
		for (at_ = 1; at_ <= static_cast<std::size_t>(corners); ++at_) {
			long long v = 0;
			if (!leadingInteger(words()[at_], v) || v < 0 || v >= vertexCount_)
				throw Failure(lines_.where() + ": a face refers to a vertex that does not exist");
			face.push_back(static_cast<std::uint32_t>(v));
		}
		if (face.size() == 4)
			turn(face);
		has_ |= face.size() > 3 ? kFauxEdges : 0u;
		for (std::size_t k = 1; k + 1 < face.size(); ++k) {
			mesh_.triangles.push_back({face[0], face[k], face[k + 1]});
			inside_.values.push_back(edgesInside(k, face.size()));
		}
		const std::size_t more = words().size() - at_;
		has_ |= more > 0 ? kFaceColour : 0u;
		addColour(more, face.size() - 2, faceColours_);
	}

	/// So that the better diagonal begins at the first corner; by VCGLib, which has it from the
	/// places, and does not take a diagonal twice.
	void turn(std::vector<std::uint32_t>& square)
	{
		using Squares = vcg::tri::BitQuad<FullMesh>;
		std::vector<FullVertex*> corners;
		if (placed_.empty()) {
			Squares::QuadTriangulate(corners); // forgets other meshes
			placed_.resize(mesh_.positions.size());
			for (std::size_t v = 0; v < placed_.size(); ++v)
				for (int k = 0; k < 3; ++k)
					placed_[v].P()[k] = mesh_.positions[v][std::size_t(k)];
		}
		for (const std::uint32_t v : square)
			corners.push_back(&placed_[v]);
		Squares::QuadTriangulate(corners);
		for (std::size_t k = 0; k < square.size(); ++k)
			square[k] = static_cast<std::uint32_t>(corners[k] - placed_.data());
	}

	TextLines lines_;
	const Words* words_ = nullptr;
	std::size_t at_     = 0;
	unsigned channels_;
	long long vertexCount_ = 0, faceCount_ = 0;
	unsigned has_    = 0;     ///< channels that there are
	bool hasColours_ = false; ///< any number of words of a vertex
	std::vector<FullVertex> placed_;
	Attribute vertexColours_ {AttributeOf::Vertex, Kind::Colour, NumberType::Integer, 4, {}, 0, {}};
	Attribute normals_ {AttributeOf::Vertex, Kind::Normal, NumberType::Double, 3, {}, 0, {}};
	Attribute places_ {AttributeOf::Vertex, Kind::TexCoord, NumberType::Double, 3, {}, 0, {}};
	Attribute faceColours_ {AttributeOf::Face, Kind::Colour, NumberType::Integer, 4, {}, 0, {}};
	Attribute inside_ {AttributeOf::Face, Kind::FauxEdges, NumberType::Integer, 1, {}, 0, {}};
	MeshData mesh_;
};

} // namespace

MeshData readOff(const Bytes& file, unsigned channels, const Progress& progress)
{
	return OffMesh(file, channels).read(progress);
}

} // namespace wavemesh::tool
