#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Sets up as samples/run.sh does, then runs every test: codec, tool, plugins in a headless MeshLab
# and in MeshLab's window, and the codec's tests again under sanitizers.
# usage: tests/run.sh [arguments for ctest, such as -R io_wavemesh]
set -euo pipefail
if [[ ${1:-} == -h || ${1:-} == --help ]]; then
	sed -n '3,5s/^# //p' "${BASH_SOURCE[0]}"
	exit 0
fi
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# shellcheck source=cmake/setup.sh
. cmake/setup.sh

set_up "${packages_build[@]}" "${packages_tests[@]}"
make_meshlab_folder
get_meshlab_2022

configure meshlab "-DWAVEMESH_MESHLAB_2022_DIR=$meshlab_2022_source" \
	"-DWAVEMESH_SANITIZE_BUILD_DIR=$root/build-sanitize"
build_targets "Building Wavemesh: codec, tool, plugins and tests" "$build"

configure sanitize "-DWAVEMESH_VCGLIB_DIR=$meshlab_source/src/vcglib" -DWAVEMESH_BUILD_TOOLS=OFF
build_targets "Building codec and tests with sanitizers" "$root/build-sanitize"

say "-- Testing"
ctest --test-dir "$build" --output-on-failure --no-tests=error -j "$(nproc)" "$@" </dev/null
