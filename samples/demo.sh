#!/usr/bin/env bash
# The main job on the samples: grow (stands in for an artist's export), prepare, look inside, draw. Called by ./run demo.
set -euo pipefail
cd "$(dirname "$0")/.."
bin=$PWD/build/release/bin
out=out
samples=samples/trees.txt
mkdir -p "$out"

step() { printf '   %-10s %s\n' "$1" "$2"; }

while read -r name arguments; do
  [ -n "$name" ] && [ "${name#\#}" = "$name" ] || continue
  printf '== %s\n' "$name"
  # shellcheck disable=SC2086  # the arguments of a sample are several words
  "$bin/treegrow" $arguments -o "$out/$name.glb" --truth "$out/$name.truth.json" -q
  step treegrow "$out/$name.glb"
  "$bin/treeprep" "$out/$name.glb" -o "$out/$name.stree" --report "$out/$name.prep.json" --html "$out/$name.prep.html" -q
  step treeprep "$out/$name.stree, $out/$name.prep.html"
  "$bin/bvfit" "$out/$name.stree" --sweep --export-glb "$out/$name.volumes.glb" --html "$out/$name.volumes.html" \
    >"$out/$name.volumes.txt"
  "$bin/bvfit" "$out/$name.stree" --per groups,segments --hierarchy kd4 --quality fast -o "$out/$name.stree" -q
  step bvfit "volumes in $out/$name.stree, $out/$name.volumes.html"
  "$bin/treedump" "$out/$name.stree" --verify -q
  "$bin/treedump" "$out/$name.stree" --hierarchy >"$out/$name.hierarchy.json"
  "$bin/treedump" "$out/$name.stree" >"$out/$name.txt"
  step treedump "verified; $out/$name.txt"
  "$bin/lodbake" "$out/$name.stree" -o "$out/$name.lod.stree" --discrete 0.5,0.25,0.1,0.02 --html "$out/$name.lod.html" -q
  "$bin/treedump" "$out/$name.lod.stree" --export "$out/$name.lod.glb" -q
  step lodbake "$out/$name.lod.stree, $out/$name.lod.html, $out/$name.lod.glb"
  "$bin/treeplay" "$out/$name.stree" --headless --size 640x720 --frames "$out/$name.png" --report "$out/$name.play.json" -q
  "$bin/treeplay" "$out/$name.stree" --headless --size 640x720 --show skeleton --frames "$out/$name.skeleton.png" -q
  step treeplay "$out/$name.png, $out/$name.skeleton.png"
done <"$samples"

printf '== forest\n'
forest=$out/forest
mkdir -p "$forest"
while read -r name arguments; do
  [ -n "$name" ] && [ "${name#\#}" = "$name" ] || continue
  # shellcheck disable=SC2086  # the arguments of a tree are several words
  "$bin/treegrow" $arguments -o "$forest/$name.glb" -q
  "$bin/treeprep" "$forest/$name.glb" -o "$forest/$name.stree" -q
  "$bin/bvfit" "$forest/$name.stree" -o "$forest/$name.stree" --per whole --sway 4 -q
  "$bin/lodbake" "$forest/$name.stree" -o "$forest/$name.stree" --discrete 0.3,0.08 --impostor 64 --quality fast -q
done <samples/forest/trees.txt
step treegrow "$forest/*.glb; treeprep, bvfit, lodbake: $forest/*.stree"
python3 samples/forest/maps.py "$forest"
cp samples/forest/forest.json "$forest/forest.json"
step maps "$forest/*.png"
"$bin/ecogen" "$forest/forest.json" -o "$forest/forest.eco" --export "$forest/map.png" --html "$forest/forest.html" --report "$forest/forest.report.json" -q
"$bin/treedump" "$forest/forest.eco" --verify -q
"$bin/treedump" "$forest/forest.eco" >"$forest/forest.txt"
step ecogen "$forest/forest.eco, verified; $forest/map.png, $forest/forest.html"
"$bin/treeplay" "$forest/forest.eco" --headless --size 1280x720 --samples 4 --camera 116,6,104,60,4,66,55 --above-ground --sun 12,38 --frames "$out/forest.png" -q
step treeplay "$out/forest.png"

python3 samples/demo_page.py "$out" "$samples" >"$out/index.html"
printf '\nOpen %s/index.html: every tree, how exactly its hierarchy was recovered, and how long each step took.\n' "$out"
