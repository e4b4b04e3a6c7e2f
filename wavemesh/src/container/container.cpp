// SPDX-License-Identifier: GPL-3.0-or-later
#include "container/container.h"

#include "container/attribute_fields.h"
#include "entropy/models.h"

#include <cmath>

namespace wavemesh {
namespace {

constexpr std::uint8_t kMagic[8]         = {0x8b, 'W', 'M', 'C', '\r', '\n', 0x1a, '\n'};
constexpr std::size_t kChecksumSize      = 4;
constexpr std::uint32_t kMaxLevels       = 4096;
constexpr std::uint64_t kMaxFeatureBytes = std::uint64_t {1} << 48; ///< sums stay below 2^64

Status corruptHead(const char* why)
{
	return {StatusCode::Corrupt, std::string("the head is damaged: ") + why, sizeof kMagic};
}

std::size_t varintSize(std::uint64_t x)
{
	std::size_t n = 1;
	for (; x >= 128; x >>= 7)
		++n;
	return n;
}

std::size_t chunkSize(std::uint64_t payload)
{
	return 1 + varintSize(payload) + std::size_t(payload) + kChecksumSize;
}

/// Fixed fields of the head, in file order.
template <class Io>
bool visitFields(Io& io, Head& h)
{
	io.fixed(h.major);
	io.fixed(h.minor);
	std::uint8_t flags = 0;
	bool wide          = false;
	double extent      = 0;
	const double steps = double((std::uint32_t(1) << h.lattice.bits) - 1);
	if constexpr (!Io::kReading) {
		// 32-bit floats where they say the same.
		extent = double(float(h.lattice.step * steps));
		wide   = extent / steps != h.lattice.step;
		for (const double x : h.lattice.origin)
			wide = wide || double(float(x)) != x;
		const int way =
		    h.mode == Mode::Classic ? h.lifting - kLiftingOff : static_cast<int>(h.predictors);
		flags = std::uint8_t(
		    int(h.mode) | (h.wgc ? 8 : 0) | (wide ? 16 : 0) | (way << 5) | (h.rich ? 128 : 0));
	}
	io.fixed(flags);
	io.fixed(h.features);
	std::uint8_t bits = std::uint8_t(h.lattice.bits);
	io.fixed(bits);
	if constexpr (Io::kReading) {
		h.mode         = Mode(flags & 7);
		h.wgc          = (flags & 8) != 0;
		wide           = (flags & 16) != 0;
		const int way  = (flags >> 5) & 3;
		h.rich         = (flags & 128) != 0;
		h.lattice.bits = bits;
		if (bits < 1 || bits > kMaxBits || h.mode > Mode::Compact ||
		    (h.mode == Mode::Compact && way > int(PredictorSet::Repeats)))
			return false;
		if (h.mode == Mode::Classic)
			h.lifting = way + kLiftingOff;
		else
			h.predictors = PredictorSet(way);
	}
	for (double& x : h.lattice.origin)
		wide ? io.real64(x) : io.real32(x);
	if (wide)
		io.real64(h.lattice.step);
	else {
		io.real32(extent);
		if constexpr (Io::kReading)
			h.lattice.step = extent / double((std::uint32_t(1) << h.lattice.bits) - 1);
	}
	io.fixed(h.digest);
	if (h.has(kRestoration)) {
		io.varint(h.vertices);
		io.varint(h.faces);
	}
	if (h.has(kAttributes) && !visitAttributes(io, h.channels, h.textures))
		return false;
	for (int f = 0; f < kFeatures; ++f)
		if (h.has(Feature(f)))
			io.varint(h.featureBytes[std::size_t(f)]);
	for (const std::uint64_t bytes : h.featureBytes)
		if (bytes > kMaxFeatureBytes)
			return false;
	return (h.features >> kFeatures) == 0;
}

/// 0.x promises nothing between its minor versions.
Status checkVersion(std::uint8_t major, std::uint8_t minor)
{
	const auto name = [](int a, int b) { return std::to_string(a) + "." + std::to_string(b); };
	const int found = 256 * major + minor, read = 256 * kVersionMajor + kVersionMinor;
	if (found == read)
		return {};
	return {
	    found > read ? StatusCode::VersionTooNew : StatusCode::VersionTooOld,
	    "the file has format version " + name(major, minor) + ", " +
	        (found > read ? "newer" : "older") + " than " + name(kVersionMajor, kVersionMinor) +
	        ", the only one that this program reads"};
}

/// The level table, finest first: each row next to the one it was coarsened to.
template <class Coder>
void codeRows(Coder& coder, Mode mode, bool hasAttributes, std::vector<LevelRow>& rows)
{
	AdaptiveUnsigned<32> vertices, faces, bytes, connectivity, attributes;
	AdaptiveSigned<32> removed;
	AdaptiveSigned<9> error;
	AdaptiveUnsigned<5> sharper;
	AdaptiveBit endsChunk, precise;
	for (std::size_t i = rows.size(); i-- > 0 && !coder.exhausted();) {
		LevelRow& row = rows[i];
		if (i + 1 == rows.size()) {
			row.vertices = std::uint32_t(vertices.code(coder, row.vertices));
			row.faces    = std::uint32_t(faces.code(coder, row.faces));
		}
		else {
			const LevelRow& finer = rows[i + 1];
			if (finer.kind == LevelKind::Precise) {
				row.vertices = finer.vertices;
				row.faces    = finer.faces;
				row.shift    = finer.shift + 1 +
				            int(sharper.code(coder, std::uint64_t(row.shift - finer.shift - 1)));
			}
			else {
				row.vertices = finer.vertices -
				               std::uint32_t(vertices.code(coder, finer.vertices - row.vertices));
				// A vertex less is two faces less, away from the boundary.
				const std::int64_t regular =
				    std::int64_t(finer.faces) - 2 * std::int64_t(finer.vertices - row.vertices);
				row.faces = std::uint32_t(regular + removed.code(coder, row.faces - regular));
				row.shift = finer.shift;
			}
			row.errorCode =
			    std::uint8_t(finer.errorCode + error.code(coder, row.errorCode - finer.errorCode));
		}
		row.bytes             = bytes.code(coder, row.bytes);
		row.connectivityBytes = connectivity.code(coder, row.connectivityBytes);
		if (hasAttributes)
			row.attributeBytes = attributes.code(coder, row.attributeBytes);
		row.endsChunk        = codeBit(coder, endsChunk, row.endsChunk, 60);
		const bool isPrecise = mode == Mode::Compact && i > 0 &&
		                       codeBit(coder, precise, row.kind == LevelKind::Precise, 60);
		row.kind = i == 0 ? LevelKind::Base : isPrecise ? LevelKind::Precise : LevelKind::Split;
	}
}

/// What a refinement can do at most.
Status checkRows(const std::vector<LevelRow>& rows, int bits)
{
	if (rows[0].shift >= bits)
		return corruptHead("the base mesh has no precision");
	if (!rows.back().endsChunk)
		return corruptHead("the last level is open");
	for (std::size_t i = 0; i < rows.size(); ++i) {
		const LevelRow& row = rows[i];
		if (row.vertices > kMostElements || row.faces > kMostElements ||
		    row.connectivityBytes + row.attributeBytes > row.bytes)
			return corruptHead("impossible counts in the level table");
		if (i == 0) {
			if (std::uint64_t(row.vertices) > 3 * std::uint64_t(row.faces))
				return corruptHead("impossible base mesh");
			continue;
		}
		const LevelRow& coarser = rows[i - 1];
		if (coarser.faces == 0)
			return corruptHead("a level grows out of nothing");
		const std::uint64_t edgesAndFaces = 4 * std::uint64_t(coarser.faces);
		if (row.vertices < coarser.vertices || row.faces < coarser.faces ||
		    row.faces > 4 * std::uint64_t(coarser.faces) ||
		    row.vertices - coarser.vertices > edgesAndFaces)
			return corruptHead("a level grows more than a split can");
	}
	return {};
}

} // namespace

std::uint8_t errorCode(std::uint64_t sum, std::uint64_t count)
{
	if (sum == 0 || count == 0)
		return 0;
	// Clamped where the scaling would overflow; such sums are beyond any real mesh.
	const std::uint64_t mean =
	    sum > (~std::uint64_t {0} >> 8) ? ~std::uint64_t {0} / count : (sum << 8) / count;
	const int length = bitLength(mean);
	if (length <= 2)
		return std::uint8_t(mean == 0 ? 1 : mean);
	const int exponent = length - 2; // mean = 1mm (binary) << (length - 3)
	const int mantissa = int((mean >> (length - 3)) & 3);
	return std::uint8_t(exponent * 4 + mantissa);
}

double errorFromCode(std::uint8_t code)
{
	if (code < 4)
		return std::sqrt(double(code) / 256);
	return std::sqrt(std::ldexp(double(4 + (code & 3)), (code >> 2) - 1) / 256);
}

std::uint32_t digestOf(const CornerTable& table, const std::vector<LatticePoint>& positions)
{
	std::vector<std::uint8_t> bytes(12 * positions.size() + 4 * table.vertex.size());
	std::uint8_t* at = bytes.data();
	const auto put   = [&at](std::uint32_t x) {
        for (int i = 0; i < 4; ++i)
            *at++ = static_cast<std::uint8_t>(x >> (8 * i));
	};
	for (const LatticePoint& p : positions)
		for (const std::int32_t x : p)
			put(static_cast<std::uint32_t>(x));
	for (const Index v : table.vertex)
		put(v);
	return checksum(bytes.data(), bytes.size());
}

void writeChunk(
    std::uint8_t type, const std::vector<std::uint8_t>& payload, std::vector<std::uint8_t>& file)
{
	ByteWriter out;
	out.fixed(type);
	out.varint(payload.size());
	out.bytes.insert(out.bytes.end(), payload.begin(), payload.end());
	out.fixed(checksum(out.bytes.data(), out.bytes.size()));
	file.insert(file.end(), out.bytes.begin(), out.bytes.end());
}

Result<Chunk> readChunkFrame(const std::uint8_t* data, std::size_t size, std::size_t offset)
{
	Chunk chunk;
	ByteReader in(data + offset, size - offset);
	std::uint64_t length = 0;
	chunk.type           = in.byte();
	in.varint(length);
	if (in.failed()) {
		if (in.position() == size - offset)
			return Status(
			    StatusCode::Truncated, "the file ends at offset " + std::to_string(size), size);
		return Status(StatusCode::Corrupt, "a chunk has an impossible length", offset);
	}
	const std::size_t begin = offset + in.position(), rest = size - begin;
	chunk.payload  = data + begin;
	chunk.declared = length;
	if (length + kChecksumSize > rest || length > rest) {
		chunk.size = std::size_t(std::min<std::uint64_t>(length, rest));
		chunk.end  = size;
		return chunk;
	}
	chunk.size  = std::size_t(length);
	chunk.whole = true;
	chunk.end   = begin + chunk.size + kChecksumSize;
	return chunk;
}

Result<Chunk> readChunk(const std::uint8_t* data, std::size_t size, std::size_t offset)
{
	auto chunk = readChunkFrame(data, size, offset);
	if (!chunk.ok() || !chunk->whole)
		return chunk;
	ByteReader tail(chunk->payload + chunk->size, kChecksumSize);
	std::uint32_t stored = 0;
	tail.fixed(stored);
	const std::uint8_t type = chunk->type;
	if (stored != checksum(data + offset, chunk->end - kChecksumSize - offset))
		return Status(
		    StatusCode::ChecksumMismatch,
		    std::string("chunk '") + (type >= 32 && type < 127 ? char(type) : '?') +
		        "' at offset " + std::to_string(offset) + " does not match its checksum",
		    offset);
	return chunk;
}

Status checkSizes(const std::vector<LevelRow>& rows)
{
	constexpr std::uint64_t kMost = ~std::uint32_t {0};
	for (std::size_t i = 0; i < rows.size(); ++i)
		if (rows[i].bytes > kMost)
			return {
			    StatusCode::LimitExceeded,
			    "level " + std::to_string(i) + " takes " + std::to_string(rows[i].bytes) +
			        " bytes, more than the format can hold (" + std::to_string(kMost) + ")"};
	return {};
}

void writeHead(const Head& head, std::vector<std::uint8_t>& file)
{
	file.insert(file.end(), std::begin(kMagic), std::end(kMagic));
	Head copy = head;
	ByteWriter out;
	visitFields(out, copy);
	out.varint(copy.rows.size());
	RangeEncoder coder;
	codeRows(coder, copy.mode, copy.has(kAttributes), copy.rows);
	const auto table = coder.finish();
	out.bytes.insert(out.bytes.end(), table.begin(), table.end());
	writeChunk(kHeadChunk, out.bytes, file);
}

Result<Head> readHead(const std::uint8_t* data, std::size_t size, std::size_t& end)
{
	const std::size_t known = std::min(size, sizeof kMagic);
	if (size == 0)
		return Status(StatusCode::NotWmc, "the file is empty");
	if (std::memcmp(data, kMagic, known) != 0) {
		if (size >= 4 && std::memcmp(data + 1, kMagic + 1, 3) == 0)
			return Status(
			    StatusCode::Corrupt, "the first bytes are damaged, as by a transfer in text mode",
			    0);
		return Status(StatusCode::NotWmc, "this is not a .wmc file");
	}
	if (size < sizeof kMagic)
		return Status(StatusCode::Truncated, "the file ends before its head", size);
	// A newer major version may have another head: look at it before anything else.
	auto chunk = readChunk(data, size, sizeof kMagic);
	if (!chunk.ok())
		return chunk.status();
	if (chunk->type != kHeadChunk)
		return corruptHead("it does not come first");
	if (chunk->size >= 2)
		if (Status s = checkVersion(chunk->payload[0], chunk->payload[1]); !s.ok())
			return s;
	if (!chunk->whole)
		return Status(StatusCode::Truncated, "the file ends inside its head", size);

	Head head;
	ByteReader in(chunk->payload, chunk->size);
	if (!visitFields(in, head) || in.failed())
		return corruptHead("impossible fields");
	bool finite = std::isfinite(head.lattice.step) && head.lattice.step > 0;
	for (const double x : head.lattice.origin)
		finite = finite && std::isfinite(x);
	std::uint32_t count = 0;
	in.varint(count);
	if (!finite || in.failed() || count == 0 || count > kMaxLevels)
		return corruptHead("impossible fields");
	head.rows.resize(count);
	RangeDecoder coder(chunk->payload + in.position(), chunk->size - in.position());
	codeRows(coder, head.mode, head.has(kAttributes), head.rows);
	if (coder.exhausted())
		return corruptHead("the level table is cut");
	if (Status s = checkRows(head.rows, head.lattice.bits); !s.ok())
		return s;
	const LevelRow& finest = head.rows.back();
	if (!head.has(kRestoration)) {
		head.vertices = finest.vertices;
		head.faces    = finest.faces;
	}
	else if (
	    head.faces < finest.faces || head.vertices > kMostElements || head.faces > kMostElements)
		return corruptHead("impossible counts of the original");
	end = chunk->end;
	return head;
}

namespace {

StreamFeatures featuresOf(const Head& head)
{
	StreamFeatures out;
	out.restored         = head.has(kRestoration);
	out.orderKept        = head.has(kOrder);
	out.exact            = head.has(kExact);
	out.attributes       = head.has(kAttributes);
	out.restorationBytes = head.featureBytes[kRestoration];
	out.orderBytes       = head.featureBytes[kOrder];
	out.exactBytes       = head.featureBytes[kExact];
	out.attributeBytes   = head.featureBytes[kAttributes];
	for (const LevelRow& row : head.rows)
		out.attributeBytes += row.attributeBytes;
	out.attributeValues = attributeValues(head, head.vertices, head.faces);
	return out;
}

} // namespace

std::uint64_t attributeValues(const Head& head, std::uint64_t vertices, std::uint64_t faces)
{
	const std::uint64_t elements[4] = {vertices, faces, 3 * faces, 1};
	std::uint64_t values            = 0;
	for (const Channel& c : head.channels)
		values += elements[std::size_t(c.of)] * c.width();
	return values;
}

StreamInfo describe(const Head& head, std::size_t headEnd)
{
	StreamInfo info;
	info.versionMajor = head.major;
	info.versionMinor = head.minor;
	info.mode         = head.mode;
	info.lifting      = head.lifting;
	info.wgc          = head.wgc;
	info.bits         = head.lattice.bits;
	info.origin       = head.lattice.origin;
	info.step         = head.lattice.step;
	info.vertices     = head.vertices;
	info.faces        = head.faces;
	info.features     = featuresOf(head);
	info.textures     = head.textures;
	for (const Channel& c : head.channels)
		info.attributes.push_back(
		    {c.of, c.kind, c.type, c.components, c.name, c.bits(), c.step(), c.bytes});

	std::uint64_t begin = headEnd, previous = 0; // of the chunk; end of the level before
	for (std::size_t i = 0, first = 0; i < head.rows.size(); ++i) {
		if (!head.rows[i].endsChunk)
			continue;
		std::uint64_t payload = 0;
		for (std::size_t k = first; k <= i; ++k)
			payload += head.rows[k].bytes;
		std::uint64_t end = begin + 1 + varintSize(payload);
		for (std::size_t k = first; k <= i; ++k) {
			const LevelRow& row = head.rows[k];
			end += row.bytes;
			LevelInfo level;
			level.kind              = row.kind;
			level.vertices          = row.vertices;
			level.faces             = row.faces;
			level.prefix            = k == i ? begin + chunkSize(payload) : end;
			level.bytes             = level.prefix - previous;
			level.bits              = head.lattice.bits - row.shift;
			level.error             = head.lattice.step * errorFromCode(row.errorCode);
			level.connectivityBytes = row.connectivityBytes;
			level.attributeBytes    = row.attributeBytes;
			level.geometryBytes     = row.bytes - row.connectivityBytes - row.attributeBytes;
			previous                = level.prefix;
			info.connectivityBytes += row.connectivityBytes;
			info.geometryBytes += level.geometryBytes;
			info.levels.push_back(level);
		}
		begin += chunkSize(payload);
		first = i + 1;
	}
	for (int f = 0; f < kFeatures; ++f)
		if (head.has(Feature(f)))
			begin += chunkSize(head.featureBytes[std::size_t(f)]);
	info.levels.back().vertices = head.vertices;
	info.levels.back().faces    = head.faces;
	info.levels.back().bytes += begin - previous;
	info.levels.back().prefix = begin;
	info.bytes                = begin;
	return info;
}

} // namespace wavemesh
