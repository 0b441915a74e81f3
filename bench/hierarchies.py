#!/usr/bin/env python3
"""Digest 002's T6.1 again: what the hierarchies over a scene of 394 670 triangles cost to make and to ask (bvfit
--compare-hierarchies). The dissertation's model is not to be had: a grown oak with as many triangles stands for it, whose leaf groups
and segments are the parts, with the dissertation's five types of volume.

./run bench hierarchies
Prints Markdown. The times are wall time of one thread for building the tree and fitting all volumes of all its inner nodes.
"""
import pathlib
import re
import resource
import subprocess
import tempfile

TRIANGLES = 394_670
FIVE = "sphere,obb,capsule,cylinder,lozenge"


def cpu_seconds(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return text, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def rows(text):
    """The lines of the comparison: kind, nodes, depth, seconds, ray, plane, visited, pairs, found, the dissertation's time."""
    kinds = r"(kd\d+|rtree\d|clusters|original|flat)"
    return [re.match(rf"\s+{kinds}" + r"\s+(\S+)" * 8 + r"\s*(.*)", line).groups()
            for line in text.splitlines() if re.match(rf"\s+{kinds}\s+\d", line)]


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        mesh, tree = folder / "oak.glb", folder / "oak.stree"
        subprocess.run(["treegrow", "oak", "-o", str(mesh), "--triangles", str(TRIANGLES), "-q"], check=True)
        subprocess.run(["treeprep", str(mesh), "-o", str(tree), "-q"], check=True)
        common = ["bvfit", str(tree), "--per", "groups,segments", "--volumes", FIVE, "-j", "1"]
        text, cpu = cpu_seconds([*common, "--quality", "fast", "--compare-hierarchies"])
        title = next(line for line in text.splitlines() if line.startswith("hierarchies over"))
        print(title.split(";")[0] + f"; volumes by the quick methods; all of it {cpu:.0f} CPU s\n")
        print("| hierarchy | nodes | depth | build and fit, s | cost of a ray | of a plane | nodes visited a frustum | pairs tested a frustum "
              "| parts found | dissertation, Pentium III |")
        print("|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|")
        for row in rows(text):
            print("| " + " | ".join(row) + " |")
        print()
        for quality in ("fast", "balanced"):
            _, cpu = cpu_seconds([*common, "--quality", quality, "--hierarchy", "kd4", "-q", "-o", str(folder / "out.stree")])
            print(f"- all volumes of all parts and of kd4 over them, --quality {quality}: {cpu:.1f} CPU s", flush=True)


if __name__ == "__main__":
    main()
