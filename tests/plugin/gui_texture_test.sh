#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# gui_texture_test.sh BUILD: browses samples/die.ply, which has a texture, in MeshLab's window (on a
# display of its own) from a .wmc: to a level with a sixteenth of the vertices and back. Checks that
# the pips stay on the die. Then colours it by the normal component of the details. The pictures stay
# in BUILD/gui-texture.
set -euo pipefail

build=$1
samples=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../samples")
out=$build/gui-texture
# shellcheck source=tests/plugin/gui_meshlab.sh
. "$(dirname "${BASH_SOURCE[0]}")/gui_meshlab.sh"

cp "$samples/die.png" "$out"
"$build/wmc" encode "$samples/die.ply" "$out/die.wmc" >/dev/null
read -r coarse finest < <("$build/wmc" info "$out/die.wmc" --json | python3 -c '
import json, sys
levels = json.load(sys.stdin)["levels"]
few = [row["level"] for row in levels if 16 * row["vertices"] <= levels[-1]["vertices"]]
print(few[-1], levels[-1]["level"])')

# pips NAME: how many pixels of the view are of their colour, in any light
pips() {
	convert "$out/$1-view.png" -channel R -separate "$out/red.png"
	convert "$out/$1-view.png" -channel G -separate "$out/green.png"
	convert "$out/red.png" "$out/green.png" -compose minus_src -composite -threshold 12% \
		-format '%[fx:int(mean * w * h)]' info:
}

# show LEVEL: by the slider
show() {
	xdotool mousemove $((slider_left + (slider_right - slider_left) * $1 / finest)) "$slider_y"
	eventually 20 last_level_is "$1"
}

start_meshlab "$out/die.wmc"
open_filter 'Wavemesh: Browse Levels' 'Browse Levels'
picture fine
find_slider "$out/fine.png"
click "$preview_x" "$preview_y"
xdotool mousemove "$slider_right" "$slider_y" mousedown 1
show "$coarse"
picture coarse
show "$finest"
xdotool mouseup 1
picture again
click "$close_x" "$buttons_y"

dialog_top=60
open_filter 'Wavemesh: Colour by Detail' 'Colour by Detail'
picture colour-dialog
xdotool mousemove $((X + WIDTH / 2 + 40)) $((Y + 175)) click 5 # the wheel: the next measure
sleep 0.5
picture colour-measure
click "$apply_x" "$buttons_y"
eventually 20 grep -q 'Applied filter: Wavemesh: Colour by Detail' "$out/meshlab.log"
picture colour

fine=$(pips fine)
coarse=$(pips coarse)
((fine > 2000)) || fail "The die has no pips: $fine pixels of their colour."
((10 * coarse > 8 * fine && 8 * coarse < 10 * fine)) || fail "The pips went from $fine to $coarse pixels."
(($(differing fine coarse) > 1000)) || fail "The coarse level looks like the finest."
(($(differing again colour) > 1000)) || fail "No colours show."
(($(differing fine again) == 0)) || fail "The finest level does not look as before."
echo "The pictures are in $out"
