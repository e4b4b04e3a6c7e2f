#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# gui_filters_test.sh BUILD MESH: MESH in MeshLab's window (on a display of its own): colours it by
# detail, equalises its details with live preview, back and forth, and reports on it. Checks
# MeshLab's log and the pictures, which stay in BUILD/gui-filters.
set -euo pipefail

build=$1
mesh=$2
out=$build/gui-filters
# shellcheck source=tests/plugin/gui_meshlab.sh
. "$(dirname "${BASH_SOURCE[0]}")/gui_meshlab.sh"

# slider_rows PICTURE: left end, right end of the blue part, and height of each slider of the dialog
slider_rows() {
	convert "$1" -crop "$((WIDTH - 20))x$((HEIGHT - 230))+$((X + 10))+$((Y + 30))" -depth 8 txt:- |
		awk -F '[,:() ]+' -v x0="$((X + 10))" -v y0="$((Y + 30))" '
			/^[0-9]/ && $5 - $3 > 80 {
				if (!($2 in n) || $1 < first[$2]) first[$2] = $1
				if (!($2 in n) || $1 > last[$2]) last[$2] = $1
				++n[$2]
				if ($2 > bottom) bottom = $2
			}
			END {
				for (row = 0; row <= bottom; ++row) # a groove is a few rows high: its middle
					if (n[row] > 25 && !(n[row - 1] > 25)) print x0 + first[row], x0 + last[row], y0 + row + 2
			}'
}

# set_value ROW TEXT: types into the field beside the slider of that row, from 1
set_value() {
	local left right y
	read -r left right y < <(sed -n "${1}p" "$out/rows")
	: "${right:?}"
	xdotool mousemove $((left - 30)) "$y" click --repeat 3 1
	xdotool key ctrl+a
	xdotool type -- "$2"
	sleep 0.5
}

applied() {
	(($(grep -c "Applied filter: $1" "$out/meshlab.log") >= ${2:-1}))
}

start_meshlab "$mesh"
picture opened

open_filter 'Wavemesh: Equalise Detail' 'Equalise'
picture equaliser-before
slider_rows "$out/equaliser-before.png" >"$out/rows"
(($(wc -l <"$out/rows") == 5)) || fail "There should be 5 sliders half-way: $(<"$out/rows")"
click "$preview_x" "$preview_y"
picture equaliser-flat
(($(differing equaliser-before equaliser-flat) == 0)) || fail "Gains of 1 changed the picture."
set_value 3 2
set_value 4 2
picture equaliser-strong
(($(differing equaliser-before equaliser-strong) > 1000)) || fail "Gains of 2 do not show."
for band in 3 4 5; do
	set_value "$band" 0
done
picture equaliser-smooth
(($(differing equaliser-strong equaliser-smooth) > 1000)) || fail "Gains of 0 do not show."
for band in 3 4 5; do
	set_value "$band" 1
done
picture equaliser-after
(($(differing equaliser-before equaliser-after) == 0)) || fail "Gains of 1 do not bring it back."
click "$close_x" "$buttons_y"

open_filter 'Wavemesh: Colour by Detail' 'Colour by Detail'
click "$apply_x" "$buttons_y"
eventually 20 applied 'Wavemesh: Colour by Detail'
picture colour
(($(differing opened colour) > 1000)) || fail "No colours show."
click "$close_x" "$buttons_y"

dialog_top=10
open_filter 'Wavemesh: Rate-Distortion Report' 'Rate-Distortion Report'
picture report-dialog
click "$apply_x" "$buttons_y"
eventually 60 applied 'Wavemesh: Rate-Distortion Report'
click "$close_x" "$buttons_y"
picture report
grep -q 'LOG: 2 III: lifting and WGC' "$out/meshlab.log" || fail "The table is not in the log."
kill -0 "$meshlab" || fail "MeshLab has ended."
echo "The pictures are in $out"
