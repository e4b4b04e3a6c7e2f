#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Fuzzes the codec: builds the preset `fuzz` and runs every target, as many at once as there are
# processors (or JOBS), from the seeds and what earlier runs learnt (build-fuzz/corpus).
# usage: tests/fuzz/run.sh MINUTES [TARGET ...]     e.g. tests/fuzz/run.sh 60 decode_fuzz
# Ends with an error if anything was found, and says which input shows it. VCGLIB_DIR names VCGLib.
set -euo pipefail
if [[ ! ${1:-} =~ ^[0-9]+$ ]]; then
	sed -n '3,6s/^# //p' "${BASH_SOURCE[0]}"
	exit 2
fi
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
minutes=$1
shift
targets=("$@")
[[ ${#targets[@]} -gt 0 ]] || targets=(decode_fuzz mended_fuzz round_trip_fuzz coder_fuzz)
jobs=${JOBS:-$(nproc)}

cmake --preset fuzz >/dev/null
cmake --build build-fuzz --target make_fuzz_seeds "${targets[@]}"
programs=$PWD/build-fuzz/tests/fuzz
corpora=$PWD/build-fuzz/corpus
"$programs/make_fuzz_seeds" "$programs/seeds"

# One after the other if there are fewer processors than targets: all get the same time.
((at_once = jobs < ${#targets[@]} ? jobs : ${#targets[@]}))
((seconds = minutes * 60 * at_once / ${#targets[@]}))

# A hang shows after two minutes as well as after a few seconds, and a busy machine does not look
# like one.
fuzz() {
	local target=$1 seeds=files
	[[ $target == round_trip_fuzz || $target == coder_fuzz ]] && seeds=bytes
	mkdir -p "$corpora/$target" "$corpora/findings"
	local given=("$programs/seeds/$seeds")
	[[ -d tests/fuzz/findings/$target ]] && given+=("tests/fuzz/findings/$target")
	[[ $seeds == files ]] && given+=(tests/golden)
	echo "-- $target: $seconds seconds; log in $corpora/$target.log"
	if "$programs/$target" -max_total_time="$seconds" -max_len=4096 -timeout=120 -rss_limit_mb=2500 \
		-artifact_prefix="$corpora/findings/$target-" -print_final_stats=1 \
		"$corpora/$target" "${given[@]}" >"$corpora/$target.log" 2>&1; then
		echo "-- $target: nothing found in $(sed -n 's/^stat::number_of_executed_units: *//p' "$corpora/$target.log") runs"
	else
		grep -E 'NOT TRUE|ERROR|SUMMARY|runtime error|Test unit written' "$corpora/$target.log" >&2
		return 1
	fi
}
export -f fuzz
export programs corpora seconds
printf '%s\n' "${targets[@]}" | xargs -P "$at_once" -I{} bash -c 'fuzz {}'
