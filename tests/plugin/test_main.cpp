// SPDX-License-Identifier: GPL-3.0-or-later
#include "test_host.h"

#include <QApplication>
#include <QFile>
#include <QTemporaryDir>

#include <stdexcept>

namespace wavemesh::test {

MeshLabHost& freshHost()
{
	static MeshLabHost host;
	static const bool loaded = [] {
		host.loadPlugins(WAVEMESH_STOCK_PLUGINS);
		host.loadPlugins(WAVEMESH_OUR_PLUGINS);
		return true;
	}();
	(void)loaded;
	host.clear();
	host.takeWarnings();
	return host;
}

QString scratch(const QString& name)
{
	static const QTemporaryDir folder;
	return folder.filePath(name);
}

QString sample(const QString& name)
{
	return QString(WAVEMESH_SAMPLES) + "/" + name;
}

QByteArray contents(const QString& file)
{
	QFile f(file);
	if (!f.open(QIODevice::ReadOnly))
		throw std::runtime_error("cannot read " + file.toStdString());
	return f.readAll();
}

void writeFile(const QString& file, const QByteArray& bytes)
{
	QFile f(file);
	if (!f.open(QIODevice::WriteOnly) || f.write(bytes) != bytes.size())
		throw std::runtime_error("cannot write " + file.toStdString());
}

} // namespace wavemesh::test

int main(int argc, char** argv)
{
	qputenv("QT_QPA_PLATFORM", "offscreen");
	qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
	QApplication app(argc, argv);
	testing::InitGoogleTest(&argc, argv);
	return RUN_ALL_TESTS();
}
