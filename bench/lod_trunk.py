#!/usr/bin/env python3
"""The trunks of the trees at ../shared/trees and of treegrow's species at 25, 10, 5 and 2 % of their triangles: speed of the spectra by
radii and by edges beside meshoptimizer's simplifier, coverage (six level views, 512 pixels) and the mean distance between the
surfaces in percent of the height: of full detail's points from the level ("missing") and of the level's from full detail ("added").

./run bench lod_trunk                           every tree
python3 bench/lod_trunk.py [--speed] NAME...    the trees whose names begin so, and triangle counts: an oak of so many
                                                (the tools and probe_lod_trunk must be in PATH)
"""
import pathlib
import subprocess
import sys
import tempfile

TREES = pathlib.Path(__file__).resolve().parent.parent.parent / "shared" / "trees"
SPECIES = ["oak", "birch", "willow", "spruce"]


def run(*command):
    subprocess.run([str(c) for c in command], check=True)


def grown(folder, name, *options):
    mesh = folder / f"grown_{name}.glb"
    run("treegrow", *options, "-o", mesh, "--no-textures", "-q")
    return mesh


def main():
    speed = [a for a in sys.argv[1:] if a == "--speed"]
    wanted = [a for a in sys.argv[1:] if a != "--speed"]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        meshes = sorted(p for p in TREES.iterdir() if p.name.endswith((".obj", ".obj.gz"))) if TREES.exists() else []
        meshes = [m for m in meshes if not wanted or m.name.startswith(tuple(wanted))]
        meshes += [grown(folder, s, s) for s in SPECIES if not wanted]
        meshes += [grown(folder, f"oak_{a}", "oak", "--triangles", a) for a in wanted if a.isdigit()]
        trees = []
        for mesh in meshes:
            trees.append(folder / (mesh.name.split(".")[0] + ".stree"))
            run("treeprep", mesh, "-o", trees[-1], "--omit", "leaves", "-q")
        run("probe_lod_trunk", *speed, *trees)


if __name__ == "__main__":
    main()
