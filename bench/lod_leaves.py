#!/usr/bin/env python3
"""The leaves of the trees at ../shared/trees and of treegrow's species at 50, 25, 10, 5 and 2 % of their triangles: area, coverage, hull
growth and image error of leaf collapse beside meshoptimizer, and how many trees meet the targets. The tables of docs/results/lod-leaves.md.

./run bench lod_leaves                              every tree, balanced: a minute or two of a processor
python3 bench/lod_leaves.py [--quality Q] NAME...   the trees whose names begin so (treeprep, treegrow and bench_lod_leaves must be in PATH)
python3 bench/lod_leaves.py --qualities [NAME...]   instead: fast, balanced and exact beside one another
python3 bench/lod_leaves.py --speed [NAME...]       instead: triangles a second of each, meshoptimizer in the same run; of treegrow's oak at three sizes too
python3 bench/lod_leaves.py --errors [NAME...]      instead: the stored errors beside what is measured
"""
import pathlib
import statistics
import subprocess
import sys
import tempfile

TREES = pathlib.Path(__file__).resolve().parent.parent.parent / "shared" / "trees"
SPECIES = ["oak", "birch", "spruce", "willow", "palm"]
RATIOS = ["0.500", "0.250", "0.100", "0.050", "0.020"]
QUALITIES = ["fast", "balanced", "exact"]
SIZES = [30000, 300000, 3000000]
COLUMNS = ["tree", "method", "ratio", "tris", "area", "cover", "range", "iou", "low", "rmse", "ssim", "hull", "speed", "fits"]


def run(*command):
    return subprocess.run([str(c) for c in command], check=True, capture_output=True, text=True).stdout


def prepared(folder, wanted, sizes=()):
    meshes = sorted(p for p in TREES.iterdir() if p.name.endswith((".obj", ".obj.gz"))) if TREES.exists() else []
    grown = {folder / f"treegrow_{species}.glb": [species] for species in SPECIES}
    grown |= {folder / f"treegrow_oak_{size}.glb": ["oak", "--triangles", size] for size in sizes}
    for mesh in meshes + list(grown):
        if wanted and not mesh.name.startswith(tuple(wanted)):
            continue
        if mesh in grown:
            run("treegrow", *grown[mesh], "-o", mesh, "-q")
        tree = folder / (mesh.name.split(".")[0] + ".stree")
        run("treeprep", mesh, "-o", tree, "-q")
        yield tree
        tree.unlink()


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


def print_qualities(folder, wanted):
    rows = {}
    for tree in prepared(folder, wanted):
        of = {q: measured(tree, q) for q in QUALITIES}
        if all(of.values()):
            rows[tree.stem] = of
    value = lambda tree, q, ratio, column: float(rows[tree][q]["collapse", ratio][column])
    print("\n| quality | " + " | ".join(f"RMSE at {r}" for r in RATIOS) + " |\n|---|" + "---:|" * len(RATIOS))
    for q in QUALITIES:
        print(f"| {q} | " + " | ".join(f"{statistics.median(value(t, q, r, 'rmse') for t in rows):.4f}" for r in RATIOS) + " |")
    for column, title in (("rmse", "RMSE"), ("cover", "Coverage"), ("area", "Area")):
        print(f"\n{title}: fast, balanced, exact.\n\n| tree | " + " | ".join(RATIOS) + " |\n|---|" + "---|" * len(RATIOS))
        for t in rows:
            print(f"| {t} | " + " | ".join(" ".join(rows[t][q]["collapse", r][column] for q in QUALITIES) for r in RATIOS) + " |")


def print_speed(folder, wanted):
    rows = []
    print("\n| tree | triangles | fast | its errors | balanced | exact | meshoptimizer |\n|---|---:|---:|---:|---:|---:|---:|")
    for tree in prepared(folder, wanted, SIZES):
        for line in run("bench_lod_leaves", "--speed", tree).splitlines()[1:]:
            rows.append(line.split())
            print("| " + " | ".join(rows[-1]) + " |", flush=True)
    small = [r for r in rows if not r[0].startswith("treegrow_oak_")]
    if small:
        median = lambda column: f"{statistics.median(float(r[column]) for r in small if r[column] != '-'):.3f}"
        print(f"| median without oaks of other sizes | | {' | '.join(median(c) for c in range(2, 7))} |")


def print_errors(folder, wanted):
    print("\n| tree | ratio | triangles | stored, m | measured from full detail | from the level | stored over measured | ns a triangle |\n|---|---:|---:|---:|---:|---:|---:|---:|")
    for tree in prepared(folder, wanted):
        for line in run("bench_lod_leaves", "--errors", tree).splitlines()[1:]:
            print("| " + " | ".join(line.split()) + " |", flush=True)


def main():
    arguments, quality = sys.argv[1:], "balanced"
    if "--quality" in arguments:
        at = arguments.index("--quality")
        quality = arguments[at + 1]
        del arguments[at:at + 2]
    other = {"--qualities": print_qualities, "--speed": print_speed, "--errors": print_errors}
    with tempfile.TemporaryDirectory() as name:
        for option in other.keys() & set(arguments):
            arguments.remove(option)
            return other[option](pathlib.Path(name), arguments)
        trees = {}
        for tree in prepared(pathlib.Path(name), arguments):
            rows = measured(tree, quality)
            if rows:
                trees[tree.stem] = rows
    print_tables(trees)
    print_targets(trees)


if __name__ == "__main__":
    main()
