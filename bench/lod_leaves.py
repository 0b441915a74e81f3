#!/usr/bin/env python3
"""The leaves of the trees at ../shared/trees and of treegrow's species at 50, 25, 10, 5 and 2 % of their triangles: area, coverage, hull
growth and image error of leaf collapse beside meshoptimizer, and how many trees meet the targets. The tables of docs/results/lod-leaves.md.

./run bench lod_leaves                              every tree, balanced: a minute or two of a processor
python3 bench/lod_leaves.py [--quality Q] NAME...   the trees whose names begin so (treeprep, treegrow and bench_lod_leaves must be in PATH)
"""
import pathlib
import statistics
import subprocess
import sys
import tempfile

TREES = pathlib.Path(__file__).resolve().parent.parent.parent / "shared" / "trees"
SPECIES = ["oak", "birch", "spruce", "willow", "palm"]
RATIOS = ["0.500", "0.250", "0.100", "0.050", "0.020"]
COLUMNS = ["tree", "method", "ratio", "tris", "area", "cover", "range", "iou", "low", "rmse", "ssim", "hull", "speed", "fits"]


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True).stdout


def prepared(folder, wanted):
    meshes = sorted(p for p in TREES.iterdir() if p.name.endswith((".obj", ".obj.gz"))) if TREES.exists() else []
    for species in SPECIES:
        meshes.append(folder / f"treegrow_{species}.glb")
    for mesh in meshes:
        if wanted and not mesh.name.startswith(tuple(wanted)):
            continue
        if mesh.parent == folder:
            run("treegrow", mesh.stem.removeprefix("treegrow_"), "-o", mesh, "-q")
        tree = folder / (mesh.name.split(".")[0] + ".stree")
        run("treeprep", mesh, "-o", tree, "-q")
        yield tree


def measured(tree, quality):
    rows = {}
    for line in run("bench_lod_leaves", "--views", 12, "--quality", quality, tree).splitlines()[1:]:
        row = dict(zip(COLUMNS, line.replace("- ", "-").split()))
        if len(row) == len(COLUMNS):
            rows[row["method"], row["ratio"]] = row
    return rows


def reached(ours, peer):
    return int(peer["tris"]) <= 1.02 * int(ours["tris"]) + 2


def print_tables(trees):
    for ratio in RATIOS:
        print(f"\n## {ratio} of the triangles\n\n| tree | triangles | area | fits | coverage | low-high | IoU | RMSE | hull | meshoptimizer: triangles | coverage | RMSE | ratio |")
        print("|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|")
        for name, rows in trees.items():
            o, p = rows["collapse", ratio], rows["meshopt", ratio]
            times = "stuck" if not reached(o, p) else f"{float(p['rmse']) / float(o['rmse']):.2f}" if float(o["rmse"]) > 0 else "-"
            print(f"| {name} | {o['tris']} | {o['area']} | {o['fits']} | {o['cover']} | {o['range']} | {o['iou']} | {o['rmse']} | {o['hull']} "
                  f"| {p['tris']} | {p['cover']} | {p['rmse']} | {times} |")


def print_targets(trees):
    print("\n| ratio | area within 2 % | ... or of what fits | coverage .95 to 1.05 | hull growth <= 3 % | largest | RMSE below meshoptimizer's | median ratio |\n|---|---:|---:|---:|---:|---:|---:|---:|")
    for ratio in RATIOS:
        ours = [(r["collapse", ratio], r["meshopt", ratio]) for r in trees.values()]
        count = lambda good: sum(good(o) for o, _ in ours)
        beside = [float(p["rmse"]) / float(o["rmse"]) for o, p in ours if reached(o, p) and float(o["rmse"]) > 0]
        print(f"| {ratio} | {count(lambda o: abs(float(o['area']) - 1) <= .02)} of {len(ours)} | {count(lambda o: abs(float(o['area']) - 1) <= .02 or float(o['area']) >= .98 * float(o['fits']))} "
              f"| {count(lambda o: .95 <= float(o['cover']) <= 1.05)} | {count(lambda o: float(o['hull']) <= .03)} | {max(float(o['hull']) for o, _ in ours):.4f} "
              f"| {sum(b > 1 for b in beside)} of {len(beside)} | {statistics.median(beside) if beside else 0:.2f} |")


def main():
    arguments, quality = sys.argv[1:], "balanced"
    if "--quality" in arguments:
        at = arguments.index("--quality")
        quality = arguments[at + 1]
        del arguments[at:at + 2]
    with tempfile.TemporaryDirectory() as name:
        trees = {}
        for tree in prepared(pathlib.Path(name), arguments):
            rows = measured(tree, quality)
            if rows:
                trees[tree.stem] = rows
    print_tables(trees)
    print_targets(trees)


if __name__ == "__main__":
    main()
