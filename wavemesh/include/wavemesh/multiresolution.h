// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The hierarchy of a mesh in the mesh's own numbering, and the wavelet transform over it in
/// floating point: for filters that change or show the details of a mesh whose connectivity and
/// order of vertices are to stay.
///
/// The levels are those that encode() would make with the same options, the transform is that of
/// docs/algorithm.md without its rounding. Files come from encode(), not from here.
#pragma once

#include <wavemesh/codec.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace wavemesh {

/// A point, a displacement or a detail, model units.
using Vec3 = std::array<double, 3>;

struct MultiresolutionOptions
{
	int lifting         = 0;       ///< as in EncodeOptions
	Wgc wgc             = Wgc::On; ///< Auto is On: there is no file to be smaller
	double wgcSharpness = 0.3;
	double wgcDeviation = 0.25;
	Progress progress;
};

/// The levels of one mesh. Every vertex of the mesh is *born* at one level, as a child of two
/// parents (or of three: a centre, docs/algorithm.md sec. 3), or belongs to the base mesh, level 0.
/// Copies share the hierarchy.
class Multiresolution
{
public:
	static constexpr std::uint32_t kNoParent = ~std::uint32_t {0};

	/// Makes the levels of `mesh`.
	/// @return the levels; Unsupported for what is no oriented manifold, isolated vertices, or no
	///         faces at all; InvalidArgument, LimitExceeded, Cancelled, OutOfMemory. Linear.
	static Result<Multiresolution>
	of(const MeshData& mesh, const MultiresolutionOptions& options = {});

	int finestLevel() const;
	std::size_t vertexCount() const;          ///< #V, of the mesh
	std::size_t vertexCount(int level) const; ///< level 0..finestLevel()

	/// #V, 0..finestLevel(): the coarsest level that has the vertex.
	const std::vector<int>& birth() const;
	/// #V by 3, rows of the mesh: parents[2] is kNoParent but for a centre; all three are, of a
	/// vertex of the base mesh.
	const std::vector<std::array<std::uint32_t, 3>>& parents() const;
	/// #V by 3, unit length or 0: of the next coarser level's surface where the vertex is
	/// predicted; for a vertex of the base mesh, of that.
	const std::vector<Vec3>& normals() const;

	/// Wavelet analysis in place: of what a vertex carries, positions for instance, its detail
	/// remains; at the vertices of the base mesh, what the base mesh carries. Linear map.
	/// @param values  [in,out] #V by 3
	void analyse(std::vector<Vec3>& values) const;
	/// The inverse of analyse(), but for rounding.
	void synthesise(std::vector<Vec3>& values) const;

private:
	struct Levels;
	explicit Multiresolution(std::shared_ptr<const Levels> levels) : levels_(std::move(levels)) {}
	std::shared_ptr<const Levels> levels_;
};

enum class DetailMeasure {
	Length, ///< of the detail, model units
	Normal, ///< of its component along normals(), with sign, model units
	Birth,  ///< level of birth
};

/// #V: 0 for the vertices of the base mesh, which have no detail.
/// @param positions  #V by 3, of the mesh
std::vector<double> measureDetails(
    const Multiresolution& levels, const std::vector<Vec3>& positions, DetailMeasure measure);

} // namespace wavemesh
