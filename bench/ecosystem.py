#!/usr/bin/env python3
"""ecogen on 10 thousand to 10 million instances of 8 types over a terrain of 1024 x 1024 vertices, and the player on a million.

./run bench ecosystem [LARGEST]
Wall and CPU seconds (user + system) of the whole process, wall seconds of each stage; bytes of the file; how far packed positions, axes
and feet are off; what opening it for use costs (probe_ecosystem: a warm file,
the median of many) under each degree of trust; and what culling costs a frame, by every hierarchy. The floor of writing is what
`dd conv=fsync` takes for as many bytes.

Then treeplay on a million trees of 8 species, with levels and impostors, on 8 x 8 km: its stage "open", culling along a path by every
hierarchy, and a picture from eye height, written to PICTURE where that variable is set.

Rows "full" ask for trees with spacing on ground that holds half of them (`fewer`): what has to be found is that no gap is left.
Rows "bush" are cells with a low and wide tree, which need more blocks; "bare" have no kd-tree and no R-tree over the blocks.
"""
import json
import os
import pathlib
import subprocess
import shutil
import sys
import tempfile
import time

AXIS = "axis off the terrain's normal"
SIZES = [10_000, 100_000, 1_000_000, 10_000_000]


def page(count, placement):
    types = []
    for i in range(8):
        t = {"name": f"t{i}", "tree": "bush.stree" if "bush" in placement else "oak.stree", "count": count // 8, "scale": {"min": 0.05, "max": 0.1}, "tilt": "terrain"}
        if placement == "rules":
            t["slope"] = {"max": 60}
        if placement == "spacing":
            t["spacing"] = 2.5
        if placement == "full":
            t |= {"spacing": 28.5 * (100_000 / count) ** 0.5, "fewer": True}
        types.append(t)
    return {"seed": 1, "block_trees": [] if "bare" in placement else ["kd", "r"],
            "terrain": {"size": [1023, 1023], "samples": [1024, 1024], "faults": {"count": 200, "first": 1, "last": 0.05, "smooth": 2}}, "types": types}


def run(folder, count, placement, encoding="packed"):
    document = page(count, placement)
    document["encoding"] = encoding
    (folder / "page.json").write_text(json.dumps(document))
    begin, before = time.perf_counter(), os.times()
    subprocess.run(["ecogen", str(folder / "page.json"), "-o", str(folder / "f.eco"), "-q", "-j", "2"], check=True)
    seconds, after = time.perf_counter() - begin, os.times()
    cpu = after.children_user + after.children_system - before.children_user - before.children_system
    subprocess.run(["ecogen", str(folder / "page.json"), "-o", str(folder / "f.eco"), "-q", "-j", "2", "--report", str(folder / "r.json")], check=True)
    return seconds, cpu, json.loads((folder / "r.json").read_text()), (folder / "f.eco").stat().st_size


def floor(folder, size):
    begin = time.perf_counter()
    subprocess.run(["dd", "if=/dev/zero", f"of={folder}/floor", "bs=1M", f"count={max(size >> 20, 1)}", "conv=fsync"], check=True, stderr=subprocess.DEVNULL)
    return time.perf_counter() - begin


def error(report, name):
    return next((e["max"] for e in report["errors"] if e["name"] == name), 0)


SPECIES = ["oak", "birch", "spruce", "pine", "bush", "cherry", "willow", "grass"]
HILLS = [[0, 200, 0, 400, 200, 0], [200, 0, -200, 0, 400, 200], [0, -200, -400, -200, 0, 200], [400, 0, -200, -200, 200, 0], [200, 400, 200, 0, 200, 200], [0, 200, 400, 200, 0, 0]]
EYE = ["--camera", "3600,2,5200,4200,0,3200,50", "--above-ground"]


def grow_forest(folder, count):
    """A million trees as a player wants them: every species with three levels and an impostor."""
    types = []
    for s in SPECIES:
        subprocess.run(["treegrow", s, "-o", f"{folder}/{s}.glb", "--triangles", "6000", "-q"], check=True)
        subprocess.run(["treeprep", f"{folder}/{s}.glb", "-o", f"{folder}/{s}.stree", "-q"], check=True)
        subprocess.run(["lodbake", f"{folder}/{s}.stree", "-o", f"{folder}/{s}.stree", "--discrete", "0.3,0.1,0.03", "--divide", "even", "--impostor", "64", "-q"], check=True)
        types.append({"name": s, "tree": f"{s}.stree", "count": count // 8, "scale": {"min": 0.7, "max": 1.2}, "footprint": 1})
    types[-1] |= {"tilt": "terrain", "view_range": 80}
    page = {"seed": 1, "terrain": {"size": [8000, 8000], "samples": [1024, 1024], "nurbs": {"heights": HILLS}, "faults": {"count": 200, "first": 5, "last": 0.5, "smooth": 4}},
            "block_trees": ["kd", "r"], "types": types}
    (folder / "forest.json").write_text(json.dumps(page))
    subprocess.run(["ecogen", f"{folder}/forest.json", "-o", f"{folder}/forest.eco", "-q"], check=True)


def play(folder, *more):
    """The report, and the CPU seconds of the whole process."""
    before = os.times()
    subprocess.run(["treeplay", f"{folder}/forest.eco", "--headless", "-q", "--report", f"{folder}/p.json", *more], check=True)
    after = os.times()
    return json.loads((folder / "p.json").read_text()), after.children_user + after.children_system - before.children_user - before.children_system


def table(report, name):
    return next(t["rows"] for t in report["tables"] if t["name"] == name)


def player(folder, count):
    grow_forest(folder, count)
    keys = [{"time": t, "eye": [1500 + 900 * t, 420 - 60 * t, 6500 - 700 * t], "target": [2600 + 1000 * t, 150, 5400 - 1300 * t]} for t in range(6)]
    (folder / "path.json").write_text(json.dumps({"schema": "copse.path/1", "fov": 50, "keys": keys}))
    print(f"\ntreeplay on {count} trees of 8 species\n\nculling along a path of 4 frames, the mean of a frame")
    print(f"{'--cull':>10s} {'nodes':>8s} {'blocks':>8s} {'planes':>8s} {'seen':>8s} {'tested':>9s} {'drawn':>9s} {'ms':>8s}")
    for by in ("flat", "hierarchy", "coherent", "kd", "r"):
        report, _ = play(folder, "--cull", by, "--path", f"{folder}/path.json", "--count", "4", "--size", "32x18", "--samples", "1", "--unlit")
        cells = table(report, "culling, the mean of a frame")[0]
        print(f"{by:>10s} " + " ".join(f"{c:>{w}s}" for c, w in zip(cells, (8, 8, 8, 8, 9, 9, 8))), flush=True)
    report, cpu = play(folder, *EYE, "--size", "960x540", "--samples", "4", "--frames", f"{folder}/eye.png", "--stats", f"{folder}/s.csv")
    stages = {s["name"]: s["seconds"] for s in report["stages"]}
    head, row = [line.split(",") for line in (folder / "s.csv").read_text().splitlines()]
    frame = dict(zip(head, row))
    print(f"\na picture from eye height, 960 x 540, 4 samples: {frame['instances_drawn']} trees, {frame['impostors']} of them as pictures, {frame['triangles']} triangles; "
          f"{float(frame['t_application']):.3f} s to decide, {float(frame['t_render']):.1f} s to draw (shadows: {frame['shadow_triangles']} triangles); {cpu:.1f} CPU s for the whole run")
    decided = sum(stages[k] for k in ("open", "terrain", "trees", "sky light"))
    print(f"before graphics (open, terrain, trees, sky light): {decided:.3f} s of wall time")
    print("stages, s: " + ", ".join(f"{k} {v:.4f}" for k, v in stages.items()))
    print("read: " + ", ".join(f"{r[1]} of {r[2]} {r[0]}" for r in table(report, "instances read from the file")))
    if os.environ.get("PICTURE"):
        shutil.copy(folder / "eye.png", os.environ["PICTURE"])


def main():
    largest = int(sys.argv[1]) if len(sys.argv) > 1 else SIZES[-1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for tree in ("oak", "bush"):
            subprocess.run(["treegrow", tree, "-o", str(folder / f"{tree}.glb"), "--triangles", "2000", "--no-textures", "-q"], check=True)
            subprocess.run(["treeprep", str(folder / f"{tree}.glb"), "-o", str(folder / f"{tree}.stree"), "-q"], check=True)
        print(f"{'instances':>10s} {'placed by':>10s} {'bytes each':>10s} {'s':>7s} {'CPU s':>7s} {'MB':>7s} {'floor s':>8s} {'position m':>11s} {'axis rad':>9s} {'foot':>8s}  stages, s")
        rows = [(n, "cells", "packed") for n in SIZES if n <= largest]
        rows += [(min(1_000_000, largest), p, e) for p, e in (("cells", "exact"), ("bare", "packed"), ("bush", "packed"), ("bare bush", "packed"), ("rules", "packed"))] + [(min(n, largest), p, "packed") for n, p in ((20_000, "spacing"), (1_000_000, "spacing"), (100_000, "full"))]
        for count, placement, encoding in rows:
            seconds, cpu, report, size = run(folder, count, placement, encoding)
            planted = sum(int(row[3]) for row in table(report, "types"))
            stages = f"{planted} planted, " if planted < count else ""
            stages += ", ".join(f"{s['name']} {s['seconds']:.2f}" for s in report["stages"] if s["seconds"] >= 0.005)
            print(f"{count:>10d} {placement:>10s} {24 if encoding == 'packed' else 48:>10d} {seconds:>7.2f} {cpu:>7.2f} {size / 1e6:>7.1f} {floor(folder, size):>8.2f} "
                  f"{error(report, 'stored position'):>11.1e} {error(report, AXIS):>9.1e} {error(report, 'foot off the ground'):>8.1e}  {stages}", flush=True)
            subprocess.run(["probe_ecosystem", str(folder / "f.eco")], check=True)
        player(folder, min(1_000_000, largest))


if __name__ == "__main__":
    main()
