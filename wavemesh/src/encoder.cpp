// SPDX-License-Identifier: GPL-3.0-or-later
#include "container/container.h"
#include "encode/classic.h"
#include "encode/compact.h"
#include "finish/finish.h"

#include <wavemesh/codec.h>

#include <algorithm>
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

/// Parts of the work by vertex, about 0.1 microseconds: measured as in level_work.h.
struct EncodingWork
{
	double prepare, coarsen;
	double levels, finish; ///< each time that it is tried
	int tries, passes;

	double pass() const { return coarsen + tries * (levels + finish); }
	double all() const { return prepare + passes * pass(); }
};

/// Cuts, and rounds to the lattice.
Result<QuantisedMesh> prepare(const MeshData& mesh, const EncodeOptions& options)
{
	if (Status s = checkCounts(mesh.positions.size(), mesh.triangles.size()); !s.ok())
		return s;
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
	        classic_(options.mode == Mode::Classic || options.effort == 1),
	        repeats_(!classic_ && repeatsItself(mesh.cut.table, mesh.positions))
	{
	}

	Result<EncodedMesh> run()
	{
		const std::vector<Coarsening> ways = coarsenings();
		const EncodingWork work            = workOf(int(ways.size()));
		double done                        = work.prepare;
		for (const Coarsening& way : ways) {
			const bool wgc = way.wgc;
			const Stage stage(
			    options_.progress, done / work.all(), (done + work.pass()) / work.all());
			done += work.pass();
			if (!stage(0))
				return cancelled();
			const double coarsened = work.coarsen / work.pass();
			const GeometricalCriterion criterion {
			    wgc, options_.wgcSharpness, options_.wgcDeviation};
			std::optional<Levels> levels =
			    makeLevels(mesh_, criterion, steeringFor(way.aim), stage.part(0, coarsened));
			if (!levels)
				return cancelled();
			std::optional<AttributeLevels> attributes;
			if (featuresFor(options_, original_, mesh_.cut) & (1 << kAttributes))
				attributes.emplace(original_, mesh_, *levels);
			const Stage writing = stage.part(coarsened, 1);
			if (!(classic_ ? tryClassic(*levels, attributes, wgc, writing)
			               : tryCompact(*levels, attributes, wgc, writing)))
				return cancelled();
		}
		return std::move(best_);
	}

private:
	using Attributes = std::optional<AttributeLevels>;

	static constexpr std::size_t kSmall = 4096; ///< vertices; their time is nothing
	bool isSmall() const { return mesh_.positions.size() < kSmall; }
	static constexpr std::size_t kLarge = 16384; ///< vertices; here speed counts
	bool isLarge() const { return mesh_.positions.size() >= kLarge; }

	/// One way to make levels.
	struct Coarsening
	{
		Optimize aim;
		bool wgc;
	};

	std::vector<Coarsening> coarsenings() const
	{
		const Optimize aim = options_.optimize;
		if (options_.wgc != Wgc::Auto)
			return {{aim, options_.wgc == Wgc::On}};
		std::vector<Coarsening> all {{aim, false}};
		if (aim == Optimize::Size && (options_.mode == Mode::Classic || options_.effort == 3))
			all.push_back({aim, true});
		if (all.size() > 1 && options_.mode == Mode::Compact && isSmall())
			all.push_back({Optimize::Balanced, false});
		return all;
	}

	/// The levels are not known yet: what they usually are.
	EncodingWork workOf(int passes) const
	{
		EncodingWork work {};
		work.prepare = 1;
		work.coarsen = options_.optimize == Optimize::Size ? 4.5 : 12;
		work.levels  = !classic_ ? 27 : options_.effort == 1 ? 3.5 : 7;
		work.finish  = 0.5 + 7 * options_.keepOrder + 7 * options_.exact;
		work.tries   = classic_ ? 1 : int(plans().size());
		work.passes  = passes;
		return work;
	}

	/// The levels' part in the work of one try.
	double written() const
	{
		const EncodingWork work = workOf(1);
		return work.levels / (work.levels + work.finish);
	}

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
		if (!writeClassic(levels, writer.get(), head, chunks, stage.part(0, written())))
			return false;
		keepIfSmaller(levels, writer.get(), head, chunks);
		return stage(1);
	}

	bool
	tryCompact(const Levels& levels, const Attributes& attributes, bool wgc, const Stage& stage)
	{
		const std::vector<Plan> tries = plans();
		for (std::size_t i = 0; i < tries.size(); ++i) {
			const Stage part =
			    stage.part(double(i) / double(tries.size()), double(i + 1) / double(tries.size()));
			Head head       = headOf(levels, Mode::Compact, wgc);
			head.predictors = tries[i].predictors;
			std::vector<std::uint8_t> chunks;
			const Schedule schedule = makeSchedule(levels, mesh_.lattice.bits, tries[i].schedule);
			auto writer             = writerFor(attributes);
			if (!writeCompact(
			        levels, schedule, writer.get(), head, chunks, part.part(0, written())))
				return false;
			keepIfSmaller(levels, writer.get(), head, chunks);
			if (!part(1))
				return false;
		}
		return true;
	}

	/// One way to code positions.
	struct Plan
	{
		ScheduleOptions schedule;
		PredictorSet predictors;
	};

	std::vector<Plan> plans() const
	{
		constexpr int kAll     = ScheduleOptions::kAll;
		const double smooth    = cellErrorsFor(options_.optimize, false);
		const double repeating = cellErrorsFor(options_.optimize, true);
		const PredictorSet all = PredictorSet::All, repeats = PredictorSet::Repeats;
		if (options_.effort < 3) {
			// Narrower cells cost next to nothing here, and coarse levels look smoother.
			const int cell = options_.optimize == Optimize::Balanced ? 6 : 8;
			if (isSmall())
				return {{{cell, 1, 1, smooth}, all}, {{8, 1, kAll, repeating}, repeats}};
			if (repeats_)
				return {{{8, 2, kAll, repeating}, repeats}};
			return {{{cell, 2, 2, smooth}, isLarge() ? PredictorSet::Few : all}};
		}
		std::vector<Plan> ways;
		const auto add = [&ways](PredictorSet set, std::initializer_list<ScheduleOptions> some) {
			for (const ScheduleOptions& schedule : some)
				ways.push_back({schedule, set});
		};
		if (isSmall() || !repeats_)
			add(all, {{8, 1, 1, smooth},
			          {8, 1, 2, smooth},
			          {8, 1, kAll, smooth},
			          {4, 1, 2, smooth},
			          {12, 1, 2, smooth}});
		if (isSmall()) // as by default
			add(all, {{6, 1, 1, cellErrorsFor(Optimize::Balanced, false)}});
		add(repeats, {{8, 1, 1, smooth}, {8, 1, 2, smooth}, {8, 1, kAll, smooth}});
		if (isSmall() || repeats_)
			add(repeats, {{4, 1, kAll, repeating},
			              {12, 1, kAll, repeating},
			              {8, 1, kAll, cellErrorsFor(Optimize::Balanced, true)}});
		return ways;
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
	bool classic_;
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
