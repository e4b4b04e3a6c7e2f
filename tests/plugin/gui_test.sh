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
# shellcheck source=tests/plugin/gui_meshlab.sh
. "$(dirname "${BASH_SOURCE[0]}")/gui_meshlab.sh"

"$build/wmc" encode "$mesh" "$out/original.wmc" --bits 14 >/dev/null
finest=$("$build/wmc" info "$out/original.wmc" --json |
	python3 -c 'import json, sys; print(max(row["level"] for row in json.load(sys.stdin)["levels"]))')

start_meshlab "$out/original.wmc"
open_filter 'Wavemesh: Browse Levels' 'Browse Levels'

picture finest-before
find_slider "$out/finest-before.png"
click "$preview_x" "$preview_y"

# drag FROM TO: in the time a hand takes, with every position between
drag() {
	local x steps=48
	xdotool mousemove "$1" "$slider_y" mousedown 1
	for ((i = 1; i <= steps; ++i)); do
		x=$(($1 + ($2 - $1) * i / steps))
		xdotool mousemove "$x" "$slider_y"
		sleep 0.05
	done
	xdotool mouseup 1
}

middle=$(((slider_left + 3 * slider_right) / 4))
drag "$slider_right" $((slider_left - 20))
eventually 20 last_level_is 0
picture base
drag "$slider_left" "$middle"
picture middle
drag "$middle" $((slider_right + 20))
eventually 20 last_level_is "$finest"
picture finest-after

# A busy machine misses some, as the hand goes on meanwhile.
shown=$(grep -o "LOG: . Level [0-9]* of $finest" "$out/meshlab.log" | sort -u | wc -l)
((3 * shown >= finest + 1)) || fail "Only $shown of $((finest + 1)) levels were shown while dragging."
(($(differing finest-before base) > 1000)) || fail "The picture did not change down to the base mesh."
(($(differing base middle) > 1000)) || fail "The picture did not change from the base mesh up."
(($(differing finest-before finest-after) == 0)) || fail "The finest level does not look as before."

click "$apply_x" "$buttons_y"
sleep 0.5
click "$close_x" "$buttons_y"
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

# The README's picture of browsing: a level between, the base mesh and the finest level.
convert \( "$out/middle.png" -crop 1270x856+0+0 +repage -resize 1000x \) \
	\( "$out/base.png" "$out/finest-after.png" -crop 1270x856+0+0 +repage -append -resize x674 \) \
	+append -dither None -colors 128 -define png:compression-level=9 "$out/browse.png"
echo "Browsed $((finest + 1)) levels; the pictures are in $out"
