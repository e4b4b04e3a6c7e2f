// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <common/plugins/interfaces/io_plugin.h>

/// Opens and saves `.wmc` files. Translates between MeshLab and the codec, and does nothing else.
class IOWavemeshPlugin : public QObject, public IOPlugin
{
	Q_OBJECT
	MESHLAB_PLUGIN_IID_EXPORTER(IO_PLUGIN_IID)
	Q_INTERFACES(IOPlugin)

public:
	QString pluginName() const override;
	QString vendor() const override;

	std::list<FileFormat> importFormats() const override;
	std::list<FileFormat> exportFormats() const override;

	RichParameterList initPreOpenParameter(const QString& format) const override;

	/// 1, or with "all levels as layers" the number of levels that the file (up to max. bytes)
	/// holds whole.
	/// @throws MLException if the file is none that can be opened
	unsigned int numberMeshesContainedInFile(
	    const QString& format,
	    const QString& fileName,
	    const RichParameterList& parameters) const override;

	/// Opens one level on every layer of `layers`: the first gets the base mesh. With one layer,
	/// the level that the parameters ask for.
	void open(
	    const QString& format,
	    const QString& fileName,
	    const std::list<MeshModel*>& layers,
	    std::list<int>& masks,
	    const RichParameterList& parameters,
	    vcg::CallBackPos* cb = nullptr) override;
	void open(
	    const QString& format,
	    const QString& fileName,
	    MeshModel& layer,
	    int& mask,
	    const RichParameterList& parameters,
	    vcg::CallBackPos* cb = nullptr) override;

	void
	exportMaskCapability(const QString& format, int& capability, int& defaultBits) const override;
	RichParameterList
	initSaveParameter(const QString& format, const MeshModel& layer) const override;
	void save(
	    const QString& format,
	    const QString& fileName,
	    MeshModel& layer,
	    const int mask,
	    const RichParameterList& parameters,
	    vcg::CallBackPos* cb = nullptr) override;
};
