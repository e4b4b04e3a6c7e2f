#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# packaging_test.sh CLAIM SOURCE BUILD [VCGLIB]: what is installed and packaged does what it should.
# Exit code 77: skipped, for want of a program that is named.
set -euo pipefail

claim=$1
source=$2
build=$3
out=$build/packaging/$claim
rm -rf "$out"
mkdir -p "$out"

fail() {
	printf '%s\n' "$*" >&2
	exit 1
}

need() {
	command -v "$1" >/dev/null || {
		echo "SKIPPED: there is no $1"
		exit 77
	}
}

# expect_files FOLDER FILES...
expect_files() {
	local folder=$1 file
	shift
	for file in "$@"; do
		# Patterns are meant to be expanded.
		# shellcheck disable=SC2086
		compgen -G "$folder/$file" >/dev/null || fail "There is no $file in $folder."
	done
}

has_plugins() {
	[[ -f $build/plugins/libio_wavemesh.so ]]
}

case $claim in
	installed_codec_is_found)
		cmake --install "$build" --prefix "$out/prefix" --component codec >/dev/null
		cmake -S "$source/tests/packaging/example" -B "$out/build" -G Ninja \
			-DCMAKE_PREFIX_PATH="$out/prefix" -DVCGLIB_DIR="$4" >"$out/configure.log"
		cmake --build "$out/build" >"$out/build.log"
		"$out/build/example" | tee "$out/example.log"
		grep -q '^level 0: 4 vertices, 4 faces$' "$out/example.log" || fail "The base mesh is wrong."
		tail -n 1 "$out/example.log" | grep -q ': 2562 vertices, 5120 faces$' || fail "The mesh is wrong."
		lines=$(wc -l <"$source/tests/packaging/example/example.cpp")
		((lines <= 40)) || fail "The example has $lines lines."
		;;

	manual_page_has_every_option)
		need man
		for command in $("$build/wmc" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
			grep -q "^\.SS wmc $command" "$build/wmc.1" || fail "wmc.1 lacks the command $command."
		done
		LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings=w -l "$build/wmc.1" >"$out/wmc.txt" 2>"$out/warnings"
		[[ ! -s $out/warnings ]] || fail "man warns: $(<"$out/warnings")"
		! grep -n '\\f.\\fR' "$build/wmc.1" || fail "wmc.1 has an empty word."
		grep -q -e '--lifting' "$out/wmc.txt" || fail "wmc.1 lacks --lifting."
		;;

	completion_offers_commands_options_and_values)
		PATH=$build:$PATH
		# shellcheck source=/dev/null
		. "$source/packaging/wmc.bash-completion"
		# offers WORD... (the last one is being typed)
		offers() {
			COMP_WORDS=("$@")
			COMP_CWORD=$(($# - 1))
			_wmc
			printf '%s ' "${COMPREPLY[@]}"
		}
		[[ $(offers wmc en) == 'encode ' ]] || fail "wmc en: $(offers wmc en)"
		[[ $(offers wmc encode --lift) == '--lifting ' ]] || fail "--lift: $(offers wmc encode --lift)"
		[[ $(offers wmc encode --lifting '') == 'off 0 1 2 ' ]] || fail "--lifting: $(offers wmc encode --lifting '')"
		cd "$out"
		touch mesh.obj
		[[ $(offers wmc info mesh) == 'mesh.obj ' ]] || fail "files: $(offers wmc info mesh)"
		;;

	file_type_is_known_by_its_first_bytes)
		need python3
		# The magic, as the rule has it, against files of ours and of others.
		python3 - "$source" <<-'END'
			import sys, xml.etree.ElementTree as tree
			source = sys.argv[1]
			space = '{http://www.freedesktop.org/standards/shared-mime-info}'
			root = tree.parse(source + '/packaging/wavemesh.xml').getroot()
			match = root.find(f'{space}mime-type/{space}magic/{space}match')
			magic = match.get('value').encode().decode('unicode_escape').encode('latin-1')
			assert magic == bytes.fromhex('8b574d430d0a1a0a') and match.get('offset') == '0'
			assert open(source + '/samples/pebble.wmc', 'rb').read(8) == magic
			assert open(source + '/samples/pebble.ply', 'rb').read(8) != magic
			kind = root.find(f'{space}mime-type').get('type')
			for name in ('meshlab-wmc.desktop', 'wavemesh.thumbnailer'):
			    assert f'MimeType={kind};' in open(source + '/packaging/' + name).read(), name
		END
		if command -v update-mime-database >/dev/null; then
			mkdir -p "$out/mime/packages"
			cp "$source/packaging/wavemesh.xml" "$out/mime/packages/"
			update-mime-database "$out/mime" 2>&1 | tee "$out/mime.log"
			expect_files "$out/mime" model/x-wmc.xml magic globs2
		fi
		if command -v desktop-file-validate >/dev/null; then
			desktop-file-validate "$source/packaging/meshlab-wmc.desktop"
		fi
		;;

	packages_hold_what_belongs_to_them)
		need cpack
		need dpkg-deb
		(cd "$out" && cpack --config "$build/CPackConfig.cmake" -B "$out" >"$out/cpack.log" 2>&1) ||
			fail "cpack failed: $(tail -n 20 "$out/cpack.log")"
		mkdir "$out/root"
		for package in "$out"/*.deb; do
			dpkg-deb -x "$package" "$out/root"
			dpkg-deb -I "$package" >>"$out/control.log"
		done
		expect_files "$out/root/usr" bin/wmc 'share/man/man1/wmc.1*' \
			share/bash-completion/completions/wmc share/mime/packages/wavemesh.xml \
			include/wavemesh/codec.h
		[[ -n $(find "$out/root" -name libwavemesh_codec.a) ]] || fail "The codec is missing."
		[[ -n $(find "$out/root" -name WavemeshConfig.cmake) ]] || fail "find_package() would fail."
		if has_plugins; then
			expect_files "$out/root/usr" share/applications/meshlab-wmc.desktop \
				bin/wmc-thumbnailer share/thumbnailers/wavemesh.thumbnailer
			for plugin in io_wavemesh filter_wavemesh; do
				[[ -n $(find "$out/root" -path "*/meshlab/plugins/lib$plugin.so") ]] || fail "There is no $plugin."
			done
			grep -q 'Depends: meshlab (>= 20' "$out/control.log" || fail "The plugins' package does not name MeshLab."
		fi
		"$out/root/usr/bin/wmc" info "$source/samples/pebble.wmc" >/dev/null
		mkdir "$out/tar"
		tar -xzf "$out"/*.tar.gz -C "$out/tar" --strip-components=1
		expect_files "$out/tar" bin/wmc include/wavemesh/codec.h
		;;

	thumbnails_come_from_the_first_bytes)
		need identify
		thumbnailer=$build/wmc-thumbnailer
		for mesh in "$source"/samples/*.wmc; do
			"$thumbnailer" "$mesh" "$out/$(basename "$mesh").png" --size 128
			[[ $(identify -format '%m %w %h' "$out/$(basename "$mesh").png") == 'PNG 128 128' ]] || fail "$mesh"
			# Something is drawn, and something is left free.
			mean=$(convert "$out/$(basename "$mesh").png" -alpha extract -format '%[fx:mean*100]' info:)
			awk -v m="$mean" 'BEGIN { exit !(m > 5 && m < 95) }' || fail "$mesh: $mean % is covered."
		done
		# The beginning of a file is enough.
		head -c 3000 "$source/samples/pretzel.wmc" >"$out/cut.wmc"
		"$thumbnailer" "$out/cut.wmc" "$out/cut.png"
		for bad in "$source/samples/pebble.ply" "$out/none.wmc"; do
			if "$thumbnailer" "$bad" "$out/bad.png" 2>"$out/bad.log"; then
				fail "$bad gave a picture."
			fi
			[[ ! -e $out/bad.png && $(wc -l <"$out/bad.log") == 1 ]] || fail "$bad: $(<"$out/bad.log")"
		done
		;;

	*)
		fail "What is $claim?"
		;;
esac
