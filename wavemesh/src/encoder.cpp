// SPDX-License-Identifier: GPL-3.0-or-later
#include "container/container.h"
#include "encode/classic.h"
#include "encode/compact.h"
#include "encode/ways.h"
#include "finish/finish.h"
#include "guard.h"

#include <wavemesh/codec.h>

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
	if (o.wgc > Wgc::Auto)
		return {StatusCode::InvalidArgument, "unknown choice of the geometrical criterion"};
	if (!(o.wgcSharpness >= 0 && o.wgcSharpness <= 1))
		return {StatusCode::InvalidArgument, "the sharpness threshold must be 0 to 1"};
	if (!(o.wgcDeviation > 0 && o.wgcDeviation <= 1e6))
		return {StatusCode::InvalidArgument, "the deviation threshold must be positive"};
	return {};
}

/// Parts of the work by vertex, about 0.1 microseconds: measured as in level_work.h.
struct EncodingWork
{
	double prepare, coarsen;
	double levels, finish; ///< each time that it is tried

	double of(const Way& way) const
	{
		return coarsen + double(way.plans.size()) * (levels + finish);
	}
	double of(const std::vector<Way>& ways) const
	{
		double all = prepare;
		for (const Way& way : ways)
			all += of(way);
		return all;
	}
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

class Encoder
{
public:
	Encoder(const MeshData& original, const QuantisedMesh& mesh, const EncodeOptions& options) :
	        original_(original), mesh_(mesh), options_(options),
	        classic_(isWrittenClassic(options)), work_(typicalWork()), choice_(options.optimize)
	{
	}

	Result<EncodedMesh> run()
	{
		if (featuresFor(options_, original_, mesh_.cut) & (1 << kAttributes)) {
			rows_.emplace(original_);
			if (options_.mode == Mode::Compact)
				seams_ = rows_->seams(original_, mesh_.cut);
		}
		const std::vector<Way> ways = waysToEncode(
		    options_, mesh_.positions.size(),
		    !classic_ && repeatsItself(mesh_.cut.table, mesh_.positions));
		const double all = work_.of(ways);
		double done      = work_.prepare;
		for (const Way& way : ways) {
			const double work = work_.of(way);
			const Stage stage(options_.progress, done / all, (done + work) / all);
			done += work;
			if (!stage(0) || !tryWay(way, stage))
				return failure_.ok() ? cancelled() : failure_;
		}
		return choice_.take();
	}

private:
	using Attributes = std::optional<AttributeLevels>;

	/// The levels are not known yet: what they usually are.
	EncodingWork typicalWork() const
	{
		EncodingWork work {};
		work.prepare = 1;
		work.coarsen = options_.optimize == Optimize::Size ? 4.5 : 12;
		work.levels  = !classic_ ? 27 : options_.effort == 1 ? 3.5 : 7;
		work.finish  = 0.5 + 7 * options_.keepOrder + 7 * options_.exact;
		return work;
	}

	/// The levels' part in the work of one try.
	double written() const { return work_.levels / (work_.levels + work_.finish); }

	bool tryWay(const Way& way, const Stage& stage)
	{
		const double coarsened = work_.coarsen / work_.of(way);
		const GeometricalCriterion criterion {
		    way.wgc, options_.wgcSharpness, options_.wgcDeviation};
		std::optional<Levels> levels =
		    makeLevels(mesh_, criterion, steeringFor(way.aim), stage.part(0, coarsened), seams_);
		if (!levels)
			return false;
		Attributes attributes;
		if (rows_)
			attributes.emplace(*rows_, original_, mesh_, *levels);
		const Stage writing = stage.part(coarsened, 1);
		return classic_ ? tryClassic(*levels, attributes, way, writing)
		                : tryCompact(*levels, attributes, way, writing);
	}

	Head headOf(const Levels& levels, const Way& way) const
	{
		Head head;
		head.mode     = classic_ ? Mode::Classic : Mode::Compact;
		head.wgc      = way.wgc;
		head.rich     = options_.effort > 1;
		head.lattice  = mesh_.lattice;
		head.digest   = digestOf(levels.replay.finest, levels.positions);
		head.features = featuresFor(options_, original_, mesh_.cut);
		return head;
	}

	bool
	tryClassic(Levels& levels, const Attributes& attributes, const Way& way, const Stage& stage)
	{
		Head head    = headOf(levels, way);
		head.lifting = options_.mode == Mode::Classic ? options_.lifting : kLiftingOff;
		std::vector<std::uint8_t> chunks;
		auto writer = writerFor(attributes);
		if (!writeClassic(levels, writer.get(), head, chunks, stage.part(0, written())))
			return false;
		return finish(
		           way.plans.front(), levels, writer.get(), head, chunks,
		           stage.part(written(), 1)) &&
		       stage(1);
	}

	bool tryCompact(
	    const Levels& levels, const Attributes& attributes, const Way& way, const Stage& stage)
	{
		const auto tries = double(way.plans.size());
		for (std::size_t i = 0; i < way.plans.size(); ++i) {
			const Plan& plan = way.plans[i];
			const Stage part = stage.part(double(i) / tries, double(i + 1) / tries);
			Head head        = headOf(levels, way);
			head.predictors  = plan.predictors;
			std::vector<std::uint8_t> chunks;
			const Schedule schedule = makeSchedule(levels, mesh_.lattice.bits, plan.schedule);
			auto writer             = writerFor(attributes);
			if (!writeCompact(
			        levels, schedule, writer.get(), head, chunks, part.part(0, written())))
				return false;
			if (!finish(plan, levels, writer.get(), head, chunks, part.part(written(), 1)) ||
			    !part(1))
				return false;
		}
		return true;
	}

	static std::unique_ptr<AttributeWriter> writerFor(const Attributes& attributes)
	{
		return attributes ? std::make_unique<AttributeWriter>(*attributes) : nullptr;
	}

	bool finish(
	    const Plan& plan,
	    const Levels& levels,
	    AttributeWriter* attributes,
	    Head& head,
	    std::vector<std::uint8_t>& chunks,
	    const Stage& stage)
	{
		if (!writeFinish(
		        {original_, mesh_.cut, levels.replay.finest, levels.positions, levels.replay.source,
		         levels.glue, attributes},
		        head, chunks, stage))
			return false;
		failure_ = checkSizes(head.rows);
		if (!failure_.ok())
			return false;
		EncodedMesh out;
		writeHead(head, out.bytes);
		out.info = describe(head, out.bytes.size());
		out.bytes.insert(out.bytes.end(), chunks.begin(), chunks.end());
		choice_.add(plan.rank, std::move(out));
		return true;
	}

	const MeshData& original_;
	const QuantisedMesh& mesh_;
	const EncodeOptions& options_;
	bool classic_;
	std::optional<AttributeRows> rows_; ///< if there are any
	Seams seams_;
	EncodingWork work_;
	Choice choice_;
	Status failure_; ///< why there is no file, if not by the user's wish
};

} // namespace

Result<EncodedMesh> encode(const MeshData& mesh, const EncodeOptions& options)
{
	const auto work = [&]() -> Result<EncodedMesh> {
		if (Status s = checkOptions(options); !s.ok())
			return s;
		const auto quantised = prepare(mesh, options);
		if (!quantised.ok())
			return quantised.status();
		return Encoder(mesh, *quantised, options).run();
	};
	return guarded(work, [] { return "to encode this mesh"; });
}

} // namespace wavemesh
