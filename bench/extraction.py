#!/usr/bin/env python3
"""Time to extract the index lists of a level, both parts, one thread, the least of 400, in microseconds; beside it the time to copy as
many bytes (memcpy), which is the floor. treegrow's oak of 262 000 triangles, with leaves as cards and as single triangles.

./run bench extraction       (the tools and probe_extraction must be in PATH)
"""
import pathlib
import subprocess
import tempfile

TRIANGLES = "262000"


def run(*command):
    subprocess.run([str(c) for c in command], check=True)


def main():
    print(f"{'leaves':34} {'share':>5} {'triangles':>9} {'us':>8} {'memcpy':>8}", flush=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for leaves, options in (("cards", []), ("single triangles", ["--no-textures"])):
            mesh, tree, baked = folder / "oak.glb", folder / "oak.stree", folder / "oak.lod.stree"
            run("treegrow", "oak", "--triangles", TRIANGLES, "-o", mesh, "-q", *options)
            run("treeprep", mesh, "-o", tree, "-q")
            run("lodbake", tree, "-o", baked, "--continuous", "--divide", "even", "--quality", "fast", "-q")
            run("probe_extraction", leaves, baked)


if __name__ == "__main__":
    main()
