#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Writes the sample meshes and their .wmc anew; to be run, and the result committed, when a shape or
# the file format changes.
set -eu
if [ $# -ne 1 ] || [ ! -x "$1/wmc" ]; then
	echo "usage: samples/generate/generate.sh BUILD   (a build folder with wmc and generate_samples)" >&2
	exit 2
fi
build=$1
samples=$(dirname "$0")/..
"$(find "$build" -name generate_samples -type f -perm -u+x | head -n 1)" "$samples"
for mesh in "$samples"/*.ply; do
	echo "${mesh##*/}: $("$build/wmc" encode "$mesh" "${mesh%.ply}.wmc" | sed -n 1p)"
	"$build/wmc" verify "$mesh" "${mesh%.ply}.wmc" >&2
done
