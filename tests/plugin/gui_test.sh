#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# gui_test.sh BUILD MESH: opens MESH as .wmc in MeshLab's window (on a display of its own), drags the
# slider of Wavemesh: Browse Levels from the finest level down to the base mesh and up again with
# live preview, and saves. Checks MeshLab's log, the pictures and the saved file.
# The pictures stay in BUILD/gui.
set -euo pipefail

build=$1
mesh=$2
out=$build/gui
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
	compare -metric AE "$out/$1-view.png" "$out/$2-view.png" null: 2>&1 || true
}

"$build/wmc" encode "$mesh" "$out/original.wmc" --bits 14 >/dev/null
finest=$("$build/wmc" info "$out/original.wmc" --json |
	python3 -c 'import json, sys; print(max(row["level"] for row in json.load(sys.stdin)["levels"]))')

Xvfb -displayfd 3 -screen 0 1280x900x24 -nolisten tcp 3>"$out/display" 2>"$out/xvfb.log" &
xvfb=$!
for ((i = 0; i < 100; ++i)); do
	if [[ -s $out/display ]]; then
		break
	fi
	sleep 0.1
done
display=$(<"$out/display")
export DISPLAY=:$display LIBGL_ALWAYS_SOFTWARE=1

"$build/meshlab/meshlab" "$out/original.wmc" >"$out/meshlab.log" 2>&1 &
meshlab=$!

# What to open is asked first: the finest level, which is the default.
focus 'Pre-Open Options'
xdotool key Return
eventually 30 grep -q 'LOG: . Opened level' "$out/meshlab.log"
main=$(window 'MeshLab 20')
# MeshLab sizes its window too, a little later.
is_large() {
	xdotool windowmove "$main" 0 0 windowsize "$main" 1270 890
	sleep 1
	[[ $(xdotool getwindowgeometry --shell "$main") == *WIDTH=1270*HEIGHT=890* ]]
}
eventually 20 is_large
focus 'MeshLab 20'

xdotool key ctrl+f
sleep 0.5
xdotool type 'Browse Levels'
sleep 0.5
xdotool key Down Return
focus 'Wavemesh: Browse Levels'
dialog=$(window 'Wavemesh: Browse Levels')
xdotool windowmove "$dialog" 782 90
sleep 0.5
eval "$(xdotool getwindowgeometry --shell "$dialog")" # X Y WIDTH HEIGHT
: "${X:?}" "${Y:?}" "${WIDTH:?}" "${HEIGHT:?}"

picture finest-before
# The slider is where the dialog has most of the blue that fills its groove, as far as the handle,
# which is at its right end. The rest stands at a fixed distance from the dialog's foot.
read -r slider_left slider_right slider_y < <(
	convert "$out/finest-before.png" -crop "$((WIDTH - 20))x$((HEIGHT - 200))+$((X + 10))+$((Y + 30))" \
		-depth 8 txt:- |
		awk -F '[,:() ]+' -v x0="$((X + 10))" -v y0="$((Y + 30))" '
			/^[0-9]/ && $5 - $3 > 80 {
				if (!($2 in n) || $1 < first[$2]) first[$2] = $1
				if (!($2 in n) || $1 > last[$2]) last[$2] = $1
				if (++n[$2] > most) { most = n[$2]; row = $2 }
			}
			END { if (most > 50) print x0 + first[row] + 6, x0 + last[row] + 6, y0 + row }'
) || fail "There is no slider in the dialog."
preview_x=$((X + 16))
preview_y=$((Y + HEIGHT - 181))
apply_x=$((X + WIDTH - 125))
close_x=$((X + 125))
buttons_y=$((Y + HEIGHT - 22))

xdotool mousemove "$preview_x" "$preview_y" click 1
sleep 0.5

# drag FROM TO: in the time a hand takes, with every position between
drag() {
	local x steps=24
	xdotool mousemove "$1" "$slider_y" mousedown 1
	for ((i = 1; i <= steps; ++i)); do
		x=$(($1 + ($2 - $1) * i / steps))
		xdotool mousemove "$x" "$slider_y"
		sleep 0.05
	done
	xdotool mouseup 1
}

middle=$(((slider_left + slider_right) / 2))
drag "$slider_right" $((slider_left - 20))
eventually 20 last_level_is 0
picture base
drag "$slider_left" "$middle"
picture middle
drag "$middle" $((slider_right + 20))
eventually 20 last_level_is "$finest"
picture finest-after

for ((level = 0; level <= finest; ++level)); do
	grep -q "LOG: . Level $level of $finest" "$out/meshlab.log" ||
		fail "Level $level of $finest was never shown while dragging."
done
(($(differing finest-before base) > 1000)) || fail "The picture did not change down to the base mesh."
(($(differing base middle) > 1000)) || fail "The picture did not change from the base mesh up."
(($(differing finest-before finest-after) == 0)) || fail "The finest level does not look as before."

xdotool mousemove "$apply_x" "$buttons_y" click 1
sleep 1
xdotool mousemove "$close_x" "$buttons_y" click 1
focus 'MeshLab 20'

# Ctrl+E saves the layer under its own name, after asking how.
cp "$out/original.wmc" "$out/opened.wmc"
rm "$out/original.wmc"
xdotool key ctrl+e
focus 'Choose Saving Options'
picture save-options
xdotool key Return
eventually 20 grep -q 'LOG: . Saved Mesh' "$out/meshlab.log"
picture saved

# What was browsed and saved is still the mesh that was opened.
"$build/wmc" decode "$out/opened.wmc" "$out/opened.ply" >/dev/null
"$build/wmc" verify "$out/opened.ply" "$out/original.wmc" >"$out/verify.log" 2>&1 ||
	fail "The saved file does not hold the mesh that was opened: $(<"$out/verify.log")"
kill -0 "$meshlab" || fail "MeshLab has ended."

# The README's picture of browsing: a level in the middle, the base mesh and the finest level.
convert \( "$out/middle.png" -crop 1270x856+0+0 +repage -resize 1000x \) \
	\( "$out/base.png" "$out/finest-after.png" -crop 1270x856+0+0 +repage -append -resize x674 \) \
	+append -dither None -colors 128 -define png:compression-level=9 "$out/browse.png"
echo "Browsed $((finest + 1)) levels; the pictures are in $out"
