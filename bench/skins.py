#!/usr/bin/env python3
"""How well treeprep recovers the lines that Blender's skin modifier was put on: random trees of lines, skinned, with and without its
smoothing of hulls, subdivided once or twice, as a step leaves them or on the limit surface.

./run bench skins; needs Blender (apt-get install blender), and says so where there is none.
found: corners of the lines with a radius within a thousandth of the height; exactly: within a ten-thousandth; parents: of those found,
whose parent is the true one; extra: radii that are no corner of the lines.
"""
import json
import math
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

ROWS = [(seed, smoothing, levels, limit) for seed, smoothing, levels, limit in
        [(1, 0, 1, 1), (2, 0, 1, 1), (3, 0, 1, 1), (11, 0.2, 1, 1), (12, 0.2, 1, 1), (13, 0.2, 1, 1), (21, 0, 1, 0), (22, 0.2, 1, 0), (23, 0, 2, 0), (24, 0, 2, 1),
         (31, 0.5, 1, 1), (32, 1, 1, 1), (33, 0.2, 2, 1), (34, 0.5, 1, 0), (35, 0, 1, 1), (36, 0.2, 1, 1), (37, 0.3, 1, 1)]]


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return [x / length for x in v]


class Lines:
    """A tree of lines, Z up: a point, a radius and a parent a corner."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.points, self.radii, self.parents = [], [], []
        trunk = self.limb(-1, [0, 0, 0], [0, 0, 1], 1.0, 30, 14)
        self.branch(trunk, 9, 12, 1)

    def limb(self, parent, point, way, radius, length, corners):
        ids = []
        for i in range(0 if parent < 0 else 1, corners + 1):
            if i > 0:
                way = unit([c + self.random.uniform(-0.22, 0.22) + (0.05 if k == 2 else 0) for k, c in enumerate(way)])
                step = length / corners * self.random.uniform(0.7, 1.3)
                point = [p + w * step for p, w in zip(point, way)]
            self.points.append(point)
            self.radii.append(radius * (1 - 0.75 * i / corners))
            self.parents.append(ids[-1] if ids else parent)
            ids.append(len(self.points) - 1)
        return ids

    def branch(self, limb, count, length, level):
        for _ in range(count):
            at = limb[self.random.randrange(max(1, len(limb) // 4), len(limb) - 1)]
            turn = self.random.uniform(0, 2 * math.pi)
            way = unit([math.cos(turn), math.sin(turn), self.random.uniform(0.2, 1)])
            radius, corners = self.radii[at] * self.random.uniform(0.35, 0.7), self.random.randrange(4, 9)
            below = self.limb(at, self.points[at], way, radius, length * self.random.uniform(0.6, 1.2), corners)
            if level < 2:
                self.branch(below, 2, length / 2, level + 1)


def skin(out, seed, smoothing, levels, limit):
    """Inside Blender: writes the skinned lines as OBJ, Y up."""
    import bpy
    lines = Lines(int(seed))
    mesh = bpy.data.meshes.new("lines")
    mesh.from_pydata(lines.points, [(p, i) for i, p in enumerate(lines.parents) if p >= 0], [])
    tree = bpy.data.objects.new("tree", mesh)
    bpy.context.scene.collection.objects.link(tree)
    tree.modifiers.new("skin", "SKIN").branch_smoothing = float(smoothing)
    for i, corner in enumerate(mesh.skin_vertices[0].data):
        corner.radius, corner.use_root = (lines.radii[i], lines.radii[i]), i == 0
    smooth = tree.modifiers.new("smooth", "SUBSURF")
    smooth.levels, smooth.use_limit_surface = int(levels), limit == "1"
    done = tree.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    with open(out, "w") as f:
        for v in done.vertices:
            f.write(f"v {v.co.x:.6f} {v.co.z:.6f} {-v.co.y:.6f}\n")
        for p in done.polygons:
            f.write("f " + " ".join(str(i + 1) for i in p.vertices) + "\n")


def score(lines, recovered):
    height = max(p[2] for p in lines.points)
    true = [(x, z, -y) for x, y, z in lines.points]
    pairs = sorted((math.dist(t, r["center"]), i, j) for i, t in enumerate(true) for j, r in enumerate(recovered)
                   if math.dist(t, r["center"]) <= 1e-3 * height)
    corner_of, radius_of, exactly = {}, {}, 0
    for off, i, j in pairs:
        if i not in radius_of and j not in corner_of:
            radius_of[i], corner_of[j] = j, i
            exactly += off <= 1e-4 * height
    parents = sum(corner_of.get(recovered[j]["parent"], -1) == lines.parents[i] for i, j in radius_of.items())
    return len(true), len(radius_of), exactly, parents, len(recovered) - len(corner_of)


def main():
    if not shutil.which("blender"):
        print("there is no Blender to make skins with: apt-get install blender")
        return
    print(f"{'seed':>4s} {'smoothing':>9s} {'levels':>6s} {'limit':>5s} {'corners':>7s} {'found':>6s} {'exactly':>7s} {'parents':>7s} {'extra':>5s}")
    with tempfile.TemporaryDirectory() as name:
        mesh, tree = pathlib.Path(name) / "skin.obj", pathlib.Path(name) / "skin.stree"
        for row in ROWS:
            subprocess.run(["blender", "-b", "--factory-startup", "--python-exit-code", "1", "--python", __file__, "--", str(mesh),
                            *map(str, row)], check=True, capture_output=True)
            subprocess.run(["treeprep", str(mesh), "-o", str(tree), "-q"], check=True)
            dump = subprocess.run(["treedump", str(tree), "--hierarchy"], check=True, capture_output=True, text=True).stdout
            corners, found, exactly, parents, extra = score(Lines(row[0]), json.loads(dump)["radii"])
            print(f"{row[0]:4d} {row[1]:9.1f} {row[2]:6d} {row[3]:5d} {corners:7d} {found:6d} {exactly:7d} {parents:7d} {extra:5d}", flush=True)


if __name__ == "__main__":
    if "--" in sys.argv:
        skin(*sys.argv[sys.argv.index("--") + 1:])
    else:
        main()
