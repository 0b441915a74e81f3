#!/usr/bin/env python3
"""The whole of lodbake, reading and writing included, beside gltfpack on the same mesh: processor seconds, one thread, least of three runs that take turns.

./run bench lodbake               grown oaks and two species
python3 bench/lodbake.py 1000000  oaks of so many triangles (the tools must be in PATH)
"""
import json
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TREES = [("oak", 20_000), ("birch", 20_000), ("spruce", 20_000), ("oak", 200_000)]


def cpu_seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(c) for c in command], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def show(species, triangles, folder, peer):
    mesh, tree, report = folder / "tree.glb", folder / "tree.stree", folder / "report.json"
    subprocess.run(["treegrow", species, "--triangles", str(triangles), "-o", mesh, "-q"], check=True)
    subprocess.run(["treeprep", mesh, "-o", tree, "-q"], check=True)
    bake = ["lodbake", tree, "-o", folder / "lod.stree", "--continuous", "-j", "1", "-q"]
    commands = {"by pictures": [*bake, "--report", report], "even": [*bake, "--divide", "even"]}
    if peer:
        commands["gltfpack"] = [peer, "-i", mesh, "-o", folder / "packed.glb", "-si", "0.1", "-noq"]
    least = dict.fromkeys(commands, float("inf"))
    for _ in range(3):
        for name, command in commands.items():
            least[name] = min(least[name], cpu_seconds(command))
    stages = ", ".join(f"{s['name']} {s['seconds']:.2f}" for s in json.loads(report.read_text())["stages"])
    for name, seconds in least.items():
        print(f"{species:8s} {triangles:9d} {name:12s} {seconds:8.2f} s {triangles / seconds / 1e3:9.1f} thousand triangles a second")
    print(f"{'':18s} stages, wall s: {stages}", flush=True)


def main():
    npm = ROOT / "build" / "npm" / "node_modules" / ".bin"  # where bench/lod.py puts it
    peer = shutil.which("gltfpack", path=os.pathsep.join([os.environ["PATH"], str(npm)]))
    if not peer:
        print("gltfpack is not there (npm install gltfpack): its rows are left out")
    trees = [("oak", int(n)) for n in sys.argv[1:]] or TREES
    with tempfile.TemporaryDirectory() as folder:
        for species, triangles in trees:
            show(species, triangles, pathlib.Path(folder), peer)


if __name__ == "__main__":
    main()
