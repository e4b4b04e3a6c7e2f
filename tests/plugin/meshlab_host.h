// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// A headless MeshLab: the plugin manager, documents and filters of libmeshlab-common, without
/// windows or OpenGL. What a script, PyMeshLab or the command line can do with a plugin can be done
/// here, in the same way and through the same code.
///
/// Needs a QApplication (QT_QPA_PLATFORM=offscreen will do). Every failure is an MLException, as in
/// MeshLab itself.
#pragma once

#include <common/ml_document/mesh_document.h>

#include <QMap>
#include <QString>
#include <QVariant>

#include <list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

class RichParameterList;

namespace wavemesh {

class MeshLabHost
{
public:
	/// Parameters by name, with the values as text; those not named keep the plugin's default.
	using Settings = QMap<QString, QString>;
	/// What a filter reports.
	using Results = std::map<std::string, QVariant>;

	struct ScriptStep
	{
		QString filter;
		Results results;
	};

	MeshLabHost();
	~MeshLabHost();

	/// Loads one plugin, or all of a folder.
	void loadPlugins(const QString& fileOrFolder);

	/// Opens a mesh file as one or more new layers; the last becomes the current one. A document
	/// keeps no layer of a file that could not be opened.
	std::list<MeshModel*> open(const QString& file, const Settings& settings = {});
	/// Reads a layer's file anew, with the plugin's defaults.
	void reload(MeshModel& layer);
	/// Saves the current layer.
	/// @param mask  what to save of it, bits of vcg::tri::io::Mask; without, what the plugin has
	///              chosen at first
	void save(const QString& file, const Settings& settings = {}, std::optional<int> mask = {});
	/// Saves the document as a project (.mlp), and the layers too, as files beside it, if asked.
	void saveProject(const QString& file, bool layersToo = true);
	/// Opens a project: its layers are added to the document.
	void openProject(const QString& file);
	/// What the plugins warned about while opening and saving since the last call.
	QString takeWarnings();

	/// Does what MeshLab does before the dialog of a filter appears, and no more.
	/// @return what would be in it
	RichParameterList openDialog(const QString& filter);
	/// Applies a filter, by the name it has in the menus, to the document.
	Results apply(const QString& filter, const Settings& settings = {});
	/// The same with nothing but the document, as MeshLab's own script runner does it: without a
	/// look at what the filter needs.
	void applyUnchecked(const QString& filter);
	/// Runs a filter script. As in MeshLab a filter gets the parameters in the script and no
	/// others.
	std::vector<ScriptStep> run(const QString& script);

	MeshDocument& document() { return *document_; }
	/// The current layer. @pre there is one
	MeshModel& mesh() { return *document_->mm(); }
	/// Forgets all layers.
	void clear();

private:
	Results apply(const QString& filter, const RichParameterList& parameters);

	std::unique_ptr<MeshDocument> document_;
};

} // namespace wavemesh
