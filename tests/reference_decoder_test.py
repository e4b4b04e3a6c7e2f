#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Decodes files with tests/reference_decoder.py and compares with what the codec makes of them.

    reference_decoder_test.py WMC FOLDER_FOR_OUTPUT FILE.wmc...     with wmc: positions and faces of every level
    reference_decoder_test.py --index INDEX.txt                     with the goldens' index: outcome, level, and every
                                                                    number of the mesh, attributes too, bit for bit
    reference_decoder_test.py --example FORMAT.md FILE.wmc          the example in the format's document: its bytes, and
                                                                    what the document says of them
"""

import os
import struct
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import reference_decoder as reference  # noqa: E402


def read_file(path):
    with open(path, "rb") as source:
        return source.read()


def read_obj(path):
    vertices, faces = [], []
    with open(path) as source:
        for line in source:
            words = line.split()
            if words and words[0] == "v":
                vertices.append(tuple(map(float, words[1:4])))
            elif words and words[0] == "f":
                faces.append(tuple(int(word.split("/")[0]) - 1 for word in words[1:]))
    return vertices, faces


def is_same(mesh, written):
    """A polygon in the file stands for triangles; which ones --index compares."""
    if any(len(face) > 3 for face in written[1]):
        mesh, written = ((vertices, sum(len(face) - 2 for face in faces)) for vertices, faces in (mesh, written))
    return repr(mesh) == repr(written)  # as text: numbers that are none are not equal to themselves


class EveryLevel(reference.Decoder):
    """Keeps the mesh of each level that it comes past"""

    def __init__(self, data):
        super().__init__(data)
        self.meshes = []

    def read_level(self, decoder, i):
        whole = super().read_level(decoder, i)
        if whole and i < self.head.J:
            self.meshes.append(self.result())
        return whole


def differences(wmc, folder, path):
    decoder = EveryLevel(read_file(path))
    try:
        decoder.decode(decoder.head.J)
    except reference.Outcome as outcome:
        return "behind level %d: %s, %s" % (decoder.level, outcome.name, outcome.why)
    for level, mesh in enumerate(decoder.meshes + [decoder.result()]):
        output = os.path.join(folder, os.path.basename(path) + ".obj")
        done = subprocess.run([wmc, "decode", path, output, "--level", str(level)], capture_output=True,
                              text=True, errors="backslashreplace")
        if done.returncode != 0:
            return "wmc: " + done.stderr
        if not is_same(mesh, read_obj(output)):
            return "level %d: another mesh" % level
    return None


def fnv(parts):
    """FNV-1a of 64 bits"""
    value = 0xcbf29ce484222325
    for part in parts:
        for byte in part:
            value = (value ^ byte) * 0x100000001b3 & 0xFFFFFFFFFFFFFFFF
    return value


def fingerprint(decoder):
    """As tests/unit/codec_check.cpp has it"""
    vertices, faces = decoder.result()
    parts = [struct.pack("<3d", *p) for p in vertices] + [struct.pack("<3I", *t) for t in faces]
    if decoder.attributes:
        for _, rows in decoder.attributes.values():
            parts += [struct.pack("<%dd" % len(row), *row) for row in rows]
    return fnv(parts + list(decoder.head.textures))


def index_line(path):
    status, level, digest = 0, -1, 0
    decoder = None
    try:
        decoder = reference.Decoder(read_file(path))
        decoder.decode(decoder.head.J)
    except reference.Outcome as outcome:
        status = reference.OUTCOMES[outcome.name]
    if status in (0, reference.OUTCOMES["Truncated"]) and decoder and decoder.level != reference.NONE:
        level, digest = decoder.level, fingerprint(decoder)
    return "%s %d %d %x" % (os.path.basename(path), status, level, digest)


def compare_with_index(index):
    with open(index) as source:
        lines = [line.strip() for line in source if line.strip() and not line.startswith("#")]
    failed = 0
    for line in lines:
        found = index_line(os.path.join(os.path.dirname(index), line.split()[0]))
        print(found if found == line else "%s\n    but the index has\n%s" % (found, line), flush=True)
        failed += found != line
    return failed or not lines


def example_in(text):
    """The bytes of the document's example, told apart from other blocks by the magic"""
    at = text.index("    8b 57 4d 43 ")
    return bytes.fromhex(text[at:text.index("\n\n", at)])


def describe_example(data):
    """The rows of the tables in the document's Appendix B"""
    head = reference.Decoder(data).head

    def row(name, cells):
        return "| %s | %s |" % (name, " | ".join(map(str, cells)))

    def points(rows):
        return " ".join("(%d %d %d)" % tuple(row) for row in rows).replace("-", "\N{MINUS SIGN}")

    rows = [row(name, getattr(head, name)) for name in ("vertices", "faces", "bytes", "connectivity", "error", "ends")]
    rows.append(row("prefix", reference.level_prefixes(head, reference.read_head(data)[1])))
    for level in range(head.J + 1):
        decoder = reference.Decoder(data)
        decoder.decode(level)
        faces = decoder.result()[1]
        rows.append(row(level, [points(decoder.positions), points(faces)]))
    return rows


def compare_with_document(path, example):
    with open(path) as source:
        text = source.read()
    data = read_file(example)
    failed = example_in(text) != data
    if failed:
        print("the document has other bytes than", example)
    for row in describe_example(data):
        print(row if row in text else row + "\n    is not in the document", flush=True)
        failed += row not in text
    return failed


def compare_with_wmc(wmc, folder, files):
    os.makedirs(folder, exist_ok=True)
    failed = 0
    for path in files:
        wrong = differences(wmc, folder, path)
        print(os.path.basename(path), wrong or "the same", flush=True)
        failed += wrong is not None
    return failed or not files


def main():
    if sys.argv[1] == "--index":
        return 1 if compare_with_index(sys.argv[2]) else 0
    if sys.argv[1] == "--example":
        return 1 if compare_with_document(*sys.argv[2:]) else 0
    return 1 if compare_with_wmc(sys.argv[1], sys.argv[2], sys.argv[3:]) else 0


if __name__ == "__main__":
    sys.exit(main())
