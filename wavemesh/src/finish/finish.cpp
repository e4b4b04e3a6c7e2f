// SPDX-License-Identifier: GPL-3.0-or-later
#include "finish/finish.h"

#include "container/byte_io.h"
#include "syntax/exact_syntax.h"
#include "syntax/order_syntax.h"
#include "syntax/restoration_syntax.h"

namespace wavemesh {
namespace {

using Positions = std::vector<std::array<double, 3>>;

std::uint32_t digestOf(const RestoredMesh& mesh)
{
	ByteWriter out;
	out.bytes.reserve(12 * mesh.points.size() + 12 * mesh.triangles.size());
	for (const LatticePoint& p : mesh.points)
		for (const std::int32_t x : p)
			out.fixed(static_cast<std::uint32_t>(x));
	for (const auto& t : mesh.triangles)
		for (const Index v : t)
			out.fixed(v);
	return checksum(out.bytes.data(), out.bytes.size());
}

std::uint32_t digestOf(const ElementOrder& order, const Triangles& restored)
{
	ByteWriter out;
	out.bytes.reserve(4 * order.vertex.size() + 12 * restored.size());
	for (const Index v : order.vertex)
		out.fixed(v);
	for (const auto& t : inOrder(restored, order))
		for (const Index v : t)
			out.fixed(v);
	return checksum(out.bytes.data(), out.bytes.size());
}

std::uint32_t digestOf(const Positions& positions)
{
	ByteWriter out;
	out.bytes.reserve(24 * positions.size());
	for (const auto& p : positions)
		for (const double x : p)
			out.real64(x);
	return checksum(out.bytes.data(), out.bytes.size());
}

/// A chunk's payload: the digest, then what `code` writes.
template <class Code>
void writeFeature(
    Feature feature, std::uint32_t digest, Head& head, std::vector<std::uint8_t>& chunks, Code code)
{
	RangeEncoder coder;
	code(coder);
	ByteWriter out;
	out.fixed(digest);
	const auto stream = coder.finish();
	out.bytes.insert(out.bytes.end(), stream.begin(), stream.end());
	head.featureBytes[feature] = out.bytes.size();
	writeChunk(kFeatureChunk[feature], out.bytes, chunks);
}

/// Codes the coordinates of a restored mesh next to its lattice points.
template <class Coder>
void codeExact(
    Coder& coder,
    const Lattice& lattice,
    const std::vector<LatticePoint>& points,
    Positions& values,
    Watch& watch)
{
	NumberFormat format;
	if constexpr (!Coder::kReading)
		format = formatOf(values, lattice.step);
	format.wide   = codeRaw(coder, 1, format.wide) != 0;
	format.digits = int(codeRaw(coder, 4, std::uint32_t(format.digits + 1))) - 1;
	ExactSyntax syntax(format, 3);
	values.resize(points.size());
	for (std::size_t v = 0;
	     v < points.size() && !coder.exhausted() && watch.goesOn(v, points.size()); ++v) {
		const auto predicted = lattice.position(points[v]);
		for (std::size_t k = 0; k < 3; ++k)
			values[v][k] = syntax.code(coder, predicted[k], lattice.step, k, values[v][k]);
	}
}

Status wrongDigest(const char* what)
{
	return {StatusCode::ChecksumMismatch, std::string(what) + " does not match its digest"};
}

} // namespace

std::uint8_t
featuresFor(const EncodeOptions& options, const MeshData& original, const ManifoldCut& cut)
{
	const bool attributes = !original.attributes.empty() || !original.textures.empty();
	return std::uint8_t(
	    (cut.changed() ? 1 << kRestoration : 0) | (options.keepOrder ? 1 << kOrder : 0) |
	    (options.exact ? 1 << kExact : 0) | (attributes ? 1 << kAttributes : 0));
}

bool writeFinish(
    const FinishSource& from, Head& head, std::vector<std::uint8_t>& chunks, const Stage& stage)
{
	// Order and exact coordinates take about the same; all else is little.
	const double middle    = !head.has(kExact) ? 1 : head.has(kOrder) ? 0.5 : 0;
	const Stage firstStage = stage.part(0, middle), secondStage = stage.part(middle, 1);
	Watch orderWatch(firstStage), exactWatch(secondStage);
	head.vertices = Index(from.original.positions.size());
	head.faces    = Index(from.original.triangles.size());
	if (head.features == 0)
		return true;
	const RestoredNumbers numbers = restoredNumbers(from.glue, from.finest.vertexCount);
	RestoredSource source;
	Restoration r = whatToRestore(
	    from.cut, from.original, head.lattice, from.finest, from.source, numbers, source);
	const RestoredMesh restored = restore(from.finest, from.positions, numbers, r);
	if (head.has(kRestoration))
		writeFeature(kRestoration, digestOf(restored), head, chunks, [&](RangeEncoder& coder) {
			(void)RestorationSyntax<RangeEncoder>(
			    coder, from.finest, numbers.count, head.lattice.bits)
			    .code(r, head.vertices, head.faces);
		});
	if (head.has(kOrder)) {
		ElementOrder order = orderOf(from.original.triangles, restored, source);
		writeFeature(
		    kOrder, digestOf(order, restored.triangles), head, chunks, [&](RangeEncoder& coder) {
			    OrderSyntax<RangeEncoder>(coder, restored.triangles, head.vertices, from.finest)
			        .code(order, orderWatch);
		    });
		if (orderWatch.stopped())
			return false;
	}
	if (head.has(kExact)) {
		Positions values;
		values.reserve(source.vertex.size());
		for (const Index v : source.vertex)
			values.push_back(from.original.positions[v]);
		writeFeature(kExact, digestOf(values), head, chunks, [&](RangeEncoder& coder) {
			codeExact(coder, head.lattice, restored.points, values, exactWatch);
		});
		if (exactWatch.stopped())
			return false;
	}
	if (head.has(kAttributes)) {
		const auto payload             = from.attributes->rest(head.channels);
		head.textures                  = from.original.textures;
		head.featureBytes[kAttributes] = payload.size();
		writeChunk(kFeatureChunk[kAttributes], payload, chunks);
	}
	return true;
}

Finish::Finish(
    const Head& head,
    const CornerTable& finest,
    const std::vector<LatticePoint>& positions,
    const Glue& glue,
    AttributeReader* attributes) :
        head_(head),
        finest_(finest), positions_(positions), numbers_(restoredNumbers(glue, finest.vertexCount)),
        restored_(restore(finest, positions, numbers_, {})), attributes_(attributes)
{
	if (attributes_)
		attributes_->restore(numbers_, restored_, {});
}

Status
Finish::apply(Feature feature, const std::uint8_t* payload, std::size_t size, const Stage& stage)
{
	ByteReader in(payload, size);
	std::uint32_t digest = 0;
	in.fixed(digest);
	if (in.failed())
		return {StatusCode::Corrupt, "a chunk behind the levels is too short"};
	RangeDecoder coder(payload + in.position(), size - in.position());
	Watch watch(stage);
	switch (feature) {
	case kRestoration:
		return restoration(coder, digest);
	case kOrder:
		return order(coder, digest, watch);
	case kExact:
		return exact(coder, digest, watch);
	case kAttributes:
		return attributes_->readRest(coder, digest, restored_, watch);
	}
	return {StatusCode::Corrupt, "a chunk behind the levels is of an unknown kind"};
}

Status Finish::restoration(RangeDecoder& coder, std::uint32_t digest)
{
	Restoration r;
	Status s = RestorationSyntax<RangeDecoder>(coder, finest_, numbers_.count, head_.lattice.bits)
	               .code(r, head_.vertices, head_.faces);
	if (coder.exhausted())
		return {StatusCode::Corrupt, "the restoration ends although its chunk is whole"};
	if (!s.ok())
		return s;
	restored_ = restore(finest_, positions_, numbers_, r);
	if (attributes_)
		attributes_->restore(numbers_, restored_, r.turned);
	return digestOf(restored_) == digest ? Status() : wrongDigest("the restored mesh");
}

Status Finish::order(RangeDecoder& coder, std::uint32_t digest, Watch& watch)
{
	OrderSyntax<RangeDecoder>(coder, restored_.triangles, Index(restored_.points.size()), finest_)
	    .code(order_, watch);
	if (watch.stopped())
		return cancelled();
	if (coder.exhausted())
		return {StatusCode::Corrupt, "the order ends although its chunk is whole"};
	return digestOf(order_, restored_.triangles) == digest ? Status() : wrongDigest("the order");
}

Status Finish::exact(RangeDecoder& coder, std::uint32_t digest, Watch& watch)
{
	codeExact(coder, head_.lattice, restored_.points, exact_, watch);
	if (watch.stopped())
		return cancelled();
	if (coder.exhausted())
		return {StatusCode::Corrupt, "the exact coordinates end although their chunk is whole"};
	return digestOf(exact_) == digest ? Status() : wrongDigest("an exact coordinate");
}

MeshData Finish::mesh() const
{
	MeshData out;
	out.triangles = restored_.triangles;
	out.positions = exact_;
	if (exact_.empty())
		for (const LatticePoint& p : restored_.points)
			out.positions.push_back(head_.lattice.position(p));
	out.textures = head_.textures;
	if (attributes_)
		out.attributes = attributes_->restoredAttributes(order_);
	if (!order_.empty()) {
		out.triangles = inOrder(out.triangles, order_);
		out.positions = inOrder(out.positions, order_);
	}
	return out;
}

} // namespace wavemesh
