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

# MeshLab looks for plugins beside its own executable. This makes such a folder for this clone, in
# which our plugins are always those just built and the cached MeshLab stays as it is.
make_meshlab_folder() {
	local folder=$1 plugin
	mkdir -p "$folder/plugins"
	cp -u "$meshlab_build/src/distrib/meshlab" "$folder/meshlab"
	ln -sfn "$meshlab_build/src/distrib/shaders" "$folder/shaders"
	find "$folder/plugins" -type l -delete
	for plugin in "$meshlab_build"/src/distrib/plugins/*.so "$build"/plugins/*.so; do
		ln -sf "$plugin" "$folder/plugins/"
	done
}

if [[ -n $gui ]]; then
	if [[ -z ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]]; then
		die "There is no display to open MeshLab's window on: DISPLAY is not set." \
			"Run this from a graphical session, or through 'ssh -X'."
	fi
	set_up "${packages_build[@]}"
	build_meshlab "Building the MeshLab application (3 minutes the first time)" \
		meshlab decorate_base copy-distrib-files
	configure meshlab
	build_targets "Building Wavemesh" "$build" wmc io_wavemesh filter_wavemesh
	make_meshlab_folder "$build/meshlab"
	say "-- MeshLab opens; the plugins are $build/plugins/*.so"
	exec "$build/meshlab/meshlab" ${gui_file:+"$gui_file"}
fi

set_up "${packages_build[@]}"
configure meshlab
build_targets "Building Wavemesh: codec, tool, plugins and a headless MeshLab" "$build" \
	wmc io_wavemesh filter_wavemesh meshlab_host
say
