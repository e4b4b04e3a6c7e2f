// SPDX-License-Identifier: GPL-3.0-or-later
// The filters that show levels: Simplification, Browse Levels, Layers from Levels; and the levels
// that dialogs are made for.
#include "browsing_options.h"
#include "filter_wavemesh.h"
#include "level_list.h"
#include "simplify_target.h"

#include <shared/encode_parameters.h>
#include <shared/level_file.h>
#include <shared/plugin_support.h>

#include <wavemesh/vcg_wmc.h>

#include <QApplication>
#include <QDockWidget>
#include <QEvent>
#include <QFileInfo>
#include <QGuiApplication>
#include <QLabel>
#include <QTimer>

#include <algorithm>

using namespace wavemesh;

namespace {

/// An hourglass, where there is a screen, while a dialog is prepared.
class WaitCursor
{
public:
	WaitCursor() : shown_(qobject_cast<QGuiApplication*>(QCoreApplication::instance()) != nullptr)
	{
		if (shown_)
			QGuiApplication::setOverrideCursor(Qt::WaitCursor);
	}
	~WaitCursor()
	{
		if (shown_)
			QGuiApplication::restoreOverrideCursor();
	}
	WaitCursor(const WaitCursor&)            = delete;
	WaitCursor& operator=(const WaitCursor&) = delete;

private:
	bool shown_;
};

/// MeshLab's dialogs offer no text that changes: a label is found by what it says.
std::vector<QLabel*> labelsThatSay(const QString& text)
{
	std::vector<QLabel*> labels;
	if (text.isEmpty() || qobject_cast<QApplication*>(QCoreApplication::instance()) == nullptr)
		return labels;
	for (QWidget* widget : QApplication::allWidgets())
		if (auto* label = qobject_cast<QLabel*>(widget); label != nullptr && label->text() == text)
			labels.push_back(label);
	return labels;
}

/// What a layer shows, for result maps and the log.
struct Shown
{
	const MeshModel& layer;
	const StreamInfo& info;
	int level;
	std::uint64_t streamBytes; ///< less than info.bytes if the stream is cut

	/// Of a level that is cut, and in part predicted, the error is that of the one below it.
	double error() const
	{
		const int whole = wholeLevels(info, streamBytes);
		return info.levels[std::size_t(std::clamp(level, 0, whole - 1))].error;
	}
	std::uint64_t bytes() const
	{
		return std::min(info.levels[std::size_t(level)].prefix, streamBytes);
	}

	std::map<std::string, QVariant> results() const
	{
		return {
		    {"level", level},       {"finest_level", info.finestLevel()}, {"vertices", layer.cm.vn},
		    {"faces", layer.cm.fn}, {"bytes", countValue(bytes())},       {"error", error()}};
	}
	std::string sentence() const
	{
		return QString("Level %1 of %2: %3 vertices, %4 faces, %5 bytes, error %6.")
		    .arg(level)
		    .arg(info.finestLevel())
		    .arg(layer.cm.vn)
		    .arg(layer.cm.fn)
		    .arg(bytes())
		    .arg(error(), 0, 'g', 3)
		    .toStdString();
	}
};

} // namespace

FilterWavemeshPlugin::Results FilterWavemeshPlugin::simplify(
    MeshModel& layer, const RichParameterList& parameters, vcg::CallBackPos* cb)
{
	const SimplifyTarget target = simplifyTarget(parameters, layer);
	EncodeOptions options       = encodeOptions(parameters, browsingOptions());
	options.progress            = progressBar(cb, "Making levels...");
	const unsigned channels     = drawnChannels(layer);
	const auto encoded          = encode(meshDataOf(layer, channels), options);
	require(encoded.status(), "Cannot simplify " + layer.label());

	const StreamInfo& info   = encoded->info;
	const ChosenLevel chosen = chooseLevel(info, target);
	if (!chosen.met)
		log(GLLogStream::WARNING, "No level reaches the target: this is the closest one.");
	if (chosen.level < info.finestLevel()) {
		DecodeOptions upTo;
		upTo.level         = chosen.level;
		const auto decoded = decode(encoded->bytes.data(), encoded->bytes.size(), upTo);
		require(decoded.status(), "Cannot simplify " + layer.label());
		auto coarse            = makeMesh(decoded->mesh);
		const QStringList lost = attributesNotKept(layer, channels);
		if (!lost.isEmpty())
			log(GLLogStream::WARNING,
			    ("The simplified mesh does not have: " + lost.join(", ") + ".").toStdString());
		exchangeMesh(layer, std::move(coarse));
		layer.setLabel(plainLabel(layer.label()));
	}
	const Shown shown {layer, info, chosen.level, info.bytes};
	log(shown.sentence());
	Results results           = shown.results();
	results["target_reached"] = chosen.met;
	return results;
}

FilterWavemeshPlugin::Results FilterWavemeshPlugin::browse(
    MeshModel& layer, const RichParameterList& parameters, unsigned int& postConditionMask)
{
	// No progress bar: it would let the slider's next event in while this one is being served.
	const auto levels  = levelsOf(layer);
	const int level    = chosenLevel(parameters, levels->info(), levels->finest());
	const bool changes = level != levels->shown();
	if (!changes)
		postConditionMask = MeshModel::MM_NONE; // nothing to draw anew
	levels->show(layer, level);
	const StreamInfo& info = levels->info();
	const bool exact       = wholeLevels(info, levels->stream()->size()) > info.finestLevel();
	layer.setLabel(
	    level == info.finestLevel() && exact
	        ? plainLabel(layer.label())
	        : levelLabel(layer.label(), level, info.finestLevel()));
	if (exact)
		nameLevelFile(layer, level, info.finestLevel());
	showCard(levelCard({info, levels->finest(), level}, level));
	const Shown shown {layer, info, level, levels->stream()->size()};
	if (changes) // the slider moves on within a level
		log(shown.sentence());
	return shown.results();
}

FilterWavemeshPlugin::Results
FilterWavemeshPlugin::makeLayers(MeshDocument& document, const RichParameterList& parameters)
{
	MeshModel& layer              = *document.mm();
	const auto levels             = levelsOf(layer);
	const std::vector<int> chosen = levelList(parameters, levels->finest());
	const int finest              = levels->info().finestLevel();
	const QString name            = QFileInfo(plainLabel(layer.label())).completeBaseName();

	for (int level : chosen) {
		MeshModel* made = document.addNewMesh(QString(), levelLabel(name, level, finest), false);
		levels->copyTo(*made, layer, level);
		log(Shown {*made, levels->info(), level, levels->stream()->size()}.sentence());
	}
	return {
	    {"layers", int(chosen.size())},
	    {"first", chosen.front()},
	    {"last", chosen.back()},
	    {"finest_level", finest}};
}

std::shared_ptr<LayerLevels> FilterWavemeshPlugin::levelsOf(MeshModel& layer)
{
	const auto ahead = std::move(ahead_);
	if (auto levels = LayerLevels::find(layer, ahead))
		return levels;
	if (findStream(layer.cm) != nullptr)
		log(GLLogStream::WARNING,
		    "The layer was edited: its levels are made anew, and what it shows is the finest.");
	const SharedBytes stream = encodeForBrowsing(layer);
	const auto info          = readInfo(stream->data(), stream->size());
	require(info.status(), "Cannot browse " + layer.label());
	encoded_ = {};
	return LayerLevels::attach(
	    layer, ahead && ahead->stream() == stream ? ahead : std::make_shared<LevelDecoder>(stream),
	    info->finestLevel());
}

SharedBytes FilterWavemeshPlugin::encodeForBrowsing(const MeshModel& layer)
{
	const std::uint64_t now = fingerprint(layer.cm, Extent::Attributes);
	if (!encoded_.stream || encoded_.fingerprint != now) {
		auto encoded = encode(meshDataOf(layer, drawnChannels(layer)), browsingOptions());
		require(encoded.status(), "Cannot make levels of " + layer.label());
		encoded_ = {
		    now, std::make_shared<const std::vector<std::uint8_t>>(std::move(encoded->bytes))};
	}
	return encoded_.stream;
}

LevelRange FilterWavemeshPlugin::levelRange(const MeshModel& layer)
{
	const WaitCursor waiting;
	try {
		const LayerStream* kept  = findValidStream(layer.cm);
		const bool valid         = kept != nullptr;
		const SharedBytes stream = valid ? kept->bytes : encodeForBrowsing(layer);
		const auto info          = readInfo(stream->data(), stream->size());
		if (info.ok()) {
			const int whole = wholeLevels(*info, stream->size()) - 1;
			const int shown = valid ? kept->level : whole;
			decodeAhead(layer, stream, shown);
			return {*info, std::max(whole, shown), shown};
		}
	}
	catch (const std::exception&) {
		// The filter itself will say what is wrong; a dialog has no way to.
	}
	return {};
}

void FilterWavemeshPlugin::decodeAhead(const MeshModel& layer, const SharedBytes& stream, int shown)
{
	const LayerStream* kept = findStream(layer.cm);
	if (kept != nullptr && kept->bytes == stream && LayerLevels::areOn(layer))
		return;
	ahead_           = std::make_shared<LevelDecoder>(stream);
	const int finest = ahead_->info().finestLevel();
	ahead_->goOn(shown < finest ? finest : finest - 1);
}

int FilterWavemeshPlugin::finestDetailLevel(const MeshModel& layer)
{
	const WaitCursor waiting;
	try {
		return pyramid_.of(layer, Wgc::On).finestLevel();
	}
	catch (const std::exception&) {
		return 0; // as above
	}
}

void FilterWavemeshPlugin::showCard(const QString& card)
{
	if (card == card_)
		return;
	for (QLabel* label : labelsThatSay(card_))
		label->setText(card);
	card_ = card;
}

void FilterWavemeshPlugin::watchDialog()
{
	QTimer::singleShot(0, this, [this] {
		for (QWidget* part : labelsThatSay(card_))
			for (; part != nullptr; part = part->parentWidget())
				if (qobject_cast<QDockWidget*>(part) != nullptr)
					part->installEventFilter(this);
	});
}

bool FilterWavemeshPlugin::eventFilter(QObject* dialog, QEvent* event)
{
	if (event->type() == QEvent::Close) {
		ahead_ = nullptr;
		dialog->removeEventFilter(this);
	}
	return QObject::eventFilter(dialog, event);
}
