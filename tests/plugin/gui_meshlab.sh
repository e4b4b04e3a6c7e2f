#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# MeshLab's window on a display of its own, for the tests of the plugins in it. Sourced by them, with
# `build` and `out` set; `out` is emptied, and keeps the pictures. MESHLAB names another MeshLab than
# the one in `build`.
: "${build:?}" "${out:?}"

rm -rf "$out"
mkdir -p "$out/home/.config/VCG"
export HOME=$out/home
unset XDG_CONFIG_HOME XDG_DATA_HOME WAYLAND_DISPLAY QT_QPA_PLATFORM

# The first start asks questions otherwise.
cat >"$HOME/.config/VCG/MeshLab_64bit_fp.conf" <<END
[General]
informativeShown=true
sendAnonymousData=false
lastTimeMeshLabVersionCheckedOnStart=$(LC_ALL=C date '+%a %b %-d %Y')
END

meshlab=
xvfb=
trap 'kill $meshlab $xvfb 2>/dev/null || true' EXIT

fail() {
	import -window root "$out/failed.png" 2>/dev/null || true
	printf '%s\nMeshLab said:\n' "$*" >&2
	tail -n 20 "$out/meshlab.log" >&2
	exit 1
}

# eventually SECONDS COMMAND...: tries until the command succeeds.
eventually() {
	local until=$((SECONDS + $1))
	shift
	until "$@" >/dev/null 2>&1; do
		if ((SECONDS > until)) || ! kill -0 "$meshlab" 2>/dev/null; then
			fail "Waited in vain for: $*"
		fi
		sleep 0.2
	done
}

window() {
	xdotool search --onlyvisible --name "$1" | head -n 1
}

has_window() {
	[[ -n $(window "$1") ]]
}

focus() {
	eventually 30 has_window "$1"
	xdotool windowfocus --sync "$(window "$1")"
	sleep 0.5
}

# Has MeshLab logged this last, leaving aside whatever else was logged?
last_level_is() {
	[[ $(grep -o 'LOG: [0-9] Level [0-9]* of' "$out/meshlab.log" | tail -n 1) == *" Level $1 of" ]]
}

# picture NAME: the whole screen; NAME-view.png: the 3D view without the text at its foot
picture() {
	sleep 1
	import -window root "$out/$1.png"
	convert "$out/$1.png" -crop 778x690+2+74 +repage "$out/$1-view.png"
}

# differing A B: how many pixels of the two views differ
differing() {
	# ImageMagick 7 adds a fraction in brackets.
	{ compare -metric AE "$out/$1-view.png" "$out/$2-view.png" null: 2>&1 || true; } |
		awk '{ printf "%d\n", $1 }'
}

# start_meshlab FILE: its window as large as the display nearly is, with FILE open; what to open is
# asked first if it is a .wmc: the finest level, which is the default. `main` is the window.
start_meshlab() {
	Xvfb -displayfd 3 -screen 0 1280x900x24 -nolisten tcp 3>"$out/display" 2>"$out/xvfb.log" &
	xvfb=$!
	local i
	for ((i = 0; i < 100; ++i)); do
		if [[ -s $out/display ]]; then
			break
		fi
		sleep 0.1
	done
	export DISPLAY=:$(<"$out/display") LIBGL_ALWAYS_SOFTWARE=1
	# From the file's folder, so that the log, and the pictures, have its name only.
	pushd "$(dirname "$1")" >/dev/null
	"${MESHLAB:-$build/meshlab/meshlab}" "$(basename "$1")" >"$out/meshlab.log" 2>&1 &
	meshlab=$!
	popd >/dev/null
	if [[ $1 == *.wmc ]]; then
		focus 'Pre-Open Options'
		xdotool key Return
	fi
	eventually 30 grep -q 'LOG: . All files opened' "$out/meshlab.log"
	main=$(window 'MeshLab 20')
	eventually 20 is_large
	focus 'MeshLab 20'
}

# MeshLab sizes its window too, a little later.
is_large() {
	xdotool windowmove "$main" 0 0 windowsize "$main" 1270 890
	sleep 1
	[[ $(xdotool getwindowgeometry --shell "$main") == *WIDTH=1270*HEIGHT=890* ]]
}

# The middle of the dialog's Preview box, which stands elsewhere in every MeshLab: its left side is
# the one dark stroke of such a length in its column.
preview_row() {
	import -window root "$out/dialog.png"
	convert "$out/dialog.png" -crop "1x$HEIGHT+$((X + 10))+$Y" +repage -colorspace gray -depth 8 txt:- |
		awk -F '[,:() ]+' -v y0="$Y" '
			/^[0-9]/ {
				if ($3 < 200) ++run
				else { if (run >= 9 && run <= 16) middle = y0 + $2 - int(run / 2); run = 0 }
			}
			END { print middle + 0 }'
}

# open_filter NAME [SEARCH]: the filter's dialog, at the right; sets X Y WIDTH HEIGHT of it and the
# places of what stands at a fixed distance from its foot.
open_filter() {
	focus 'MeshLab 20'
	xdotool mousemove 400 880 # what is under the pointer is chosen from the list
	xdotool key ctrl+f
	sleep 0.5
	xdotool type "${2:-$1}"
	sleep 0.5
	xdotool key Down Return
	focus "$1"
	dialog=$(window "$1")
	eval "$(xdotool getwindowgeometry --shell "$dialog")" # X Y WIDTH HEIGHT
	xdotool windowmove "$dialog" $((1274 - WIDTH)) "${dialog_top:-90}"
	sleep 0.5
	eval "$(xdotool getwindowgeometry --shell "$dialog")" # X Y WIDTH HEIGHT
	: "${X:?}" "${Y:?}" "${WIDTH:?}" "${HEIGHT:?}"
	# Read by those who source this.
	# shellcheck disable=SC2034
	{
		preview_x=$((X + 16))
		preview_y=$(preview_row)
		apply_x=$((X + WIDTH - 125))
		close_x=$((X + 125))
		buttons_y=$((Y + HEIGHT - 22))
	}
}

# find_slider PICTURE: of the dialog of Browse Levels, at its right end; sets slider_left slider_right
# slider_y. It is where the dialog has most of the blue that fills its groove, as far as the handle.
# shellcheck disable=SC2034 # read by those who source this
find_slider() {
	read -r slider_left slider_right slider_y < <(
		convert "$1" -crop "$((WIDTH - 20))x$((HEIGHT - 200))+$((X + 10))+$((Y + 30))" -depth 8 txt:- |
			awk -F '[,:() ]+' -v x0="$((X + 10))" -v y0="$((Y + 30))" '
				/^[0-9]/ && $5 - $3 > 80 {
					if (!($2 in n) || $1 < first[$2]) first[$2] = $1
					if (!($2 in n) || $1 > last[$2]) last[$2] = $1
					if (++n[$2] > most) { most = n[$2]; row = $2 }
				}
				END { if (most > 50) print x0 + first[row] + 6, x0 + last[row] + 6, y0 + row }'
	) || fail "There is no slider in the dialog."
}

click() {
	xdotool mousemove "$1" "$2" click 1
	sleep 0.5
}
