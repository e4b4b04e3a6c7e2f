// SPDX-License-Identifier: GPL-3.0-or-later
#include "io_wavemesh.h"

#include "file_bytes.h"
#include "shared/encode_parameters.h"
#include "shared/encode_presets.h"
#include "shared/layer_attributes.h"
#include "shared/layer_stream.h"
#include "shared/level_file.h"
#include "shared/plugin_support.h"

#include <QFileInfo>

#include <limits>

using namespace wavemesh;

namespace {

constexpr char kExtension[] = "WMC";

/// What the open dialog asks.
struct OpenRequest
{
	int level              = kFinestLevel;
	std::uint64_t maxBytes = std::numeric_limits<std::uint64_t>::max();
	bool allLevels         = false;

	explicit OpenRequest(const RichParameterList& parameters) :
	        level(integerOf(parameters, "level", kFinestLevel)),
	        allLevels(flagOf(parameters, "all_levels", false))
	{
		const int limit = integerOf(parameters, "max_bytes", 0);
		if (limit > 0)
			maxBytes = std::uint64_t(limit);
	}
};

/// Reads what the request asks for. The head comes first: a large file of another kind is refused
/// after a few pages. One byte more than the head declares is read, so that the decoder sees an
/// appendix.
SharedBytes readWmc(const QString& fileName, const OpenRequest& request)
{
	constexpr std::uint64_t kEnoughForAHead = 1 << 16;

	std::uint64_t limit = request.maxBytes;
	const auto head     = readFile(fileName, std::min(limit, kEnoughForAHead));
	const auto info     = readInfo(head.data(), head.size());
	if (info.ok())
		limit = std::min(limit, info->bytes + 1);
	else if (info.status().code != StatusCode::Truncated || head.size() < kEnoughForAHead)
		require(info.status(), "Cannot open " + QFileInfo(fileName).fileName());
	return std::make_shared<const std::vector<std::uint8_t>>(readFile(fileName, limit));
}

/// Shows `data`, level `level` of `stream`, and leaves the stream on the layer for filter_wavemesh.
/// @return what came from the file, for MeshLab: bits of vcg::tri::io::Mask
int fillLayer(MeshModel& layer, const MeshData& data, int level, SharedBytes stream)
{
	LooseMesh loose = makeMesh(data);
	const int mask  = loose.fileMask;
	if (channelsOf(data) & kTransform)
		layer.cm.Tr = loose.mesh->Tr;
	exchangeMesh(layer, std::move(loose));
	keepStream(layer.cm, std::move(stream), level);
	return mask;
}

/// Throws what is wrong with a file, if anything.
void requireOpened(const Status& status, const QString& fileName)
{
	if (status.code == StatusCode::LimitExceeded)
		throw MLException(
		    "Cannot open " + fileName + ": " + explain(status) +
		    " The command wmc decode has options to raise this limit.");
	require(status, "Cannot open " + fileName);
}

/// For the progress bar.
std::string doing(const char* what, const QString& fileName)
{
	return what + (" " + QFileInfo(fileName).fileName().toStdString()) + "...";
}

/// "18 432 bytes" and the like.
QString byteCount(std::uint64_t bytes)
{
	return QString::number(bytes) + " bytes";
}

} // namespace

QString IOWavemeshPlugin::pluginName() const
{
	return "IOWavemesh";
}

QString IOWavemeshPlugin::vendor() const
{
	return "Wavemesh";
}

std::list<FileFormat> IOWavemeshPlugin::importFormats() const
{
	return {FileFormat("Wavemesh progressive compressed mesh", QString(kExtension))};
}

std::list<FileFormat> IOWavemeshPlugin::exportFormats() const
{
	return importFormats();
}

RichParameterList IOWavemeshPlugin::initPreOpenParameter(const QString& format) const
{
	RichParameterList list;
	if (format.toUpper() != kExtension)
		return list;
	list.addParam(RichInt(
	    "level", kFinestLevel, "Level",
	    "Level of detail to open: 0 is the base mesh, the coarsest; -1, or a number larger than "
	    "the file has levels, is the finest, the whole mesh. The other levels stay at hand: see "
	    "the filter <i>Wavemesh: Browse Levels</i>."));
	list.addParam(RichInt(
	    "max_bytes", 0, "Max. bytes (0 = whole file)",
	    "Read no more than so many bytes of the file, and show the finest level that they hold."));
	list.addParam(RichBool(
	    "all_levels", false, "All levels as layers",
	    "Open every level, from the base mesh up to the level above, as a layer of its own."));
	return list;
}

unsigned int IOWavemeshPlugin::numberMeshesContainedInFile(
    const QString& format, const QString& fileName, const RichParameterList& parameters) const
{
	return guarded([&]() -> unsigned int {
		const OpenRequest request(parameters);
		if (format.toUpper() != kExtension || !request.allLevels)
			return 1;
		const SharedBytes bytes = readWmc(levelFile(fileName).file, request);
		const auto info         = readInfo(bytes->data(), bytes->size());
		require(info.status(), "Cannot open " + QFileInfo(fileName).fileName());
		int count = wholeLevels(*info, bytes->size());
		if (request.level >= 0)
			count = std::min(count, request.level + 1);
		return unsigned(std::max(count, 1));
	});
}

void IOWavemeshPlugin::open(
    const QString& format,
    const QString& name,
    const std::list<MeshModel*>& layers,
    std::list<int>& masks,
    const RichParameterList& parameters,
    vcg::CallBackPos* cb)
{
	guarded([&] {
		const OpenRequest request(parameters);
		if (layers.size() == 1 && !request.allLevels) {
			masks.push_back(0);
			return open(format, name, *layers.front(), masks.back(), parameters, cb);
		}
		if (format.toUpper() != kExtension)
			wrongOpenFormat(format);
		const QString fileName = levelFile(name).file;
		const auto bytes       = readWmc(fileName, request);
		auto decoder           = Decoder::open(bytes->data(), bytes->size());
		const auto progress    = progressBar(cb, doing("Decoding all levels of", fileName));
		requireOpened(decoder.status(), fileName);
		const int finest = decoder->info().finestLevel();
		const std::vector<double> shares =
		    decodingShares(decoder->info(), std::min(finest, int(layers.size()) - 1));
		double before = 0; // of the time, when the level begins
		for (MeshModel* layer : layers) {
			const double after     = shares[std::min(masks.size(), shares.size() - 1)];
			const Progress ofLevel = [&](double fraction) {
				return !progress || progress(before + fraction * (after - before));
			};
			require(decoder->advance(ofLevel), "Cannot open " + fileName);
			masks.push_back(fillLayer(*layer, decoder->mesh(), decoder->level(), bytes));
			layer->setLabel(levelLabel(QFileInfo(fileName).fileName(), decoder->level(), finest));
			// Each a layer by itself, for projects and when it is reloaded.
			layer->setIdInFile(-1);
			nameLevelFile(*layer, decoder->level(), finest);
			before = after;
		}
		log(QString("Opened levels 0 to %1 of %2 from %3.")
		        .arg(decoder->level())
		        .arg(finest)
		        .arg(byteCount(bytes->size()))
		        .toStdString());
		if (bytes->size() < decoder->info().bytes && bytes->size() < request.maxBytes)
			reportWarning(QString("%1 is truncated: %2 of its %3 levels are whole.")
			                  .arg(fileName)
			                  .arg(wholeLevels(decoder->info(), bytes->size()))
			                  .arg(finest + 1));
	});
}

void IOWavemeshPlugin::open(
    const QString& format,
    const QString& name,
    MeshModel& layer,
    int& mask,
    const RichParameterList& parameters,
    vcg::CallBackPos* cb)
{
	guarded([&] {
		if (format.toUpper() != kExtension)
			wrongOpenFormat(format);
		const Stopwatch watch;
		const auto [fileName, named] = levelFile(name);
		OpenRequest request(parameters);
		if (request.level < 0)
			request.level = named;
		const SharedBytes bytes = readWmc(fileName, request);

		DecodeOptions options;
		options.level      = request.level;
		options.progress   = progressBar(cb, doing("Decoding", fileName));
		const auto decoded = decode(bytes->data(), bytes->size(), options);
		if (!decoded.hasValue())
			requireOpened(decoded.status(), fileName);

		const StreamInfo& info = decoded->info;
		const bool whole       = decoded->level < wholeLevels(info, bytes->size());
		mask                   = fillLayer(layer, decoded->mesh, decoded->level, bytes);
		const QString label    = named < 0 ? layer.label() : QFileInfo(fileName).fileName();
		layer.setLabel(
		    decoded->level == info.finestLevel() && whole
		        ? plainLabel(label)
		        : levelLabel(label, decoded->level, info.finestLevel()));
		nameLevelFile(layer, decoded->level, info.finestLevel());
		if (decoded.status().code == StatusCode::Truncated && bytes->size() < request.maxBytes)
			reportWarning(QString("%1 is truncated: it has %2 of %3. Level %4 of %5 is shown%6.")
			                  .arg(fileName, QString::number(bytes->size()), byteCount(info.bytes))
			                  .arg(decoded->level)
			                  .arg(info.finestLevel())
			                  .arg(whole ? "" : ", in part predicted"));
		log(QString("Opened level %1 of %2: %3 vertices, %4 faces, from %5 in %6 s.")
		        .arg(decoded->level)
		        .arg(info.finestLevel())
		        .arg(layer.cm.vn)
		        .arg(layer.cm.fn)
		        .arg(byteCount(bytes->size()))
		        .arg(watch.seconds(), 0, 'f', 2)
		        .toStdString());
	});
}

void IOWavemeshPlugin::exportMaskCapability(const QString&, int& capability, int& defaultBits) const
{
	capability  = saveCapability();
	defaultBits = saveDefault();
}

RichParameterList
IOWavemeshPlugin::initSaveParameter(const QString& format, const MeshModel& layer) const
{
	RichParameterList list;
	if (format.toUpper() != kExtension)
		return list;
	// A layer that came from a .wmc goes back as precise as it was.
	EncodeOptions defaults;
	if (const LayerStream* stream = findStream(layer.cm)) {
		const auto info = readInfo(stream->bytes->data(), stream->bytes->size());
		if (info.ok()) {
			defaults.bits = info->bits;
			if (info->mode == Mode::Classic) // compact files have none
				defaults.lifting = info->lifting;
		}
	}
	list.addParam(RichEnum("preset", int(Preset::Custom), presetNames(), "Preset", presetHelp()));
	addEncodeParameters(list, defaults);
	addPromiseParameters(list);
	addAttributeParameters(list);
	list.addParam(RichBool(
	    "custom", false, "User-defined attributes",
	    "Keep the layer's user-defined attributes of vertices and faces, those that are numbers or "
	    "points."));
	return list;
}

void IOWavemeshPlugin::save(
    const QString& format,
    const QString& fileName,
    MeshModel& layer,
    const int mask,
    const RichParameterList& parameters,
    vcg::CallBackPos* cb)
{
	guarded([&] {
		if (format.toUpper() != kExtension)
			wrongSaveFormat(format);
		EncodeOptions options = encodeOptions(parameters, {});
		const int preset      = integerOf(parameters, "preset", int(Preset::Custom));
		if (preset < 0 || preset > int(Preset::Exact))
			throw MLException("Wavemesh: 'preset' has to be 0 to 4.");
		options = optionsOf(Preset(preset), options);

		const Stopwatch watch;
		options.progress  = progressBar(cb, doing("Encoding", fileName));
		unsigned channels = channelsOf(layer, mask);
		if (flagOf(parameters, "custom", false))
			channels |= kCustom;
		MeshData data = meshDataOf(layer, channels);
		setAttributeBits(parameters, options.exact, data);
		const auto encoded = encode(data, options);
		require(encoded.status(), "Cannot save " + fileName);
		writeFile(fileName, encoded->bytes);

		// Not reportWarning(): MeshLab shows what that collects after the next opening.
		const QStringList lost = attributesNotKept(layer, channels);
		if (!lost.isEmpty())
			log(GLLogStream::WARNING, ("Not saved: " + lost.join(", ") + ".").toStdString());
		const QStringList rounded = attributesRounded(encoded->info);
		if (!rounded.isEmpty())
			log(("Rounded: " + rounded.join(", ") + ".").toStdString());
		const double bytes     = double(encoded->bytes.size());
		const double ofShape   = bytes - double(encoded->info.features.attributeBytes);
		const double binaryPly = 12.0 * layer.cm.vn + 13.0 * layer.cm.fn;
		log(QString("Saved %1: %2 in %3 levels, %4 bits per vertex, 1/%5 of a binary PLY, %6 s.")
		        .arg(QFileInfo(fileName).fileName(), byteCount(encoded->bytes.size()))
		        .arg(encoded->info.levels.size())
		        .arg(8 * bytes / layer.cm.vn, 0, 'f', 2)
		        .arg(binaryPly / ofShape, 0, 'f', 1)
		        .arg(watch.seconds(), 0, 'f', 2)
		        .toStdString());
		if (encoded->info.features.attributes)
			log(("Of these, colours and all else besides the shape: " +
			     byteCount(encoded->info.features.attributeBytes) + ", not in the ratio to a PLY.")
			        .toStdString());
	});
}

MESHLAB_PLUGIN_NAME_EXPORTER(IOWavemeshPlugin)
