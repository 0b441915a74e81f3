#!/usr/bin/env python3
"""treeprep's throughput and memory on grown trees of 0.3 to 10 million triangles, and every tool's --version.

./run bench speed
Triangles a second a core leave reading apart: everything from welding to the written file, in CPU seconds of one thread
(-j 1). The floor is the raw geometry's bytes read and written once.
"""
import json
import os
import pathlib
import statistics
import subprocess
import tempfile
import time

SIZES = [300_000, 1_000_000, 3_000_000, 10_000_000]


def prepare(folder, triangles):
    mesh, report = folder / "tree.glb", folder / "report.json"
    subprocess.run(["treegrow", "oak", "-o", str(mesh), "--triangles", str(triangles), "-q"], check=True)
    subprocess.run(["treeprep", str(mesh), "-o", str(folder / "tree.stree"), "-j", "1", "-q", "--report", str(report)], check=True)
    return mesh, json.loads(report.read_text())


def speed_rows(folder):
    print(f"{'triangles':>10s} {'read s':>8s} {'rest s':>8s} {'Mtri/s/core':>12s} {'peak/raw':>9s}  stages")
    for size in SIZES:
        mesh, report = prepare(folder, size)
        stages = {s["name"]: s["seconds"] for s in report["stages"]}
        triangles = next(s["items"] for s in report["stages"] if s["name"] == "read")
        rest = sum(t for n, t in stages.items() if n != "read")
        raw = geometry_bytes(mesh)
        detail = ", ".join(f"{n} {t:.2f}" for n, t in stages.items() if n != "read")
        print(f"{triangles:10d} {stages['read']:8.2f} {rest:8.2f} {triangles / rest / 1e6:12.2f} {report['peak_bytes'] / raw:9.2f}  {detail}",
              flush=True)


def geometry_bytes(glb):
    """The bytes of vertices and indices in a GLB: its binary chunk without images."""
    data = glb.read_bytes()
    length = int.from_bytes(data[12:16], "little")
    document = json.loads(data[20:20 + length])
    images = {i["bufferView"] for i in document.get("images", []) if "bufferView" in i}
    return sum(v["byteLength"] for i, v in enumerate(document["bufferViews"]) if i not in images)


def version_rows():
    print(f"\n{'--version':12s} {'median ms of 21':>16s}")
    for tool in ["treeprep", "treedump", "treegrow", "treeplay"]:
        times = []
        for _ in range(21):
            start = time.perf_counter()
            subprocess.run([tool, "--version"], check=True, stdout=subprocess.DEVNULL)
            times.append(time.perf_counter() - start)
        print(f"{tool:12s} {statistics.median(times) * 1e3:16.1f}")


def main():
    print(f"{os.cpu_count()} cores")
    version_rows()
    print()
    with tempfile.TemporaryDirectory() as name:
        speed_rows(pathlib.Path(name))


if __name__ == "__main__":
    main()
