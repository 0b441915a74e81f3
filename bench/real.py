#!/usr/bin/env python3
"""What treeprep makes of the real meshes at ../shared/trees: shares explained, leaves, groups, roots, time, verified.

./run bench real
"""
import json
import pathlib
import subprocess
import sys
import tempfile

TREES = pathlib.Path(__file__).resolve().parent.parent.parent / "shared" / "trees"


def counts(report, name):
    return {row[0]: row[1] for t in report["tables"] if t["name"] == name for row in t["rows"]}


def row(mesh, folder):
    tree, page = folder / "tree.stree", folder / "report.json"
    subprocess.run(["treeprep", str(mesh), "-o", str(tree), "-q", "--report", str(page)], check=True)
    verified = subprocess.run(["treedump", str(tree), "--verify"], capture_output=True).returncode == 0
    report = json.loads(page.read_text())
    found = counts(report, "what was found")
    error = {e["name"]: e for e in report["errors"]}
    unexplained = error["trunk triangles unexplained"]["value"]
    seconds = sum(s["seconds"] for s in report["stages"] if s["name"] not in ("read", "measure"))
    print(f"{mesh.name:36s} {found['trunk triangles']:>7s} {1 - unexplained:9.4f} {error['cylinder-surface of local radius']['value']:8.4f} "
          f"{found['radii']:>6s} {found['roots']:>5s} {found['leaves']:>6s} {found['leaf groups']:>6s} {seconds * 1e3:8.1f} "
          f"{'yes' if verified else 'NO'}", flush=True)
    return unexplained > 0.05 or not verified


def main():
    if not TREES.exists():
        sys.exit("../shared/trees is not there: nothing to measure")
    print(f"{'mesh':36s} {'trunk':>7s} {'explained':>9s} {'of radius':>8s} {'radii':>6s} {'roots':>5s} {'leaves':>6s} {'groups':>6s} {'ms':>8s} verified")
    with tempfile.TemporaryDirectory() as name:
        meshes = sorted(p for p in TREES.iterdir() if p.name.endswith((".obj", ".obj.gz", ".glb")))
        bad = sum(row(mesh, pathlib.Path(name)) for mesh in meshes)
    print(f"\n{bad} below 95 % explained or not verified")


if __name__ == "__main__":
    main()
