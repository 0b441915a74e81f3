#!/usr/bin/env python3
"""ecogen on 10 thousand to 10 million instances of 8 types over a terrain of 1024 x 1024 vertices.

./run bench ecosystem [LARGEST]
Wall and CPU seconds (user + system) of the whole process, wall seconds of each stage; bytes of the file; how far packed positions, axes
and feet are off; what opening it for use costs (probe_ecosystem: a warm file,
the median of many) under each degree of trust; and what culling costs a frame, by the box hierarchy and by testing every
block. The floor of writing is what `dd conv=fsync` takes for as many bytes.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

AXIS = "axis off the terrain's normal"
SIZES = [10_000, 100_000, 1_000_000, 10_000_000]


def page(count, placement):
    types = []
    for i in range(8):
        t = {"name": f"t{i}", "tree": "tree.stree", "count": count // 8, "scale": {"min": 0.05, "max": 0.1}, "tilt": "terrain"}
        if placement == "rules":
            t["slope"] = {"max": 60}
        if placement == "spacing":
            t["spacing"] = 2.5
        types.append(t)
    return {"seed": 1, "terrain": {"size": [1023, 1023], "samples": [1024, 1024], "faults": {"count": 200, "first": 1, "last": 0.05, "smooth": 2}}, "types": types}


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


def main():
    largest = int(sys.argv[1]) if len(sys.argv) > 1 else SIZES[-1]
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        subprocess.run(["treegrow", "oak", "-o", str(folder / "tree.glb"), "--triangles", "2000", "--no-textures", "-q"], check=True)
        subprocess.run(["treeprep", str(folder / "tree.glb"), "-o", str(folder / "tree.stree"), "-q"], check=True)
        print(f"{'instances':>10s} {'placed by':>10s} {'bytes each':>10s} {'s':>7s} {'CPU s':>7s} {'MB':>7s} {'floor s':>8s} {'position m':>11s} {'axis rad':>9s} {'foot':>8s}  stages, s")
        rows = [(n, "cells", "packed") for n in SIZES if n <= largest]
        rows += [(min(1_000_000, largest), p, e) for p, e in (("cells", "exact"), ("rules", "packed"))] + [(min(20_000, largest), "spacing", "packed")]
        for count, placement, encoding in rows:
            seconds, cpu, report, size = run(folder, count, placement, encoding)
            stages = ", ".join(f"{s['name']} {s['seconds']:.2f}" for s in report["stages"] if s["seconds"] >= 0.005)
            print(f"{count:>10d} {placement:>10s} {24 if encoding == 'packed' else 48:>10d} {seconds:>7.2f} {cpu:>7.2f} {size / 1e6:>7.1f} {floor(folder, size):>8.2f} "
                  f"{error(report, 'stored position'):>11.1e} {error(report, AXIS):>9.1e} {error(report, 'foot off the ground'):>8.1e}  {stages}", flush=True)
            subprocess.run(["probe_ecosystem", str(folder / "f.eco")], check=True)


if __name__ == "__main__":
    main()
