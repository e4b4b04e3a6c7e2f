#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Builds Wavemesh's packages in a clean root of a Debian, installs them there with apt, and browses a
# .wmc in that Debian's own MeshLab on a display of its own.
#
#   packaging/try_packages.sh bookworm|trixie|forky [FOLDER]
#
#   trixie, forky   the distribution's MeshLab; the plugins go into its plugin folder
#   bookworm        MeshLab built from source, as its own is too old; the plugins go into the user's
#                   folder, once from the .deb and once from the .tar.gz
#
# Takes root and debootstrap, 3 GB in FOLDER (build/roots), and 5 to 20 minutes; a second run goes on
# from there. Packages, logs and screenshots end in FOLDER/SUITE-results. Exit code 77: skipped, for
# a reason that is said. Packages come from where the system's own apt gets them.
set -euo pipefail
export LC_ALL=C.UTF-8
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

skip() {
	echo "SKIPPED: $*"
	exit 77
}

# The first Debian archive that the system uses, as apt names it.
mirror_of() {
	local work=$1
	cache=$work logs=$work
	# shellcheck source=cmake/get_meshlab.sh
	. "$root/cmake/get_meshlab.sh"
	write_apt_sources "$suite" "$work"
	{ cat "$work"/*.sources "$work"/*.list 2>/dev/null || true; } |
		sed -n 's/^URIs:[[:space:]]*\([^[:space:]]*\).*/\1/p; s/^deb-src \(\[[^]]*\] *\)\{0,1\}\([^ ]*\) .*/\2/p' |
		head -n 1
}

make_root() {
	local work mirror script=/usr/share/debootstrap/scripts/$suite log=$folder/$suite-debootstrap.log
	work=$(mktemp -d)
	mirror=$(mirror_of "$work")
	rm -rf "$work"
	[[ -n $mirror ]] || skip "no Debian archive was found in the system's apt configuration."
	[[ -e $script ]] || script=/usr/share/debootstrap/scripts/sid # newer than debootstrap
	echo "-- A clean root of $suite"
	debootstrap --variant=minbase "$suite" "$tree" "$mirror" "$script" >"$log" 2>&1 || {
		tail -n 3 "$log" >&2
		rm -rf "$tree"
		skip "the archive does not have $suite, or it cannot be reached; see above."
	}
	# The lists of a suite in the making may be past their date; they are signed all the same.
	echo "deb [check-valid-until=no] $mirror $suite main" >"$tree/etc/apt/sources.list"
	touch "$tree/made"
}

outside() {
	case $suite in
		bookworm | trixie | forky) ;;
		*)
			sed -n '6s/^# *//p' "${BASH_SOURCE[0]}" >&2
			exit 2
			;;
	esac
	((EUID == 0)) || skip "a clean root takes root."
	command -v debootstrap >/dev/null || skip "there is no debootstrap."
	mkdir -p "$folder"
	folder=$(cd "$folder" && pwd)
	tree=$folder/$suite
	if [[ ! -e $tree/made ]]; then
		make_root
	fi
	# The clone as it is, with what is not committed.
	find "$tree/wavemesh" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf {} + 2>/dev/null || true
	mkdir -p "$tree/wavemesh"
	(cd "$root" && git ls-files -z --cached --others --exclude-standard |
		tar -c --null --ignore-failed-read -T -) | tar -x -C "$tree/wavemesh"
	# In a namespace of its own, so that neither mounts nor programs outlive the trial.
	local status=0
	unshare --mount --pid --fork chroot "$tree" /wavemesh/packaging/try_packages.sh --inside "$suite" ||
		status=$?
	rm -rf "$folder/$suite-results"
	mkdir -p "$folder/$suite-results"
	cp -r "$tree/results/." "$folder/$suite-results/" 2>/dev/null || true
	echo "-- Packages, logs and screenshots are in $folder/$suite-results"
	return $status
}

# ---- in the root ----

# The distribution's MeshLab, and our packages against it.
build_for_distribution() {
	local library
	require_packages "${packages_build[@]}" dpkg-dev file
	# With what it recommends: a stock plugin that does not load keeps MeshLab from looking further.
	if [[ ! -x /usr/bin/meshlab ]]; then
		step "Installing MeshLab" "see the log." apt-get install -y meshlab
	fi
	library=$(dpkg -L meshlab | grep '/libmeshlab-common\.so$')
	step "Obtaining MeshLab's headers" "see the log." fetch_meshlab "$suite"
	MESHLAB_SOURCE_DIR=$cache/meshlab-$(<"$cache/fetched")/src
	export MESHLAB_SOURCE_DIR MESHLAB_BUILD_DIR=
	configure meshlab -DWAVEMESH_BUILD_TESTS=OFF "-DMESHLAB_LIBRARY=$library"
}

# MeshLab from source. Its folder is made with our plugins in it, which is not what is tried here.
build_for_user() {
	set_up "${packages_build[@]}" dpkg-dev file
	make_meshlab_folder
	find "$build/meshlab/plugins" -name '*_wavemesh.so' -delete
	local version
	version=$(<"$cache/newest")
	user_plugins=.local/share/VCG/MeshLab_64bit_fp/MeshLabExtraPlugins/$version
	packaged_plugins=lib/wavemesh/meshlab-$version
	configure meshlab -DWAVEMESH_BUILD_TESTS=OFF "-DWAVEMESH_PLUGIN_INSTALL_DIR=$packaged_plugins"
}

# A MeshLab whose user has the plugins: LINES install them as packaging/README.md says.
# meshlab_of_user NAME LINES
meshlab_of_user() {
	cat >"$build/meshlab/$1" <<-LINES
		#!/bin/bash
		set -e
		$2
		exec $build/meshlab/meshlab "\$@"
	LINES
	chmod +x "$build/meshlab/$1"
}

# browse NAME MESHLAB: the test of the window, with that MeshLab and the installed wmc
browse() {
	local folder=/results/$1
	mkdir -p "$folder"
	ln -sf /usr/bin/wmc "$folder/wmc"
	MESHLAB=$2 step "Browsing a .wmc in MeshLab ($1)" "see the screenshots in the results." \
		"$root/tests/plugin/gui_test.sh" "$folder" "$root/samples/pretzel.ply"
	rm -rf "$folder/gui/home"
}

inside() {
	mount -t proc proc /proc
	mkdir -p /dev/shm
	export HOME=/root DEBIAN_FRONTEND=noninteractive
	unset XDG_CACHE_HOME MESHLAB_SOURCE_DIR MESHLAB_BUILD_DIR DISPLAY WAYLAND_DISPLAY
	local package
	rm -rf /results
	mkdir -p /results
	# shellcheck source=cmake/setup.sh
	. "$root/cmake/setup.sh"
	require_packages xvfb xauth xdotool imagemagick x11-utils libgl1-mesa-dri python3 shared-mime-info
	if [[ $suite == bookworm ]]; then
		build_for_user
	else
		build_for_distribution
	fi
	build_targets "Building Wavemesh" "$build"
	rm -rf "$build/cpack"
	step "Packing" "see the log." cpack --config "$build/CPackConfig.cmake" -B "$build/cpack"
	find "$build/cpack" -maxdepth 1 \( -name '*.deb' -o -name '*.tar.gz' \) -exec cp {} /results/ \;
	step "Installing the packages" "see the log." \
		apt-get install -y --reinstall --allow-downgrades /results/*.deb
	for package in meshlab-wavemesh wavemesh-tools; do
		dpkg -L "$package" >"/results/$package.files"
		dpkg-query -s "$package" >"/results/$package.control"
	done
	[[ $(wmc --version) == *[0-9]* ]]
	wmc info "$root/samples/pretzel.wmc" >/results/wmc-info.txt
	if [[ $suite == bookworm ]]; then
		meshlab_of_user deb "mkdir -p ~/$user_plugins
			ln -sf /usr/$packaged_plugins/*.so ~/$user_plugins/"
		meshlab_of_user tar.gz "mkdir -p ~/$user_plugins
			tar -xzf /results/*.tar.gz -C ~/$user_plugins --wildcards '*_wavemesh.so' --transform 's,.*/,,'"
		browse deb "$build/meshlab/deb"
		browse tar.gz "$build/meshlab/tar.gz"
	else
		browse deb /usr/bin/meshlab
	fi
	cp -r "$logs" /results/logs
	echo "-- $suite: built, installed and browsed."
}

if [[ ${1:-} == --inside ]]; then
	suite=$2
	inside
else
	suite=${1:-}
	folder=${2:-$root/build/roots}
	outside
fi
