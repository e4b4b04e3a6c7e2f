// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Hundreds of malformed .wmc in a real MeshLab, opened and browsed: it goes on, no layer appears,
/// and each message says what is wrong.
#include "test_host.h"

#include <shared/layer_stream.h>

#include <wavemesh/codec.h>

#include <QDir>
#include <QRegularExpression>

using namespace wavemesh;
using namespace wavemesh::test;

namespace {

struct BadFile
{
	QString name;
	QByteArray bytes;
};

/// Offsets of the chunks' first bytes, and the end.
std::vector<int> chunksOf(const QByteArray& file)
{
	std::vector<int> begins;
	for (int at = 8; at < file.size();) {
		begins.push_back(at++);
		int length = 0;
		for (int shift = 0;; shift += 7) {
			const auto b = static_cast<unsigned char>(file[at++]);
			length |= (b & 127) << shift;
			if (b < 128)
				break;
		}
		at += length + 4;
	}
	begins.push_back(file.size());
	return begins;
}

/// What befalls a file: bits, bytes, whole stretches, the order of its parts, its beginning.
void damage(const QString& name, const QByteArray& file, std::vector<BadFile>& out)
{
	const int size = file.size();
	const auto add = [&](const QString& what, const QByteArray& bytes) {
		out.push_back({name + ", " + what, bytes});
	};
	for (int i = 0; i < 9; ++i) { // the first bytes, the head, the levels, the end
		const int at   = i < 3 ? 3 * i : i < 6 ? 10 + 7 * i : (size - 1) * (i - 5) / 4 + (i == 9);
		QByteArray bit = file;
		bit[at]        = char(bit[at] ^ (1 << i % 8));
		add(QString("bit %1 of byte %2 the other way").arg(i % 8).arg(at), bit);
	}
	for (const int at : {9, 40, size / 2, size - 5})
		add(QString("byte %1 missing").arg(at), QByteArray(file).remove(at, 1));
	for (const int at : {8, 30, size / 3})
		add(QString("from byte %1 on zeros").arg(at), file.left(at) + QByteArray(size - at, '\0'));
	for (const int at : {0, 5, 7, 20})
		add(QString("cut to %1 bytes").arg(at), file.left(at));
	QByteArray text = file;
	add("as text", text.replace("\r\n", "\n"));
	add("twice its beginning", file.left(20) + file);
	add("without its magic", file.mid(8));
	const std::vector<int> chunks = chunksOf(file);
	if (chunks.size() > 3)
		add("two chunks exchanged",
		    file.left(chunks[1]) + file.mid(chunks[2], chunks[3] - chunks[2]) +
		        file.mid(chunks[1], chunks[2] - chunks[1]) + file.mid(chunks[3]));
	add("levels before the head",
	    file.left(8) + file.mid(chunks[1], chunks[2] - chunks[1]) + file.mid(8, chunks[1] - 8));
	QByteArray long_ = file;
	add("a chunk of any length", long_.replace(chunks[1] + 1, 1, QByteArray(10, '\xff')));
	QByteArray other = file;
	add("a magic of another kind", other.replace(0, 4, "\x89PNG"));
}

/// Files that MeshLab must refuse. Some change only what a cut file may lack: those may open.
std::vector<BadFile> badFiles()
{
	std::vector<BadFile> files;
	const QDir goldens(WAVEMESH_GOLDENS);
	for (const QString& name : goldens.entryList({"bad_*.wmc"}))
		files.push_back({name, contents(goldens.filePath(name))});
	for (const char* name :
	     {"good_sphere_lifted_0.wmc", "good_compact_not_manifold.wmc",
	      "good_compact_components.wmc", "good_terrain_wgc.wmc", "good_compact_24_bits.wmc",
	      "good_far_away_wide_head.wmc"})
		damage(name, contents(goldens.filePath(name)), files);
	damage("pebble.wmc", contents(sample("pebble.wmc")), files);
	damage("pieces.wmc", contents(sample("pieces.wmc")), files);
	return files;
}

/// Does a message tell a user anything: what was to be done, on which file, and a reason?
bool namesTheTrouble(const QString& message)
{
	static const QRegularExpression reason(
	    "empty|not a \\.wmc|ends|checksum|damaged|declares|version|impossible|not as long|none "
	    "that "
	    "may come|does not match|contradict|digest|not a manifold|outside|needs? |cannot",
	    QRegularExpression::CaseInsensitiveOption);
	return message.contains("bad.wmc") && reason.match(message).hasMatch();
}

} // namespace

TEST(DamagedFiles, TwoHundredAreRefusedWithoutALayerAndEachMessageSaysWhy)
{
	const std::vector<BadFile> files = badFiles();
	EXPECT_GE(files.size(), 200u);
	const QString path  = scratch("bad.wmc");
	std::size_t refused = 0;
	for (const BadFile& bad : files) {
		SCOPED_TRACE(qPrintable(bad.name));
		writeFile(path, bad.bytes);
		MeshLabHost& host     = freshHost();
		const QString message = messageOf([&] { host.open(path); });
		const QString warned  = host.takeWarnings();
		if (message.isEmpty()) {
			// It begins like the file that it was, and MeshLab says that the rest is missing.
			EXPECT_NE(warned, QString());
			EXPECT_EQ(host.document().meshNumber(), 1u);
			continue;
		}
		++refused;
		EXPECT_TRUE(namesTheTrouble(message)) << qPrintable(message);
		EXPECT_EQ(host.document().meshNumber(), 0u);
		EXPECT_NE(messageOf([&] { host.open(path, {{"all_levels", "true"}}); }), QString());
		EXPECT_EQ(host.document().meshNumber(), 0u);
	}
	EXPECT_GE(refused, 200u);
	EXPECT_EQ(freshHost().open(sample("pebble.wmc")).size(), 1u) << "MeshLab goes on";
}

TEST(DamagedFiles, BehindALayerAreRefusedByBrowsingAndTheLayerStaysAsItWas)
{
	for (const BadFile& bad : badFiles()) {
		SCOPED_TRACE(qPrintable(bad.name));
		MeshLabHost& host = freshHost();
		MeshModel& layer  = *host.open(sample("pebble.ply")).front();
		const int before  = layer.cm.vn;
		const auto* first = reinterpret_cast<const std::uint8_t*>(bad.bytes.constData());
		// As if a plugin of another version had left it there.
		LayerStream stream;
		stream.bytes =
		    std::make_shared<const std::vector<std::uint8_t>>(first, first + bad.bytes.size());
		stream.fingerprint = fingerprint(layer.cm, Extent::Shape);
		vcg::tri::Allocator<CMeshO>::GetPerMeshAttribute<LayerStream>(
		    layer.cm, "wavemesh.stream")() = stream;
		for (const char* level : {"0", "1", "1000"}) {
			const QString message = messageOf([&] {
				host.apply("Wavemesh: Browse Levels", {{"level", level}});
			});
			if (message.isEmpty())
				break; // a true level of a file that is cut
			EXPECT_GT(message.size(), 20) << qPrintable(message);
			EXPECT_EQ(host.document().meshNumber(), 1u);
		}
		EXPECT_GT(layer.cm.vn, 0);
		if (bad.bytes.size() < 8) {
			EXPECT_EQ(layer.cm.vn, before);
		}
	}
}
