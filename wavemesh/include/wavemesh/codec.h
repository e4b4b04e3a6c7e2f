// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Encoder and decoder of `.wmc`: a coarse base mesh and the refinements that lead back to the
/// original. The file format is docs/wmc_format.md; the method is docs/algorithm.md.
///
/// Level 0 is the base mesh, the coarsest; the last level is the finest, the original on its
/// lattice. Bits per vertex (bpv) always count the vertices of the original.
///
/// Threads: there is no shared state. Any functions may run at the same time, one Decoder in one
/// thread at a time; its const members in any number of threads, as long as nothing advances it.
/// Progress is called in the caller's own thread, before the function returns.
#pragma once

#include <wavemesh/mesh_data.h>
#include <wavemesh/status.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace wavemesh {

/// Called now and then with the fraction of the time, about, that has passed, 0..1. Returns false
/// to cancel. May be empty.
using Progress = std::function<bool(double fraction)>;

enum class Mode : std::uint8_t {
	Classic = 0, ///< the paper: every refinement is a split at full precision
	Compact = 1, ///< smaller: positions get more precise as the mesh gets denser
};

/// Wavelet geometrical criterion of the paper, sec. III: may a sharp vertex be removed?
enum class Wgc : std::uint8_t {
	Off  = 0, ///< geometry-blind coarsening
	On   = 1,
	Auto = 2, ///< both are encoded and the smaller file is kept where that is worth the time:
	          ///< Optimize::Size in classic mode or with effort 3; and below 4096 vertices, unless
	          ///< Optimize::Levels, where the ways of all three aims compete; else Off
};

/// What the choice of the vertices that each step removes is good for. Sizes and errors of all
/// three: README.
enum class Optimize : std::uint8_t {
	Size     = 0, ///< the smallest file: connectivity decides, with wgc as the paper has it
	Balanced = 1, ///< coarse levels closer to the original, for up to 3 % more bytes than Size
	              ///< at the same effort: the finest step as with Size, the others remove what
	              ///< makes the smallest errors
	Levels = 2,   ///< the smallest error at any low rate: all steps so, and positions are precise
	              ///< early; wgc does not matter
};

/// Lifting is off: the lazy filter bank, configuration I of the paper.
constexpr int kLiftingOff = -1;

struct EncodeOptions
{
	Mode mode = Mode::Compact;
	/// What encoding and decoding may cost, 1..3. 1 is the fastest: the contexts of connectivity
	/// are fewer, and a compact file becomes a classic one without lifting. 2 chooses a schedule by
	/// a look at the mesh, but tries up to 14 below 4096 vertices, and 5 below 16384 to be sure of
	/// what Balanced promises; 3 encodes in 6 to 104 ways. Decoding costs about 1, 6 and 9
	/// microseconds a vertex of the original at 12 bits, and up to 4, 20 and 35 at 24.
	int effort = 2;

	/// Bits per coordinate over the largest extent of the bounding box, 1..24 (2^bits - 1 steps).
	int bits = 12;
	/// Lattice step in model units. If > 0 it is used in place of `bits`; the largest extent must
	/// be below 2^24 steps.
	double step = 0;

	/// Classic: kLiftingOff, or the k of the k-disc support of the update, 0..2 (paper sec. V.B).
	int lifting = 0;

	Optimize optimize = Optimize::Balanced;

	Wgc wgc = Wgc::Auto;
	/// A vertex is sharp if an incident dihedral has |n1 x n2| above this. 0..1.
	double wgcSharpness = 0.3;
	/// A sharp vertex may become a child only if its detail, across the parents' edge and relative
	/// to that edge's length, is below this. > 0.
	double wgcDeviation = 0.25;

	/// The decoded mesh has the original's order of vertices and faces, and each face its first
	/// corner.
	bool keepOrder = false;
	/// The decoded mesh has the bit pattern of every coordinate, not-a-numbers and infinities too.
	bool exact = false;

	Progress progress;
};

/// Is a classic file made, whatever the mode asked for?
inline bool isWrittenClassic(const EncodeOptions& options)
{
	return options.mode == Mode::Classic || options.effort == 1;
}

enum class LevelKind : std::uint8_t {
	Base    = 0, ///< the coarsest mesh
	Split   = 1, ///< one subdivision step
	Precise = 2, ///< more bits for every position; the same vertices and faces
};

/// One row of the level table in the file's head.
struct LevelInfo
{
	LevelKind kind         = LevelKind::Base;
	std::uint32_t vertices = 0; ///< of the finest level: the original's
	std::uint32_t faces    = 0;
	/// What this level adds to the file; the levels' sum is the file size. The finest one's include
	/// what StreamFeatures lists.
	std::uint64_t bytes = 0;
	/// Length of the shortest prefix of the file that holds this level whole.
	std::uint64_t prefix = 0;
	/// Of `bytes`, those spent on connectivity, geometry and attributes; the rest is headers and
	/// checksums.
	std::uint64_t connectivityBytes = 0;
	std::uint64_t geometryBytes     = 0;
	std::uint64_t attributeBytes    = 0;
	int bits                        = 0; ///< precision of the positions, bits per coordinate
	/// Model units; an estimate from the details (docs/wmc_format.md), not a surface distance. 0
	/// for the finest level.
	double error = 0;
};

/// What the file keeps besides connectivity and lattice positions, and the bytes it takes. All but
/// the attributes follows the last level, and belongs to the finest mesh alone.
struct StreamFeatures
{
	/// The original is no oriented manifold. Every level is one; the finest mesh is the original
	/// once what follows the levels was read (before that, a manifold with some vertices several
	/// times).
	bool restored                  = false;
	bool orderKept                 = false; ///< order-preserving: EncodeOptions::keepOrder
	bool exact                     = false; ///< float-lossless: EncodeOptions::exact
	bool attributes                = false;
	std::uint64_t restorationBytes = 0;
	std::uint64_t orderBytes       = 0;
	std::uint64_t exactBytes       = 0;
	std::uint64_t attributeBytes   = 0; ///< in the levels and behind them
	std::uint64_t attributeValues  = 0; ///< numbers in all attributes
};

/// What the head tells of an attribute.
struct AttributeInfo
{
	AttributeOf of     = AttributeOf::Vertex;
	AttributeKind kind = AttributeKind::Custom;
	NumberType type    = NumberType::Float;
	int components     = 1;
	std::string name;
	int bits            = 0; ///< of the numbers that are rounded; 0: none is
	double step         = 0; ///< of these; they are off by half a step at most
	std::uint64_t bytes = 0; ///< of the file, about
};

/// What the head of a file tells.
struct StreamInfo
{
	int versionMajor = 0;
	int versionMinor = 0;
	Mode mode        = Mode::Classic;
	int lifting      = kLiftingOff;
	bool wgc         = false;        ///< was the coarsening steered by geometry?
	int bits         = 0;            ///< bits per coordinate over the largest extent
	std::array<double, 3> origin {}; ///< model units; position of lattice point (0,0,0)
	double step            = 0;      ///< model units per lattice step
	std::uint32_t vertices = 0;      ///< of the original
	std::uint32_t faces    = 0;
	std::uint64_t bytes    = 0; ///< of the whole file
	/// Bytes of the file spent on connectivity and geometry; the rest is headers, checksums and
	/// `features`.
	std::uint64_t connectivityBytes = 0;
	std::uint64_t geometryBytes     = 0;
	StreamFeatures features;
	std::vector<AttributeInfo> attributes; ///< in the order of MeshData's
	std::vector<std::string> textures;     ///< names
	std::vector<LevelInfo> levels;         ///< coarsest first

	int finestLevel() const { return static_cast<int>(levels.size()) - 1; }
};

struct EncodedMesh
{
	std::vector<std::uint8_t> bytes; ///< the file
	StreamInfo info;
};

/// Encodes `mesh`.
///
/// @param mesh  any triangles: non-manifold, inconsistently or not orientable, with isolated
///              vertices, degenerate faces, several times the same face, or none at all; never
///              modified
/// @return the file; InvalidArgument for options out of range, indices out of range, and
///         coordinates that are not finite unless options.exact is set, naming the vertex;
///         LimitExceeded; Cancelled; OutOfMemory. The same mesh and options give the same bytes
///         everywhere.
/// Cost linear in the mesh.
Result<EncodedMesh> encode(const MeshData& mesh, const EncodeOptions& options = {});

/// What a decoder may spend. A file that declares more is refused before the memory is taken, with
/// LimitExceeded and the name of the limit.
///
/// The defaults only keep a file from taking what no desktop has. For files of strangers, where
/// others wait for the answer, choose what the largest mesh that is welcome has: decoding takes a
/// few megabytes, up to 700 bytes for each vertex of the finest level and some dozens for each
/// number of an attribute; and time for up to maxLevelShare times such a mesh
/// (EncodeOptions::effort tells how much).
struct DecodeLimits
{
	/// Of the finest level and of the original, whichever has more; faces and attributes, too.
	std::uint64_t maxVertices        = 200'000'000;
	std::uint64_t maxFaces           = 400'000'000;
	std::uint64_t maxAttributeValues = 2'000'000'000; ///< numbers in all attributes together
	/// Faces of all levels together, in multiples of the finest level's (and a thousand more): how
	/// much longer than its mesh is worth a file may take. The encoder's stay below, since each
	/// split adds a fifteenth at least, but for the last few dozen vertices.
	std::uint64_t maxLevelShare = 400;

	/// As much as the format can hold: for a file that one has the mesh of.
	static DecodeLimits none()
	{
		constexpr std::uint64_t kAny = ~std::uint64_t {0};
		return {kAny, kAny, kAny, kAny};
	}
};

constexpr int kFinestLevel = -1;

struct DecodeOptions
{
	/// Level to stop at, 0 coarsest; kFinestLevel, or anything past the finest: the finest.
	int level = kFinestLevel;
	/// Decode as if the data ended after this many bytes.
	std::uint64_t maxBytes = ~std::uint64_t {0};
	DecodeLimits limits;
	Progress progress;
};

/// Reads the head only: the first few hundred bytes are enough.
/// @return NotWmc, VersionTooNew, VersionTooOld, Truncated (the head is not whole), Corrupt,
///         ChecksumMismatch, OutOfMemory
Result<StreamInfo> readInfo(const std::uint8_t* data, std::size_t size);

struct DecodedMesh
{
	MeshData mesh;
	/// That `mesh` is; a level cut in the middle counts if its connectivity is whole.
	int level = 0;
	StreamInfo info;
};

/// Decodes up to options.level.
///
/// @return the mesh; with status Truncated *and* a mesh if the data ends before the level asked
///         for but after the base mesh. Errors without a mesh: NotWmc, VersionTooNew,
///         VersionTooOld, Truncated (not even the base arrived), Corrupt, ChecksumMismatch,
///         LimitExceeded, Cancelled, OutOfMemory.
/// Vertices of a level keep their index in every finer level, but for the finest if StreamFeatures
/// says that it is restored or keeps the original's order.
Result<DecodedMesh>
decode(const std::uint8_t* data, std::size_t size, const DecodeOptions& options = {});

/// About what part of the time that decoding levels 0 to `target` takes has passed when each of
/// them is done: for the progress of those who decode level by level. Below 1 for the finest level
/// as far as something follows it.
/// @pre 0 <= target <= info.finestLevel().  @return target + 1 numbers, ascending
std::vector<double> decodingShares(const StreamInfo& info, int target);

/// Decodes level by level; what decode() is made of, for browsing and for streams.
///
///     auto decoder = Decoder::open(data, size);
///     Status s     = decoder.status();
///     while (s.ok() && decoder->level() < decoder->info().finestLevel()) {
///         const int before = decoder->level();
///         s                = decoder->advance();
///         if (decoder->level() > before && (s.ok() || s.code == StatusCode::Truncated))
///             use(decoder->mesh());
///     }
class Decoder
{
public:
	/// Reads the head. `data` must stay alive and unchanged as long as the decoder.
	static Result<Decoder>
	open(const std::uint8_t* data, std::size_t size, const DecodeLimits& limits = {});

	Decoder(Decoder&&) noexcept;
	Decoder& operator=(Decoder&&) noexcept;
	~Decoder();

	const StreamInfo& info() const;
	/// Level of mesh(), or -1 before the first advance().
	int level() const;
	/// Decodes the next level. After Truncated the decoder may have moved to a partly predicted
	/// level; after any other error, Cancelled too, it has no mesh. It does not advance any more
	/// after either.
	/// @param progress  of this level
	Status advance(const Progress& progress = {});
	/// The mesh of the current level; empty after an error other than Truncated. A copy, linear
	/// each time. Throws std::bad_alloc if there is no memory for it, which decode() returns.
	/// @pre level() >= 0
	MeshData mesh() const;

private:
	struct State;
	explicit Decoder(std::unique_ptr<State>);
	std::unique_ptr<State> state_;
};

} // namespace wavemesh
