// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The headless MeshLab that the plugin tests share, and what they ask of it again and again.
#pragma once

#include "meshlab_host.h"

#include <common/mlexception.h>

#include <gtest/gtest.h>

#include <QByteArray>
#include <QString>

namespace wavemesh::test {

/// The host with the stock and our plugins loaded, and no layers: the former ones are gone.
MeshLabHost& freshHost();

/// A file of this name in a folder that is empty at the start and removed at the end of the
/// process.
QString scratch(const QString& name);

/// A mesh in samples/.
QString sample(const QString& name);

QByteArray contents(const QString& file);
void writeFile(const QString& file, const QByteArray& bytes);

/// The message of the MLException that `f` throws, or an empty string if it throws none. Anything
/// else that escapes would have ended MeshLab, and ends the test.
template <class F>
QString messageOf(F&& f)
{
	try {
		f();
	}
	catch (const MLException& e) {
		return QString::fromUtf8(e.what());
	}
	return {};
}

} // namespace wavemesh::test
