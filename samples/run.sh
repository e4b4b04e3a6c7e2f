#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# From nothing to meshes in .wmc, in a real MeshLab; see --help.
set -euo pipefail

usage() {
	cat <<-'END'
		usage: samples/run.sh                run the sample meshes through Wavemesh in a headless MeshLab
		       samples/run.sh --gui [FILE]   open MeshLab itself with the plugins (and FILE) loaded

		Installs the Debian packages it needs (as root, or through sudo), obtains and builds MeshLab
		(kept in ${XDG_CACHE_HOME:-~/.cache}/wavemesh), builds codec, tool and plugins into build/,
		and starts. MESHLAB_SOURCE_DIR names another MeshLab source tree to use.
	END
}

gui=
gui_file=
case ${1:-} in
	'') ;;
	-h | --help)
		usage
		exit 0
		;;
	--gui)
		gui=yes
		if (($# > 1)); then
			if [[ ! -f $2 ]]; then
				echo "There is no file '$2'." >&2
				exit 1
			fi
			gui_file=$(realpath "$2")
		fi
		;;
	*)
		usage >&2
		exit 2
		;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=cmake/setup.sh
. cmake/setup.sh

if [[ -n $gui ]]; then
	if [[ -z ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]]; then
		die "There is no display to open MeshLab's window on: DISPLAY is not set." \
			"Run this from a graphical session, or through 'ssh -X'."
	fi
	set_up "${packages_build[@]}"
	make_meshlab_folder
	configure meshlab
	build_targets "Building Wavemesh" "$build" wmc io_wavemesh filter_wavemesh
	say "-- MeshLab opens; the plugins are $build/plugins/*.so"
	exec "$build/meshlab/meshlab" ${gui_file:+"$gui_file"}
fi

set_up "${packages_build[@]}"
configure meshlab
build_targets "Building Wavemesh: codec, tool, plugins and a headless MeshLab" "$build" \
	wmc io_wavemesh filter_wavemesh meshlab_host
say "-- Simplifying, saving and reopening the samples in a headless MeshLab"
output=$build/samples
meshlab_plugins=$meshlab_build/src/distrib/plugins
QT_QPA_PLATFORM=offscreen "$build/meshlab_host" \
	--plugins "$meshlab_plugins" --plugins "$build/plugins" \
	--script samples/simplify.mlx --out "$output" samples/*.ply ||
	die "The samples did not come through MeshLab as they should; see above."

say
say "-- Checking every file against its original, by $build/wmc verify"
for mesh in samples/*.ply; do
	name=$(basename "$mesh" .ply)
	if ! verdict=$("$build/wmc" verify "$mesh" "$output/$name.wmc" 2>&1); then
		die "$output/$name.wmc does not keep what it promises:" "$verdict" \
			"This is a mistake in Wavemesh: please report it with the mesh $mesh."
	fi
	say "   $name.wmc: connectivity and every coordinate on its lattice are the original's"
done
say "-- All is well. The files are in $output; ./samples/run.sh --gui FILE opens one in MeshLab."
