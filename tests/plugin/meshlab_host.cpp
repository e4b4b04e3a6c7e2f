// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshlab_host.h"

#include <common/filterscript.h>
#include <common/globals.h>
#include <common/mlexception.h>
#include <common/parameters/rich_parameter_list.h>
#include <common/plugins/plugin_manager.h>
#include <common/utilities/load_save.h>

#include <QAction>
#include <QDir>
#include <QFileInfo>

#include <utility>

namespace wavemesh {

namespace {

/// MeshLab goes to the file's folder to open it and stays there if that fails.
class KeepCurrentFolder
{
public:
	KeepCurrentFolder() : folder_(QDir::currentPath()) {}
	KeepCurrentFolder(const KeepCurrentFolder&)            = delete;
	KeepCurrentFolder& operator=(const KeepCurrentFolder&) = delete;
	~KeepCurrentFolder() { QDir::setCurrent(folder_); }

private:
	QString folder_;
};

bool progress(const int, const char*)
{
	return true;
}

void setFromText(RichParameter& parameter, const QString& text)
{
	bool ok = true;
	if (parameter.value().isBool())
		parameter.setValue(BoolValue(text == "true" || text == "1"));
	else if (parameter.value().isInt())
		parameter.setValue(IntValue(text.toInt(&ok)));
	else if (parameter.value().isFloat())
		parameter.setValue(FloatValue(Scalarm(text.toDouble(&ok))));
	else if (parameter.value().isString())
		parameter.setValue(StringValue(text));
	else
		ok = false;
	if (!ok)
		throw MLException("Parameter " + parameter.name() + " cannot be '" + text + "'");
}

void set(RichParameterList& parameters, const MeshLabHost::Settings& settings)
{
	for (auto it = settings.begin(); it != settings.end(); ++it) {
		if (!parameters.hasParameter(it.key()))
			throw MLException("There is no parameter " + it.key());
		setFromText(parameters.getParameterByName(it.key()), it.value());
	}
}

PluginManager& plugins()
{
	return meshlab::pluginManagerInstance();
}

QAction* actionOf(const QString& filter)
{
	QAction* const action = plugins().filterAction(filter);
	if (action == nullptr)
		throw MLException("There is no filter " + filter);
	return action;
}

} // namespace

MeshLabHost::MeshLabHost() : document_(std::make_unique<MeshDocument>()) {}

MeshLabHost::~MeshLabHost() = default;

void MeshLabHost::clear()
{
	document_ = std::make_unique<MeshDocument>();
}

void MeshLabHost::loadPlugins(const QString& fileOrFolder)
{
	if (QFileInfo(fileOrFolder).isDir())
		plugins().loadPlugins(QDir(fileOrFolder));
	else
		plugins().loadPlugin(fileOrFolder);
}

std::list<MeshModel*> MeshLabHost::open(const QString& file, const Settings& settings)
{
	const KeepCurrentFolder keep;
	RichParameterList parameters;
	if (!settings.isEmpty()) {
		const QString format   = QFileInfo(file).suffix();
		IOPlugin* const plugin = plugins().inputMeshPlugin(format);
		if (plugin == nullptr)
			throw MLException("No plugin opens ." + format);
		parameters = plugin->initPreOpenParameter(format);
		set(parameters, settings);
	}
	auto layers = meshlab::loadMeshWithStandardParameters(
	    QFileInfo(file).absoluteFilePath(), *document_, progress, parameters);
	for (MeshModel* layer : layers)
		document_->setCurrentMesh(int(layer->id()));
	return layers;
}

void MeshLabHost::save(const QString& file, const Settings& settings, std::optional<int> mask)
{
	const KeepCurrentFolder keep;
	const QString format   = QFileInfo(file).suffix().toLower();
	IOPlugin* const plugin = plugins().outputMeshPlugin(format);
	if (plugin == nullptr)
		throw MLException("No plugin saves ." + format);
	plugin->setLog(&document_->Log);
	int capability = 0, chosen = 0;
	plugin->exportMaskCapability(format, capability, chosen);
	RichParameterList parameters = plugin->initSaveParameter(format, mesh());
	set(parameters, settings);
	plugin->save(
	    format, QFileInfo(file).absoluteFilePath(), mesh(), mask.value_or(chosen), parameters,
	    progress);
}

void MeshLabHost::reload(MeshModel& layer)
{
	const KeepCurrentFolder keep;
	meshlab::reloadMesh(layer.fullName(), {&layer}, &document_->Log, progress);
}

void MeshLabHost::saveProject(const QString& file, bool layersToo)
{
	const KeepCurrentFolder keep;
	if (layersToo) // MeshLab's "Save All Files"
		meshlab::saveAllMeshes(QFileInfo(file).absolutePath(), *document_);
	meshlab::saveProject(QFileInfo(file).absoluteFilePath(), *document_, false);
}

void MeshLabHost::openProject(const QString& file)
{
	const KeepCurrentFolder keep;
	meshlab::loadProject(QFileInfo(file).absoluteFilePath(), *document_);
}

QString MeshLabHost::takeWarnings()
{
	QString warnings;
	for (IOPlugin* plugin : plugins().ioPluginIterator())
		warnings += plugin->warningMessageString();
	return warnings.trimmed();
}

MeshLabHost::Results MeshLabHost::apply(const QString& filter, const RichParameterList& parameters)
{
	QAction* const action      = actionOf(filter);
	FilterPlugin* const plugin = plugins().getFilterPluginFromAction(action);
	plugin->setLog(&document_->Log);
	QStringList missing;
	if (document_->mm() != nullptr) {
		if (!plugin->isFilterApplicable(action, mesh(), missing))
			throw MLException(filter + " does not apply, for lack of " + missing.join(", "));
		mesh().updateDataMask(plugin->getRequirements(action));
	}
	unsigned int changed = MeshModel::MM_UNKNOWN;
	Results results      = plugin->applyFilter(action, parameters, *document_, changed, progress);
	for (MeshModel& m : document_->meshIterator())
		vcg::tri::Allocator<CMeshO>::CompactEveryVector(m.cm);
	return results;
}

void MeshLabHost::applyUnchecked(const QString& filter)
{
	QAction* const action      = actionOf(filter);
	FilterPlugin* const plugin = plugins().getFilterPluginFromAction(action);
	unsigned int changed       = MeshModel::MM_UNKNOWN;
	plugin->setLog(&document_->Log);
	plugin->applyFilter(action, RichParameterList(), *document_, changed, progress);
}

static RichParameterList parametersOf(const QString& filter, const MeshDocument& document)
{
	QAction* const action = actionOf(filter);
	return plugins().getFilterPluginFromAction(action)->initParameterList(action, document);
}

RichParameterList MeshLabHost::openDialog(const QString& filter)
{
	return parametersOf(filter, *document_);
}

MeshLabHost::Results MeshLabHost::apply(const QString& filter, const Settings& settings)
{
	RichParameterList parameters = parametersOf(filter, *document_);
	set(parameters, settings);
	return apply(filter, parameters);
}

std::vector<MeshLabHost::ScriptStep> MeshLabHost::run(const QString& script)
{
	FilterScript steps;
	if (!steps.open(script))
		throw MLException("Not a filter script: " + script);
	std::vector<ScriptStep> done;
	for (const FilterNameParameterValuesPair& step : steps)
		done.push_back({step.first, apply(step.first, step.second)});
	return done;
}

} // namespace wavemesh
