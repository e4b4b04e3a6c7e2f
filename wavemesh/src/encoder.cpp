// SPDX-License-Identifier: GPL-3.0-or-later
#include "container/container.h"
#include "encode/classic.h"
#include "encode/compact.h"
#include "finish/finish.h"

#include <wavemesh/codec.h>

#include <limits>
#include <new>
#include <optional>

namespace wavemesh {
namespace {

Status checkOptions(const EncodeOptions& o)
{
	if (o.mode > Mode::Compact)
		return {StatusCode::InvalidArgument, "unknown mode"};
	if (o.optimize > Optimize::Levels)
		return {StatusCode::InvalidArgument, "unknown aim to optimise for"};
	if (o.effort < 1 || o.effort > 3)
		return {StatusCode::InvalidArgument, "effort must be 1, 2 or 3"};
	if (o.lifting < kLiftingOff || o.lifting > 2)
		return {StatusCode::InvalidArgument, "lifting must be off or the k of a k-disc, 0 to 2"};
	if (!(o.wgcSharpness >= 0 && o.wgcSharpness <= 1))
		return {StatusCode::InvalidArgument, "the sharpness threshold must be 0 to 1"};
	if (!(o.wgcDeviation > 0 && o.wgcDeviation <= 1e6))
		return {StatusCode::InvalidArgument, "the deviation threshold must be positive"};
	return {};
}

/// Which steps of the coarsening look at the error they make. Shares and steps from experiment, on
/// meshes of all kinds: docs/algorithm.md, section 3.
Steering steeringFor(Optimize optimize)
{
	switch (optimize) {
	case Optimize::Balanced:
		return {1, 0.99, 0.9};
	case Optimize::Levels:
		return {0, 0.95, 0.7};
	case Optimize::Size:
		break;
	}
	return {};
}

/// ScheduleOptions::cellErrors. Coordinates that repeat are cheaper exact from the start than half
/// known.
double cellErrorsFor(Optimize optimize, bool repeats)
{
	switch (optimize) {
	case Optimize::Balanced:
		return repeats ? 0.25 : 12;
	case Optimize::Levels:
		return 2;
	case Optimize::Size:
		break;
	}
	return 0;
}

/// Cuts, and rounds to the lattice.
Result<QuantisedMesh> prepare(const MeshData& mesh, const EncodeOptions& options)
{
	constexpr std::size_t kMost = std::numeric_limits<std::int32_t>::max() / 3;
	if (mesh.positions.size() > kMost || mesh.triangles.size() > kMost)
		return Status(
		    StatusCode::LimitExceeded, "the mesh has more than 715 million vertices or faces");
	const auto& finite = options.exact ? finitePositions(mesh.positions) : mesh.positions;
	const auto lattice = makeLattice(finite, options.bits, options.step);
	if (!lattice.ok())
		return lattice.status();
	if (Status s = checkAttributes(mesh); !s.ok())
		return s;
	auto cut = cutToManifold(mesh.triangles, Index(mesh.positions.size()));
	if (!cut.ok())
		return cut.status();
	QuantisedMesh quantised {std::move(*cut), *lattice, {}};
	const auto points = quantise(finite, *lattice);
	for (const Index v : quantised.cut.vertex)
		quantised.positions.push_back(points[v]);
	return quantised;
}

/// Everything that may be encoded in several ways, of which the smallest file is kept.
class Encoder
{
public:
	Encoder(const MeshData& original, const QuantisedMesh& mesh, const EncodeOptions& options) :
	        original_(original), mesh_(mesh), options_(options),
	        repeats_(repeatsItself(mesh.cut.table, mesh.positions))
	{
	}

	Result<EncodedMesh> run()
	{
		const bool classic = options_.mode == Mode::Classic || options_.effort == 1;
		// Balanced wants sharp edges kept in the one step that is left to connectivity; with Levels
		// there is none.
		const bool both = options_.wgc == Wgc::Auto && options_.optimize == Optimize::Size &&
		                  (options_.mode == Mode::Classic || options_.effort == 3);
		const bool preferred = options_.wgc == Wgc::On || (options_.wgc == Wgc::Auto &&
		                                                   options_.optimize == Optimize::Balanced);
		const Stage whole(options_.progress, 0, 1);
		for (const bool wgc : {false, true}) {
			if (!both && wgc != preferred)
				continue;
			const Stage stage = both ? whole.part(wgc ? 0.5 : 0, wgc ? 1 : 0.5) : whole;
			const GeometricalCriterion criterion {
			    wgc, options_.wgcSharpness, options_.wgcDeviation};
			std::optional<Levels> levels =
			    makeLevels(mesh_, criterion, steeringFor(options_.optimize), stage.part(0, 0.4));
			if (!levels)
				return cancelled();
			std::optional<AttributeLevels> attributes;
			if (featuresFor(options_, original_, mesh_.cut) & (1 << kAttributes))
				attributes.emplace(original_, mesh_, *levels);
			if (!(classic ? tryClassic(*levels, attributes, wgc, stage.part(0.4, 1))
			              : tryCompact(*levels, attributes, wgc, stage.part(0.4, 1))))
				return cancelled();
		}
		return std::move(best_);
	}

private:
	using Attributes = std::optional<AttributeLevels>;

	Head headOf(const Levels& levels, Mode mode, bool wgc) const
	{
		Head head;
		head.mode     = mode;
		head.wgc      = wgc;
		head.rich     = options_.effort > 1;
		head.lattice  = mesh_.lattice;
		head.digest   = digestOf(levels.replay.finest, levels.positions);
		head.features = featuresFor(options_, original_, mesh_.cut);
		return head;
	}

	bool tryClassic(Levels& levels, const Attributes& attributes, bool wgc, const Stage& stage)
	{
		Head head    = headOf(levels, Mode::Classic, wgc);
		head.lifting = options_.mode == Mode::Classic ? options_.lifting : kLiftingOff;
		std::vector<std::uint8_t> chunks;
		auto writer = writerFor(attributes);
		if (!writeClassic(levels, writer.get(), head, chunks, stage))
			return false;
		keepIfSmaller(levels, writer.get(), head, chunks);
		return true;
	}

	bool
	tryCompact(const Levels& levels, const Attributes& attributes, bool wgc, const Stage& stage)
	{
		const std::vector<ScheduleOptions> tries = schedulesFor();
		for (std::size_t i = 0; i < tries.size(); ++i) {
			const double part = 1.0 / double(tries.size());
			Head head         = headOf(levels, Mode::Compact, wgc);
			std::vector<std::uint8_t> chunks;
			const Schedule schedule = makeSchedule(levels, mesh_.lattice.bits, tries[i]);
			auto writer             = writerFor(attributes);
			if (!writeCompact(
			        levels, schedule, writer.get(), head, chunks,
			        stage.part(double(i) * part, double(i + 1) * part)))
				return false;
			keepIfSmaller(levels, writer.get(), head, chunks);
		}
		return true;
	}

	std::vector<ScheduleOptions> schedulesFor() const
	{
		constexpr int kAll  = ScheduleOptions::kAll;
		const double errors = cellErrorsFor(options_.optimize, repeats_);
		const int last      = repeats_ ? kAll : 2;
		if (options_.effort < 3)
			return {{8, 2, last, errors}};
		return {
		    {8, 1, 1, errors},
		    {8, 1, 2, errors},
		    {8, 1, kAll, errors},
		    {4, 1, last, errors},
		    {12, 1, last, errors}};
	}

	static std::unique_ptr<AttributeWriter> writerFor(const Attributes& attributes)
	{
		return attributes ? std::make_unique<AttributeWriter>(*attributes) : nullptr;
	}

	void keepIfSmaller(
	    const Levels& levels,
	    AttributeWriter* attributes,
	    Head& head,
	    std::vector<std::uint8_t>& chunks)
	{
		writeFinish(
		    {original_, mesh_.cut, levels.replay.finest, levels.positions, levels.replay.source,
		     levels.glue, attributes},
		    head, chunks);
		EncodedMesh out;
		writeHead(head, out.bytes);
		out.info = describe(head, out.bytes.size());
		out.bytes.insert(out.bytes.end(), chunks.begin(), chunks.end());
		if (best_.bytes.empty() || out.bytes.size() < best_.bytes.size())
			best_ = std::move(out);
	}

	const MeshData& original_;
	const QuantisedMesh& mesh_;
	const EncodeOptions& options_;
	bool repeats_; ///< see repeatsItself()
	EncodedMesh best_;
};

} // namespace

Result<EncodedMesh> encode(const MeshData& mesh, const EncodeOptions& options)
{
	try {
		if (Status s = checkOptions(options); !s.ok())
			return s;
		const auto quantised = prepare(mesh, options);
		if (!quantised.ok())
			return quantised.status();
		return Encoder(mesh, *quantised, options).run();
	}
	catch (const std::bad_alloc&) {
		return Status(StatusCode::OutOfMemory, "not enough memory to encode this mesh");
	}
}

} // namespace wavemesh
