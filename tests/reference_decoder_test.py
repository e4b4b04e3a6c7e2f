#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Decodes files with tests/reference_decoder.py and with wmc, and compares: every position, every face. Attributes
are compared with their digest in the file, by both.

    reference_decoder_test.py WMC FOLDER_FOR_OUTPUT FILE.wmc...
"""

import os
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import reference_decoder as reference  # noqa: E402


def read_obj(path):
    vertices, faces = [], []
    with open(path) as source:
        for line in source:
            words = line.split()
            if words and words[0] == "v":
                vertices.append(tuple(map(float, words[1:4])))
            elif words and words[0] == "f":
                faces.append(tuple(int(word.split("/")[0]) - 1 for word in words[1:4]))
    return vertices, faces


def differences(wmc, folder, path):
    with open(path, "rb") as source:
        data = source.read()
    last = reference.Decoder(data).head.J
    for level in sorted({0, last // 2, last}):
        output = os.path.join(folder, os.path.basename(path) + ".obj")
        done = subprocess.run([wmc, "decode", path, output, "--level", str(level)], capture_output=True, text=True)
        if done.returncode != 0:
            return "wmc: " + done.stderr
        decoder = reference.Decoder(data)
        try:
            decoder.decode(level)
        except reference.Outcome as outcome:
            return "level %d: %s, %s" % (level, outcome.name, outcome.why)
        vertices, faces = decoder.result()
        if (vertices, faces) != read_obj(output):
            return "level %d: another mesh" % level
    return None


def main():
    wmc, folder, files = sys.argv[1], sys.argv[2], sys.argv[3:]
    os.makedirs(folder, exist_ok=True)
    failed = 0
    for path in files:
        wrong = differences(wmc, folder, path)
        print(os.path.basename(path), wrong or "the same", flush=True)
        failed += wrong is not None
    return 1 if failed or not files else 0


if __name__ == "__main__":
    sys.exit(main())
