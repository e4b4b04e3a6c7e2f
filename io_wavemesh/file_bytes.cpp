// SPDX-License-Identifier: GPL-3.0-or-later
#include "file_bytes.h"

#include <common/mlexception.h>

#include <QFile>
#include <QFileInfo>
#include <QSaveFile>

#include <algorithm>

namespace wavemesh {
namespace {

/// More than the largest mesh that DecodeLimits admits needs. A sparse file may claim any size.
constexpr std::uint64_t kLargestFile = std::uint64_t {4} << 30;

} // namespace

std::vector<std::uint8_t> readFile(const QString& name, std::uint64_t maxBytes)
{
	const QFileInfo found(name);
	if (found.exists() && !found.isFile()) // a pipe would have us wait for its writer
		throw MLException("Cannot read " + name + ": it is not a regular file.");
	QFile file(name);
	if (!file.open(QIODevice::ReadOnly))
		throw MLException("Cannot read " + name + ": " + file.errorString() + ".");
	const std::uint64_t wanted = std::min(std::uint64_t(file.size()), maxBytes);
	if (wanted > kLargestFile)
		throw MLException("Cannot read " + name + ": it is larger than any .wmc file can be.");

	std::vector<std::uint8_t> bytes(static_cast<std::size_t>(wanted));
	std::size_t have = 0;
	while (have < bytes.size()) {
		const qint64 got = file.read(
		    reinterpret_cast<char*>(bytes.data()) + have, static_cast<qint64>(bytes.size() - have));
		if (got < 0)
			throw MLException("Cannot read " + name + ": " + file.errorString() + ".");
		if (got == 0)
			break; // it became shorter meanwhile: the decoder says so
		have += std::size_t(got);
	}
	bytes.resize(have);
	return bytes;
}

void writeFile(const QString& name, const std::vector<std::uint8_t>& bytes)
{
	QSaveFile file(name);
	const auto size = static_cast<qint64>(bytes.size());
	if (!file.open(QIODevice::WriteOnly) ||
	    file.write(reinterpret_cast<const char*>(bytes.data()), size) != size ||
	    !file.flush() || // commit() would put what a full disk left in the old file's place
	    !file.commit())
		throw MLException("Cannot write " + name + ": " + file.errorString() + ".");
}

} // namespace wavemesh
