#!/usr/bin/env python3
"""Levels of detail of the trees at ../shared/trees (and of treegrow's species) beside meshoptimizer and gltfpack: image error, area,
coverage, silhouette at the same triangle counts; speed of every stage; bytes.

./run bench lod               every tree
python3 bench/lod.py NAME...  the trees whose names begin so (the tools must be in PATH)
"""
import json
import math
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TREES = pathlib.Path(__file__).resolve().parent.parent.parent / "shared" / "trees"
LAST = 200  # triangles of the last geometric level (lodbake --sweep)
SPECIES = ["oak", "birch", "willow", "spruce"]


def find_gltfpack():
    """gltfpack comes from npm, where that is there; without it its rows are left out."""
    folder = ROOT / "build" / "npm"
    if not shutil.which("gltfpack") and not (folder / "node_modules" / "gltfpack").exists() and shutil.which("npm"):
        folder.mkdir(parents=True, exist_ok=True)
        subprocess.run(["npm", "install", "--silent", "--no-fund", "--no-audit", "--prefix", str(folder), "gltfpack"], check=False)
    os.environ["PATH"] += os.pathsep + str(folder / "node_modules" / ".bin")


def run(*command):
    subprocess.run([str(c) for c in command], check=True)


def table(report, name):
    for t in report["tables"]:
        if t["name"] == name:
            return [dict(zip(t["columns"], row)) for row in t["rows"]]
    return []


def bake(mesh, folder):
    tree, levels, page = folder / "tree.stree", folder / "lod.stree", folder / "report.json"
    run("treeprep", mesh, "-o", tree, "-q")
    run("lodbake", tree, "-o", levels, "--discrete", "0.66,0.33,0.15", "--continuous", "--sweep", "--views", 12, "--report", page, "-q")
    report = json.loads(page.read_text())
    small = folder / "small.stree"
    run("lodbake", tree, "-o", small, "--discrete", "0.5", "--continuous", "--divide", "even", "--encode", "small", "-q")
    return report, levels.stat().st_size - tree.stat().st_size, small.stat().st_size - tree.stat().st_size


def show_last(report, lasts, name):
    """The last geometric level, 200 triangles: the goal is 95 % of the leaf area, and a silhouette IoU of 0.8 or twice the best peer's."""
    rows = table(report, "last geometric level")
    peers = {}
    for r in rows:
        reached = float(r["Triangles"]) <= 1.15 * LAST
        print(f"   last {r['Method']:28s} {r['Triangles']:>8s} leaf area {r['Leaf area'] or '-':>6s} coverage {r['Coverage']:>6s} "
              f"IoU {r['Silhouette IoU']:>6s} RMSE {r['RMSE']:>7s} hull {r['Hull growth']:>6s}{'' if reached else ' stuck'}")
        if reached and r["Method"].startswith(("meshopt", "gltfpack")):
            peers[r["Method"]] = float(r["Silhouette IoU"])
    for r in rows:
        if r["Method"] == "copse":
            lasts.append((name, int(r["Triangles"]), r["Leaf area"], float(r["Silhouette IoU"]), max(peers.values(), default=None)))


def print_lasts(lasts):
    print(f"\nlast geometric level, {LAST} triangles: tree, triangles, leaf area, silhouette IoU, the best peer's, ratio")
    good = {"area": 0, "iou": 0}
    leafy = [x for x in lasts if x[2]]
    for name, triangles, area, iou, peer in lasts:
        ratio = iou / peer if peer else math.inf
        good["area"] += bool(area) and float(area) >= 0.95
        good["iou"] += iou >= 0.8 or ratio >= 2
        print(f"  {name:34s} {triangles:4d} {area or '-':>6s} {iou:6.3f} {'stuck' if peer is None else f'{peer:.3f}':>6s} {ratio:6.2f}")
    print(f"  leaf area >= .95 on {good['area']} of {len(leafy)}; IoU >= .8 or twice the best peer's on {good['iou']} of {len(lasts)}")


def show(name, mesh, folder, ratios, lasts):
    report, fast, small = bake(mesh, folder)
    speed = {s["name"]: s["items"] / s["seconds"] / 1e6 for s in report["stages"] if s["name"] in ("trunk", "leaves") and s["seconds"] > 0}
    print(f"\n{name}: trunk {speed.get('trunk', 0):.2f}, leaves {speed.get('leaves', 0):.2f} Mtri/s; spectra {fast} bytes fast, {small} small")
    rows = table(report, "sweep")
    show_last(report, lasts, name)
    best = {}
    full = {r["Share"]: float(r["Triangles"]) / float(r["Share"]) for r in rows if r["Method"] == "copse" and float(r["Share"]) >= 0.5}
    whole = next(iter(full.values()), 0)
    for r in rows:
        print(f"  {r['Share']:>5s} {r['Method']:28s} {r['Triangles']:>8s} area {r['Area']:>6s} coverage {r['Coverage']:>6s} "
              f"IoU {r['Silhouette IoU']:>6s} RMSE {r['RMSE']:>7s} SSIM {r['SSIM']:>6s} hull {r['Hull growth']:>6s}")
        key = "ours" if r["Method"] == "copse" else "peer" if r["Method"].startswith(("meshopt", "gltfpack")) else None
        # A simplifier that stops early shows more triangles: no match at this count.
        if key and float(r["Triangles"]) <= 1.15 * float(r["Share"]) * whole:
            at = best.setdefault(r["Share"], {})
            at[key] = min(at.get(key, math.inf), float(r["RMSE"]))
    for share, b in best.items():
        if b.get("ours", 0) > 0:
            ratios.setdefault(share, []).append(b["peer"] / b["ours"] if "peer" in b else math.inf)


def main():
    wanted = sys.argv[1:]
    find_gltfpack()
    ratios, lasts = {}, []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        meshes = sorted(p for p in TREES.iterdir() if p.name.endswith((".obj", ".obj.gz"))) if TREES.exists() else []
        for species in SPECIES:
            grown = folder / f"grown_{species}.obj"
            if not wanted or any(grown.name.startswith(w) for w in wanted):
                run("treegrow", species, "-o", grown, "-q")
                meshes.append(grown)
        for mesh in meshes:
            if not wanted or any(mesh.name.startswith(w) for w in wanted):
                show(mesh.name, mesh, folder, ratios, lasts)
    print("\nRMSE of the best peer / RMSE of copse, where a peer gets down to the triangles asked for")
    for share, r in ratios.items():
        reached = [x for x in r if x < math.inf]
        middle = f"median {statistics.median(reached):.2f}, least {min(reached):.2f}, better on {sum(x > 1 for x in reached)}, " if reached else ""
        print(f"  {share:>5s}: {middle}{len(reached)} of {len(r)} reached")
    if lasts:
        print_lasts(lasts)


if __name__ == "__main__":
    main()
