#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Obtains MeshLab's source and builds parts of it in the cache folder. Sourced by setup.sh.
#
#   $cache/meshlab-2025.07/src      appears whole or not at all (unpacked elsewhere, then renamed)
#   $cache/meshlab-2025.07/build    may be interrupted at any time: ninja goes on from there
#   $cache/newest                   the version in use, written last
#
# The source is that of the distribution's own source package of a newer suite. Where packages come
# from is read from the system's apt configuration; the system's own lists are not touched.

: "${root:?set by setup.sh}" "${cache:?}" "${logs:?}"

# The suites that may offer MeshLab 2022.02 or newer, best first. 2022.02's headers are a test.
meshlab_suites=(forky trixie)
meshlab_suite_2022=trixie

# Writes one apt source per Debian archive that the system uses, for source packages of `suite`.
# write_apt_sources SUITE FOLDER
write_apt_sources() {
	local suite=$1 folder=$2 codename
	codename=$(. /etc/os-release && echo "${VERSION_CODENAME:-stable}")
	# A stanza counts if it holds the release itself: not its updates, security or a third party.
	local known=" $codename stable oldstable testing sid unstable forky trixie bookworm "
	local file
	for file in /etc/apt/sources.list.d/*.sources; do
		if [[ -f $file ]]; then
			cat "$file"
			echo
		fi
	done |
		sed '/^[[:space:]]*#/d; s/[[:space:]]*$//' |
		awk -v suite="$suite" -v known="$known" -v folder="$folder" '
			BEGIN { RS = ""; FS = "\n" }
			{
				keep = ""; field = ""; binary = 0; release = 0; enabled = 1
				for (i = 1; i <= NF; ++i) {
					if ($i !~ /^[ \t]/) {
						field = tolower($i); sub(/:.*/, "", field)
						value = $i; sub(/^[^:]*:[ \t]*/, "", value)
					} else
						value = $i
					if (field == "types" && (" " value " ") ~ / deb(-src)? /) binary = 1
					if (field == "enabled" && tolower(value) ~ /no|false|0/) enabled = 0
					if (field == "suites") {
						n = split(value, names, /[ \t]+/)
						for (k = 1; k <= n; ++k)
							if (names[k] != "" && index(known, " " names[k] " ")) release = 1
					}
					if (field !~ /^(types|suites|enabled|architectures|snapshot)$/)
						keep = keep $i "\n"
				}
				if (binary && release && enabled) {
					file = folder "/" sprintf("%02d", ++count) ".sources"
					printf "Types: deb-src\nSuites: %s\n%s", suite, keep > file
					close(file)
				}
			}'
	# The same for one-line sources: deb [options] address suite components...
	{ cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null || true; } |
		sed -n 's/#.*//; s/^[[:space:]]*deb[[:space:]]\+//p' |
		awk -v suite="$suite" -v known="$known" -v folder="$folder" '
			{
				options = ""
				if (match($0, /^\[[^]]*\][ \t]*/)) {
					options = substr($0, 1, RLENGTH)
					$0 = substr($0, RLENGTH + 1)
					sub(/arch[-+]?=[^] \t]*/, "", options)
				}
				if (!index(known, " " $2 " ")) next
				file = folder "/" sprintf("5%02d", ++count) ".list"
				$2 = suite
				print "deb-src " options $0 > file
				close(file)
			}'
}

# Downloads and unpacks MeshLab's source of one suite, to $cache/meshlab-<version>/src, and prints
# what it does. Nothing of an interrupted or failed attempt is left behind that counts.
# fetch_meshlab SUITE
fetch_meshlab() {
	local suite=$1 work=$cache/download.$1 source version tarball options
	rm -rf "$work"
	mkdir -p "$work/sources" "$work/lists/partial" "$work/cache/archives/partial" "$work/tar"
	write_apt_sources "$suite" "$work/sources"
	for source in "$work"/sources/*; do
		if [[ ! -e $source ]]; then
			echo "No Debian archive was found in /etc/apt/sources.list or /etc/apt/sources.list.d."
			return 1
		fi
		# Newer suites are signed and checked as ever, but their lists may be past their date.
		options=(-o "Dir::Etc::sourceparts=/dev/null" -o "Dir::Etc::sourcelist=$source"
			-o "Dir::State::lists=$work/lists" -o "Dir::Cache=$work/cache"
			-o Acquire::Check-Valid-Until=false -o Acquire::Retries=3)
		if ((EUID == 0)); then
			options+=(-o APT::Sandbox::User=root)
		fi
		if ! apt-get "${options[@]}" update ||
			! (cd "$work/tar" && apt-get "${options[@]}" source --tar-only --download-only meshlab); then
			echo "The archive of $(basename "$source") does not offer MeshLab's source for $suite."
			continue
		fi
		tarball=$(find "$work/tar" -name 'meshlab_*.orig.tar.*' ! -name '*.asc' | head -n 1)
		mkdir "$work/src"
		if ! tar -xf "$tarball" -C "$work/src" --strip-components=1; then
			echo "The tarball of MeshLab's source cannot be unpacked (is the disk full?)."
			return 1
		fi
		version=$(tr -d '[:space:]' <"$work/src/ML_VERSION")
		if ! printf '2022.02\n%s\n' "$version" | sort -V -C; then
			echo "$suite offers MeshLab $version, which is older than 2022.02."
			rm -rf "$work/src"
			continue
		fi
		mkdir -p "$cache/meshlab-$version"
		if [[ ! -d $cache/meshlab-$version/src ]]; then
			mv "$work/src" "$cache/meshlab-$version/src"
		fi
		rm -rf "$work"
		echo "$version" >"$cache/fetched"
		echo "MeshLab $version is in $cache/meshlab-$version/src"
		return 0
	done
	rm -rf "$work"
	return 1
}

fetch_newest_meshlab() {
	local suite
	for suite in "${meshlab_suites[@]}"; do
		if fetch_meshlab "$suite"; then
			mv "$cache/fetched" "$cache/newest"
			return 0
		fi
	done
	return 1
}

# Only one run at a time works in the cache folder.
lock_cache() {
	exec 9>"$cache/lock"
	if ! flock -n 9; then
		say "   another run is working in $cache; waiting for it"
		flock 9
	fi
}

unlock_cache() {
	exec 9>&-
}

# Sets meshlab_source and meshlab_build. MESHLAB_SOURCE_DIR overrides what would be downloaded.
get_meshlab() {
	local version key
	if [[ -n ${MESHLAB_SOURCE_DIR:-} ]]; then
		if [[ ! -f $MESHLAB_SOURCE_DIR/src/vcglib/vcg/complex/complex.h ]]; then
			die "MESHLAB_SOURCE_DIR is '$MESHLAB_SOURCE_DIR', but src/vcglib is missing or empty there." \
				"Make it a checkout by 'git clone --recursive', or unset it to have MeshLab downloaded."
		fi
		meshlab_source=$(cd "$MESHLAB_SOURCE_DIR" && pwd -P)
		version=$(tr -d '[:space:]' <"$meshlab_source/ML_VERSION")
		key=$(printf '%s' "$meshlab_source" | sha256sum | cut -c 1-12)
		meshlab_build=$cache/meshlab-$version-$key/build
		say "-- MeshLab $version from MESHLAB_SOURCE_DIR"
		return
	fi
	lock_cache
	if [[ ! -f $cache/newest || ! -d $cache/meshlab-$(<"$cache/newest")/src ]]; then
		step "Obtaining MeshLab's source from the distribution's archive (5 MB)" \
			"see that the network works; or set MESHLAB_SOURCE_DIR to a 'git clone --recursive' of MeshLab." \
			fetch_newest_meshlab
	fi
	unlock_cache
	version=$(<"$cache/newest")
	meshlab_source=$cache/meshlab-$version/src
	meshlab_build=$cache/meshlab-$version/build
	say "-- MeshLab $version"
}

# Sets meshlab_2022_source, or leaves it empty, with a word, where the archive has no 2022.02.
get_meshlab_2022() {
	meshlab_2022_source=$cache/meshlab-2022.02/src
	if [[ ! -d $meshlab_2022_source ]]; then
		lock_cache
		say "-- Obtaining MeshLab 2022.02's headers (7 MB)"
		fetch_meshlab "$meshlab_suite_2022" >"$logs/meshlab-2022.log" 2>&1 </dev/null || true
		unlock_cache
	fi
	if [[ ! -d $meshlab_2022_source ]]; then
		say "   the archive does not offer them; the test that needs them will be skipped"
		meshlab_2022_source=
	fi
}

# Sources are compiled several at a time and with -O1, which takes a third of the time; should a
# MeshLab not be fit for that, one at a time.
run_ninja_on_meshlab() {
	local status=0
	ninja -C "$meshlab_build" "$@" || status=$?
	if ((status == 130)); then
		return $status # interrupted
	elif ((status != 0)); then
		echo "Once more, one source at a time."
		cmake -DCMAKE_UNITY_BUILD=OFF "$meshlab_build"
		ninja -C "$meshlab_build" "$@"
	fi
}

# build_meshlab TITLE TARGETS...
build_meshlab() {
	local title=$1 plugins key
	shift
	# With MINI nothing is downloaded, and a plugin is built only if it is named.
	plugins="meshlabplugins/io_base;meshlabplugins/filter_measure"
	plugins+=";meshlabplugins/filter_sampling;meshlabplugins/decorate_base"
	key="2 $meshlab_source $plugins"
	lock_cache
	if [[ ! -f $meshlab_build/configured || $(<"$meshlab_build/configured") != "$key" ]]; then
		# MeshLab's CMake reads the injected file whenever it runs: it has to outlive this clone.
		mkdir -p "$meshlab_build"
		cp "$root/cmake/meshlab_unity.cmake" "$meshlab_build/wavemesh_unity.cmake"
		step "Configuring MeshLab" \
			"if MESHLAB_SOURCE_DIR is set, see that it is MeshLab 2022.02 or newer with Qt 5." \
			cmake -S "$meshlab_source" -B "$meshlab_build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
			"-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG" -DCMAKE_UNITY_BUILD=ON \
			"-DCMAKE_PROJECT_MeshLab_INCLUDE=$meshlab_build/wavemesh_unity.cmake" \
			-DMESHLAB_BUILD_MINI=ON "-DMESHLAB_PLUGINS=$plugins"
		echo "$key" >"$meshlab_build/configured"
	fi
	step "$title" \
		"run this again, it goes on where it stopped; if that does not help, delete $meshlab_build" \
		run_ninja_on_meshlab "$@"
	unlock_cache
}
