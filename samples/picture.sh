#!/usr/bin/env bash
# The picture of the README: samples grown, prepared and drawn, tile by tile.
#   ./run build && samples/picture.sh docs/trees.png
set -euo pipefail
picture=$(realpath "${1:?which file shall the picture become?}")
cd "$(dirname "$0")/.."
bin=$PWD/build/release/bin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

draw() { "$bin/treeplay" "$work/$1.stree" --headless --size 240x270 --samples 16 --frames "$work/$2.png" -q "${@:3}"; }

rows=("oak birch willow spruce palm" "pine cherry bush dead")
for name in ${rows[*]}; do
  arguments=$(sed -n "s/^$name  *//p" samples/trees.txt)
  # shellcheck disable=SC2086  # the arguments of a sample are several words
  "$bin/treegrow" $arguments -o "$work/$name.glb" -q
  "$bin/treeprep" "$work/$name.glb" -o "$work/$name.stree" -q
  draw "$name" "$name"
done
draw oak oak-skeleton --show skeleton
# shellcheck disable=SC2086
python3 samples/tiles.py 5 "$picture" $(printf "$work/%s.png " ${rows[*]} oak-skeleton)
