#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# docs/make_pictures.sh: makes the pictures of README.md and docs/tutorial.md anew, of what MeshLab's
# window shows in the tests. Sets up and builds first what is missing or not up to date.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=cmake/setup.sh
. cmake/setup.sh
if [[ ! -x $build/meshlab/meshlab || ! -f $build/build.ninja ]]; then
	set_up "${packages_build[@]}" "${packages_tests[@]}"
	make_meshlab_folder
	configure meshlab
fi
build_targets "Building Wavemesh" "$build" wmc wmc-thumbnailer io_wavemesh filter_wavemesh meshlab_host
images=$root/docs/images
mesh=$root/samples/pretzel.ply

"$root/tests/plugin/gui_test.sh" "$build" "$root/samples/bracket.ply"
"$root/tests/plugin/gui_filters_test.sh" "$build" "$mesh"
"$root/tests/plugin/gui_texture_test.sh" "$build"
cp "$build/gui/browse.png" "$images/browse.png"

# small FILE NAME [ARGUMENTS...]: of the whole screen, in few colours
small() {
	local file=$1 name=$2
	shift 2
	convert "$file" -crop 1276x856+0+0 +repage "$@" -dither None -colors 96 \
		-define png:compression-level=9 "$images/$name.png"
}
small "$build/gui/middle.png" tutorial-browse -resize 900x
small "$build/gui/save-options.png" tutorial-save -resize 900x
small "$build/gui-texture/colour.png" tutorial-colour -resize 900x
small "$build/gui-filters/equaliser-strong.png" tutorial-equalise -resize 900x
for name in before strong smooth; do
	convert "$build/gui-filters/equaliser-$name-view.png" -crop 740x330+20+220 +repage "$build/gui-filters/cut-$name.png"
done
convert "$build"/gui-filters/cut-{smooth,before,strong}.png +append -resize 900x -dither None -colors 64 \
	-define png:compression-level=9 "$images/tutorial-gains.png"

convert "$build"/gui-texture/{coarse,fine}-view.png -crop 520x460+130+160 +repage +append -resize 900x -dither None \
	-colors 96 -define png:compression-level=9 "$images/tutorial-texture.png"

# The report's picture, by a filter script.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/report.mlx" <<END
<!DOCTYPE FilterScript>
<FilterScript>
 <filter name="Wavemesh: Rate-Distortion Report">
  <Param name="picture" type="RichSaveFile" value="$images/tutorial-report.png" ext="" description="" tooltip=""/>
  <Param name="picture_width" type="RichInt" value="800" description="" tooltip=""/>
 </filter>
</FilterScript>
END
plugins=$(readlink -f "$build/meshlab/plugins/libio_base.so")
QT_QPA_PLATFORM=offscreen "$build/meshlab_host" --plugins "$(dirname "$plugins")" --plugins "$build/plugins" \
	--script "$work/report.mlx" --out "$work" "$mesh" >/dev/null
convert "$images/tutorial-report.png" -dither None -colors 64 -define png:compression-level=9 "$images/tutorial-report.png"

for sample in bracket pretzel blob; do
	"$build/wmc-thumbnailer" "$root/samples/$sample.wmc" "$work/$sample.png" --size 128
done
convert "$work"/{bracket,pretzel,blob}.png +append +repage "$images/tutorial-thumbnails.png"
ls -l "$images"
