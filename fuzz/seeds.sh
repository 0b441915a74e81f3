#!/usr/bin/env bash
# Writes the seeds of fuzz_container that only the tools can make: trees with volumes, levels, cells and impostors.
#   PATH=$PWD/build/release/bin:$PATH fuzz/seeds.sh fuzz/corpus/container
set -euo pipefail
to=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

treegrow palm --triangles 300 -o palm.obj -q
treeprep palm.obj -o palm.stree -q
bvfit palm.stree --per groups --hierarchy kd4 --volumes sphere,obb,capsule -o "$to/volumes.stree" -q
lodbake palm.stree -o "$to/levels_small.stree" --continuous --divide even --encode small -q
lodbake palm.stree -o "$to/levels_fast.stree" --trunk edges --discrete 0.3 --divide even --encode fast -q
lodbake palm.stree -o "$to/cells.stree" --method prune --cells 4 --views 12 --divide even --encode small -q
lodbake palm.stree -o "$to/impostor.stree" --discrete 0.3 --impostor 8 --impostor-views 3 --divide even --encode small -q
