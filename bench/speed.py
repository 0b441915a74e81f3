#!/usr/bin/env python3
"""treeprep's throughput and memory on grown trees of 0.3 to 10 million triangles, and every tool's --version.

./run bench speed
Triangles a second a core: of the whole process with one thread (-j 1), reading and the start of the image library
included, in CPU seconds, which other work on the machine changes little; "apart" is without the reading of the mesh and
the start. The floor is the raw geometry's bytes read and written once. Memory beyond that of a tree of 300 triangles is the mesh's; that tree's is the image library's.
"""
import json
import os
import pathlib
import resource
import statistics
import subprocess
import tempfile
import time

# Species, breaks, triangles: limbs that are tubes, then one welded surface in random order, which is the most work.
ROWS = [("oak", "", n) for n in (300_000, 1_000_000, 3_000_000, 10_000_000)]
ROWS += [(s, "welded-forks,shuffled", n) for n in (300_000, 1_000_000) for s in ("oak", "spruce", "willow")]
ROWS.sort(key=lambda row: row[2])  # a process's peak counts what started it: this one grows with the meshes


def prepare(folder, species, breaks, triangles):
    mesh, report = folder / "tree.glb", folder / "report.json"
    broken = ["--break", breaks] if breaks else []
    subprocess.run(["treegrow", species, "-o", str(mesh), "--triangles", str(triangles), "-q", *broken], check=True)
    cpu = cpu_seconds(["treeprep", str(mesh), "-o", str(folder / "tree.stree"), "-j", "1", "-q"])
    subprocess.run(["treeprep", str(mesh), "-o", str(folder / "tree.stree"), "-j", "1", "-q", "--report", str(report)], check=True)
    return mesh, json.loads(report.read_text()), cpu


def cpu_seconds(command, check=True):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=check, stdout=subprocess.DEVNULL, stderr=None if check else subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def speed_rows(folder):
    _, small, start = prepare(folder, "oak", "", 300)
    print(f"start: {start:.2f} CPU s, {small['peak_bytes'] / 1e6:.0f} MB")
    print(f"{'':28s} {'triangles':>10s} {'CPU s':>8s} {'Mtri/s/core':>12s} {'apart':>6s} {'peak MB':>8s} {'/raw':>6s} {'more/raw':>9s}  stages, wall s")
    for species, breaks, size in ROWS:
        mesh, report, cpu = prepare(folder, species, breaks, size)
        apart = cpu - reading_cpu(mesh, folder) - start
        stages = {s["name"]: s["seconds"] for s in report["stages"]}
        triangles = next(s["items"] for s in report["stages"] if s["name"] == "read")
        raw = geometry_bytes(mesh)
        peak = report["peak_bytes"]
        detail = ", ".join(f"{n} {t:.2f}" for n, t in stages.items())
        print(f"{' '.join([species, breaks]):28s} {triangles:10d} {cpu:8.2f} {triangles / cpu / 1e6:12.2f} {triangles / apart / 1e6:6.2f} {peak / 1e6:8.0f} {peak / raw:6.2f} "
              f"{(peak - small['peak_bytes']) / raw:9.2f}  {detail}", flush=True)


def omit_rows(folder):
    """What it saves to leave parts out: CPU seconds and bytes, three runs each in turn, the least counts."""
    mesh, out = folder / "tree.glb", folder / "tree.stree"
    subprocess.run(["treegrow", "oak", "-o", str(mesh), "--triangles", "1000000", "-q"], check=True)
    choices = [[], ["--omit", "leaf-groups"], ["--omit", "leaves"], ["--omit", "textures"], ["--only", "lines"]]
    least = [float("inf")] * len(choices)
    for _ in range(3):
        for i, choice in enumerate(choices):
            least[i] = min(least[i], cpu_seconds(["treeprep", str(mesh), "-o", str(out), "-j", "1", "-q", *choice]))
    print("\noak of 1 million triangles with parts left out")
    for choice, seconds in zip(choices, least):
        subprocess.run(["treeprep", str(mesh), "-o", str(out), "-q", *choice], check=True)
        print(f"{' '.join(choice) or 'everything':28s} {seconds:8.2f} CPU s, {seconds / least[0]:4.0%} of the time, {out.stat().st_size / 1e6:8.1f} MB")


def reading_cpu(mesh, folder):
    """CPU seconds of a run that reads the mesh and then has nothing to do, as no part of it is called so. Strict: triangles are not put in order."""
    return cpu_seconds(["treeprep", str(mesh), "-o", str(folder / "none.stree"), "-j", "1", "-q", "--strict", "--trunk", "no such name"], False)


def geometry_bytes(glb):
    """The bytes of vertices and indices in a GLB: its binary chunk without images."""
    data = glb.read_bytes()
    length = int.from_bytes(data[12:16], "little")
    document = json.loads(data[20:20 + length])
    images = {i["bufferView"] for i in document.get("images", []) if "bufferView" in i}
    return sum(v["byteLength"] for i, v in enumerate(document["bufferViews"]) if i not in images)


def version_rows():
    print(f"\n{'--version':12s} {'median ms of 21':>16s} {'CPU ms':>8s}")
    for tool in ["treeprep", "treedump", "treegrow", "treeplay"]:
        times = []
        for _ in range(21):
            start = time.perf_counter()
            subprocess.run([tool, "--version"], check=True, stdout=subprocess.DEVNULL)
            times.append(time.perf_counter() - start)
        cpu = sum(cpu_seconds([tool, "--version"]) for _ in range(21)) / 21
        print(f"{tool:12s} {statistics.median(times) * 1e3:16.1f} {cpu * 1e3:8.1f}")


def main():
    print(f"{os.cpu_count()} cores")
    version_rows()
    print()
    with tempfile.TemporaryDirectory() as name:
        speed_rows(pathlib.Path(name))
        omit_rows(pathlib.Path(name))


if __name__ == "__main__":
    main()
