// SPDX-License-Identifier: GPL-3.0-or-later
// Temporary: raw arrays behind the final interface, so that the rest can be built meanwhile.
#include <wavemesh/codec.h>
#include <algorithm>
#include <cmath>
#include <cstring>
namespace wavemesh {
namespace {
constexpr int kLevels = 6;
struct Raw { std::vector<double> p; std::vector<std::uint32_t> t; };
StreamInfo makeInfo(std::uint32_t V, std::uint32_t F, double step, const double* o, std::uint64_t total)
{
	StreamInfo i; i.versionMinor = 1; i.vertices = V; i.faces = F; i.bits = 12; i.step = step; i.lifting = 0;
	for (int k = 0; k < 3; ++k) i.origin[std::size_t(k)] = o[k];
	i.bytes = total; std::uint64_t at = 60;
	for (int l = 0; l < kLevels; ++l) {
		LevelInfo e; e.kind = l ? LevelKind::Split : LevelKind::Base; e.vertices = V; e.faces = std::max(1u, F >> (2 * (kLevels - 1 - l)));
		e.bytes = (l == kLevels - 1 ? total : at + (total - 60) / kLevels) - (l ? at : 0); at = (l ? at : 0) + e.bytes; e.prefix = at; e.bits = 12;
		e.error = step * (kLevels - 1 - l); i.levels.push_back(e);
	}
	i.geometryBytes = std::uint64_t(V) * 12; i.connectivityBytes = std::uint64_t(F) * 12; return i;
}
}
Result<EncodedMesh> encode(const MeshData& m, const EncodeOptions& o)
{
	if (o.bits < 1 || o.bits > 24) return Status(StatusCode::InvalidArgument, "bits must be 1 to 24");
	if (m.triangles.empty()) return Status(StatusCode::Unsupported, "the mesh has no faces");
	double lo[3] = {1e300, 1e300, 1e300}, ext = 0;
	for (int k = 0; k < 3; ++k) { double hi = -1e300; for (auto& p : m.positions) { lo[k] = std::min(lo[k], p[std::size_t(k)]); hi = std::max(hi, p[std::size_t(k)]); } ext = std::max(ext, hi - lo[k]); }
	double step = o.step > 0 ? o.step : ext / ((1 << o.bits) - 1); if (step == 0) step = 1;
	EncodedMesh e; auto put = [&](const void* d, std::size_t n) { auto b = static_cast<const std::uint8_t*>(d); e.bytes.insert(e.bytes.end(), b, b + n); };
	put("\x8bWMC\r\n\x1a\n", 8); std::uint32_t V = std::uint32_t(m.positions.size()), F = std::uint32_t(m.triangles.size()); put(&V, 4); put(&F, 4); put(&step, 8); put(lo, 24); put("............", 12);
	for (auto& p : m.positions) for (int k = 0; k < 3; ++k) { std::int32_t q = std::int32_t(std::lround((p[std::size_t(k)] - lo[k]) / step)); put(&q, 4); }
	for (auto& t : m.triangles) put(t.data(), 12);
	e.info = makeInfo(V, F, step, lo, e.bytes.size()); return e;
}
Result<StreamInfo> readInfo(const std::uint8_t* d, std::size_t n)
{
	if (n < 8 || std::memcmp(d, "\x8bWMC\r\n\x1a\n", 8)) return Status(StatusCode::NotWmc, "not a .wmc file");
	if (n < 60) return Status(StatusCode::Truncated, "the head is not whole");
	std::uint32_t V, F; double s, lo[3]; std::memcpy(&V, d + 8, 4); std::memcpy(&F, d + 12, 4); std::memcpy(&s, d + 16, 8); std::memcpy(lo, d + 24, 24);
	return makeInfo(V, F, s, lo, 60 + 12ull * V + 12ull * F);
}
struct Decoder::State { const std::uint8_t* d; std::size_t n; StreamInfo i; int level = -1; };
Decoder::Decoder(std::unique_ptr<State> s) : state_(std::move(s)) {}
Decoder::Decoder(Decoder&&) noexcept = default; Decoder& Decoder::operator=(Decoder&&) noexcept = default; Decoder::~Decoder() = default;
const StreamInfo& Decoder::info() const { return state_->i; }
int Decoder::level() const { return state_->level; }
Result<Decoder> Decoder::open(const std::uint8_t* d, std::size_t n, const DecodeLimits&)
{
	auto i = readInfo(d, n); if (!i.ok()) return i.status();
	auto s = std::make_unique<State>(); s->d = d; s->n = n; s->i = *i; return Decoder(std::move(s));
}
Status Decoder::advance()
{
	if (level() >= info().finestLevel()) return Status(StatusCode::InvalidArgument, "already at the finest level");
	if (state_->n < info().levels[std::size_t(level() + 1)].prefix) return Status(StatusCode::Truncated, "the file ends inside level " + std::to_string(level() + 1), state_->n);
	++state_->level; return {};
}
MeshData Decoder::mesh() const
{
	MeshData m; auto& i = state_->i; m.positions.resize(i.vertices); const auto* d = state_->d + 60;
	for (auto& p : m.positions) for (int k = 0; k < 3; ++k, d += 4) { std::int32_t q; std::memcpy(&q, d, 4); p[std::size_t(k)] = i.origin[std::size_t(k)] + q * i.step; }
	m.triangles.resize(i.levels[std::size_t(state_->level)].faces); for (auto& t : m.triangles) { std::memcpy(t.data(), d, 12); d += 12; }
	return m;
}
Result<DecodedMesh> decode(const std::uint8_t* d, std::size_t n, const DecodeOptions& o)
{
	auto dec = Decoder::open(d, std::size_t(std::min<std::uint64_t>(n, o.maxBytes)), o.limits); if (!dec.ok()) return dec.status();
	int to = o.level < 0 ? dec->info().finestLevel() : std::min(o.level, dec->info().finestLevel());
	Status s; while (dec->level() < to) { s = dec->advance(); if (!s.ok()) break; }
	if (dec->level() < 0) return s;
	DecodedMesh r; r.mesh = dec->mesh(); r.level = dec->level(); r.info = dec->info();
	return Result<DecodedMesh>(std::move(r), s);
}
}
