#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What samples/run.sh and tests/run.sh share: packages, MeshLab, and our own build. Sourced by them.
#
# Outside the clone only two things change: Debian packages get installed, and
# ${XDG_CACHE_HOME:-~/.cache}/wavemesh holds MeshLab, so that another clone does not build it again.

set -euo pipefail

# The usual tools only, in one language: error messages are searched for below.
export LC_ALL=C.UTF-8

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build
logs=$build/logs
cache=${XDG_CACHE_HOME:-$HOME/.cache}/wavemesh
mkdir -p "$logs" "$cache"

# shellcheck source=cmake/get_meshlab.sh
. "$root/cmake/get_meshlab.sh"

# Read by those who source this.
# shellcheck disable=SC2034
packages_build=(g++ cmake ninja-build xz-utils
	qtbase5-dev libqt5opengl5-dev libglew-dev libglu1-mesa-dev libeigen3-dev
	libcli11-dev nlohmann-json3-dev libxxhash-dev libgtest-dev)
# shellcheck disable=SC2034
packages_tests=(clang python3 xvfb xauth xdotool imagemagick x11-utils libgl1-mesa-dri)

say() {
	printf '%s\n' "$*"
}

die() {
	printf '\n%s\n' "$@" >&2
	exit 1
}

# Reads the lines of a running command: all of them on one line of a terminal, elsewhere one line
# every ten seconds.
show_progress() {
	local line last=$SECONDS width
	width=$(tput cols 2>/dev/null || echo 80)
	while IFS= read -r line; do
		if [[ -t 1 ]]; then
			line=${line//$'\t'/ }
			printf '\r\033[K   %s' "${line:0:width-4}"
		elif ((SECONDS - last >= 10)); then
			last=$SECONDS
			printf '   %s\n' "${line:0:120}"
		fi
	done
	if [[ -t 1 ]]; then
		printf '\r\033[K'
	fi
}

# step TITLE HINT COMMAND...: runs a command, showing its progress; its output goes to a log. If it
# fails, says which step, why (the end of the log), and the hint what to do; then ends the script.
step() {
	local title=$1 hint=$2 log start=$SECONDS status
	shift 2
	log=$logs/${title//[^a-zA-Z0-9]/-}.log
	say "-- $title"
	set +e
	(
		set -e
		"$@"
	) </dev/null 2>&1 | tee "$log" | show_progress
	status=${PIPESTATUS[0]}
	set -e
	if ((status != 0)); then
		{
			printf '\nThis step failed: %s\n\n' "$title"
			# The first compiler error says more than the last line.
			if grep -q -m1 '^FAILED: ' "$log"; then
				grep -m1 -A 30 '^FAILED: ' "$log" | cut -c 1-300 | grep -v '^[^ ]*c++ '
			else
				tail -n 15 "$log"
			fi
			printf '\nThe whole log: %s\nWhat to do: %s\n' "$log" "$hint"
		} >&2
		exit 1
	fi
	if ((SECONDS - start >= 2)); then
		say "   done in $((SECONDS - start)) s"
	fi
}

install_packages_as_root() {
	local as_root=()
	if ((EUID != 0)); then
		as_root=(sudo)
	fi
	"${as_root[@]}" apt-get update
	"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
		apt-get install -y --no-install-recommends "$@"
}

# Installs those of the named Debian packages that are missing.
require_packages() {
	local missing=() package
	if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
		say "-- This is not a Debian: the packages are yours to install. Needed are: $*"
		return
	fi
	for package in "$@"; do
		if [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null) != installed ]]; then
			missing+=("$package")
		fi
	done
	if ((${#missing[@]} == 0)); then
		return
	fi
	if ((EUID != 0)) && ! { command -v sudo >/dev/null && sudo -v; }; then
		die "These Debian packages are missing, and installing them takes root or sudo:" \
			"    apt-get install ${missing[*]}" \
			"Have them installed, then run this again."
	fi
	say "   missing: ${missing[*]}"
	step "Installing ${#missing[@]} Debian packages" \
		"see that 'apt-get update' and 'apt-get install ${missing[*]}' work, then run this again." \
		install_packages_as_root "${missing[@]}"
}

# configure PRESET [ARGUMENTS...]
configure() {
	local preset=$1
	shift
	step "Configuring Wavemesh ($preset)" \
		"if the build folder was made by other means, delete it and run this again." \
		cmake -S "$root" --preset "$preset" "$@"
}

# build_targets TITLE FOLDER [TARGETS...]
build_targets() {
	local title=$1 folder=$2
	shift 2
	step "$title" "this is a mistake in Wavemesh or an unusual compiler; the log has the details." \
		ninja -C "$folder" "$@"
}

# Packages, MeshLab (meshlab_source and meshlab_build are set), and build/ configured.
set_up() {
	say "Wavemesh: setting up in $root"
	say "   MeshLab is kept in $cache"
	require_packages "$@"
	get_meshlab
	build_meshlab "Building the parts of MeshLab that are needed (some minutes, the first time)" \
		meshlab-common io_base filter_measure filter_sampling
	export MESHLAB_SOURCE_DIR=$meshlab_source MESHLAB_BUILD_DIR=$meshlab_build
}

# MeshLab looks for plugins beside its own executable. This makes such a folder for this clone, in
# which our plugins are always those just built, and leaves the cached MeshLab as it is.
make_meshlab_folder() {
	local folder=$build/meshlab plugin
	build_meshlab "Building the MeshLab application (some minutes, the first time)" \
		meshlab decorate_base copy-distrib-files
	mkdir -p "$folder/plugins"
	cp -u "$meshlab_build/src/distrib/meshlab" "$folder/meshlab"
	ln -sfn "$meshlab_build/src/distrib/shaders" "$folder/shaders"
	find "$folder/plugins" -type l -delete
	for plugin in io_base filter_measure filter_sampling decorate_base; do
		ln -s "$meshlab_build/src/distrib/plugins/lib$plugin.so" "$folder/plugins/"
	done
	for plugin in io_wavemesh filter_wavemesh; do
		ln -s "$build/plugins/lib$plugin.so" "$folder/plugins/"
	done
}
