#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# gui_speed.sh BUILD FILE.wmc [LEVELS_PER_SECOND]: how well the levels of FILE follow the slider of
# Wavemesh: Browse Levels in MeshLab's window (on a display of its own): down from the finest level
# and up again, twice, one level at a time. Prints how many of the levels were shown, and how late.
# No test: times depend on the machine, and Xvfb's GL draws without a graphics card.
set -euo pipefail

build=$1
file=$2
rate=${3:-5}
out=$build/gui-speed
# shellcheck source=tests/plugin/gui_meshlab.sh
. "$(dirname "${BASH_SOURCE[0]}")/gui_meshlab.sh"

finest=$("$build/wmc" info "$file" --json |
	python3 -c 'import json, sys; print(max(row["level"] for row in json.load(sys.stdin)["levels"]))')
start_meshlab "$(realpath "$file")"
# When each line of the log came.
tail -n 0 -F "$out/meshlab.log" 2>/dev/null | while IFS= read -r line; do
	printf '%s %s\n' "$EPOCHREALTIME" "$line"
done >>"$out/times" &
watcher=$!
trap 'kill $meshlab $xvfb $watcher 2>/dev/null || true' EXIT

open_filter 'Wavemesh: Browse Levels' 'Browse Levels'
picture finest
find_slider "$out/finest.png"
click "$preview_x" "$preview_y"

# step_to LEVEL: the slider there, for as long as the rate gives it
step_to() {
	local due
	printf '%s asked %s\n' "$EPOCHREALTIME" "$1" >>"$out/asked"
	xdotool mousemove $((slider_left + (slider_right - slider_left) * $1 / finest)) "$slider_y"
	steps=$((steps + 1))
	due=$(awk -v due="$began" -v n="$steps" -v rate="$rate" -v now="$EPOCHREALTIME" \
		'BEGIN { wait = due + n / rate - now; print (wait > 0 ? wait : 0) }')
	sleep "$due"
}

round() {
	local level
	rm -f "$out/asked"
	: >"$out/times"
	xdotool mousemove "$slider_right" "$slider_y" mousedown 1
	began=$EPOCHREALTIME
	steps=0
	for ((level = finest - 1; level >= 0; --level)); do step_to "$level"; done
	for ((level = 1; level <= finest; ++level)); do step_to "$level"; done
	xdotool mouseup 1
	eventually 60 last_level_is "$finest"
	sleep 1
	python3 - "$out/asked" "$out/times" "$1" <<-'END'
		import re, sys
		asked = [(float(a.split()[0]), int(a.split()[2])) for a in open(sys.argv[1])]
		shown = []
		for line in open(sys.argv[2], errors="replace"):
		    level = re.search(r"^(\S+) LOG: \d Level (\d+) of", line)
		    if level:
		        shown.append((float(level[1]), int(level[2])))
		late, at = [], 0
		for time, level in shown:
		    # The last time that it was asked for.
		    times = [t for t, l in asked if l == level and t <= time]
		    if times:
		        late.append((time - times[-1], level))
		late.sort()
		print(f"{sys.argv[3]}: {len(shown)} pictures of {len(asked)} steps in"
		      f" {shown[-1][0] - asked[0][0]:.1f} s; late by {late[len(late) // 2][0]:.2f} s as a rule,"
		      f" {late[-1][0]:.2f} s at most (level {late[-1][1]})")
	END
}
round 'first time'
round 'again     '
