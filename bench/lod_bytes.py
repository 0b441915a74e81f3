#!/usr/bin/env python3
"""Bytes against error: the trees with hierarchy and continuous levels as `lodbake --encode small` writes them, from 8 to 16 bits a
position, by section, with the largest error of a vertex of full detail; beside them the mesh alone by gltfpack -cc with as many bits;
then, at 14 bits, what every stream of the sections takes, and the file with bvfit's smallest sphere round each leaf group.

./run bench lod_bytes               the two trees of the goal
python3 bench/lod_bytes.py NAME...  the trees at ../shared/trees whose names begin so (the tools must be in PATH)
"""
import gzip
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

from lod import TREES, find_gltfpack, run

BITS = [8, 10, 12, 14, 16]
DEFAULT_BITS = 14
SECTIONS = ["PACK", "LSTR", "LSLV"]


def section_bytes(path):
    dump = subprocess.run(["treedump", str(path), "--json"], capture_output=True, text=True, check=True).stdout
    return {s["name"]: s["bytes"] for s in json.loads(dump)["sections"]}


def show(mesh, folder):
    tree, small, report = folder / "tree.stree", folder / "small.stree", folder / "report.json"
    run("treeprep", mesh, "-o", tree, "-q")
    for bits in BITS:
        run("lodbake", tree, "-o", small, "--continuous", "--divide", "even", "--encode", "small", "--position-bits", bits,
            "--report", report, "-q")
        errors = {e["name"]: e["value"] for e in json.loads(report.read_text())["errors"]}
        largest = max(v for name, v in errors.items() if name.startswith("packing"))
        peer = "-"
        if shutil.which("gltfpack"):
            packed = folder / "packed.glb"
            command = ["gltfpack", "-i", mesh, "-o", packed, "-cc", "-vp", bits]
            subprocess.run([str(c) for c in command], check=True, stderr=subprocess.DEVNULL)  # it misses the textures
            peer = packed.stat().st_size
        sections = section_bytes(small)
        if bits == DEFAULT_BITS:
            streams = next((t["rows"] for t in json.loads(report.read_text())["tables"] if t["name"] == "streams"), [])
            run("bvfit", small, "-o", folder / "spheres.stree", "--volumes", "sphere", "--per", "groups", "-q")
            with_spheres = (folder / "spheres.stree").stat().st_size
        print(f"{mesh.name:28} {bits:4} {small.stat().st_size:9} " + " ".join(f"{sections.get(s, 0):7}" for s in SECTIONS) +
              f" {1000 * largest:9.2f} {peer:>9}", flush=True)
    print(f"\nat {DEFAULT_BITS} bits with a sphere a leaf group: {with_spheres} bytes; streams, values, bytes, bits a value:")
    for section, stream, values, size, each in streams:
        print(f"  {section:5} {stream:34} {values:>7} {size:>7} {each:>7}")
    print(flush=True)


def main():
    wanted = tuple(sys.argv[1:] or ["eztree_oak_medium", "quaternius_oak_1.obj"])
    find_gltfpack()
    print(f"{'tree':28} {'bits':>4} {'bytes':>9} " + " ".join(f"{s:>7}" for s in SECTIONS) + f" {'error mm':>9} {'gltfpack':>9}")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for source in sorted(TREES.iterdir()) if TREES.exists() else []:
            if not source.name.startswith(wanted) or not source.name.endswith((".obj", ".obj.gz")):
                continue
            mesh = folder / source.name.removesuffix(".gz")
            mesh.write_bytes(gzip.decompress(source.read_bytes()) if source.suffix == ".gz" else source.read_bytes())
            show(mesh, folder)


if __name__ == "__main__":
    main()
