#!/usr/bin/env python3
"""How well treeprep recovers the trees of Blender's own generator (add-on "Sapling Tree Gen", after Weber and Penn): each of its presets,
its curves turned into a mesh, with their points, radii and parents as the truth.

./run bench sapling; needs Blender (apt-get install blender), and says so where there is none.
python3 bench/sapling.py PRESET...: some presets alone, with the tools of PATH.
rings: of the truth; found: those with a radius within a ten-thousandth of the height and a thousandth of their diameter (rings in one place
may share it); roots: of the recovered trees (one is right); branches: of the truth; attached: those that hang on their true parent (or, where that begins in
the very same place, on its parent); leaves: as
recovered, of the truth; CPU: of treeprep.
"""
import ast
import collections
import json
import math
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile

# --- inside Blender


def grow(settings):
    """The curve of a tree, its leaves, and for each of its splines the one that it grows from (-1: none)."""
    import bpy
    utils = sys.modules["add_curve_sapling.utils"]
    origins, original = [], utils.perform_pruning

    def recording(*arguments):  # it is told which spline and point each new one begins at
        result = original(*arguments)
        origins[:] = result[1]
        return result

    utils.perform_pruning = recording
    known = bpy.ops.curve.tree_add.get_rna_type().properties
    settings = {**settings, "showLeaves": True, "useArm": False, "makeMesh": False, "do_update": True}
    arguments = {}
    for key, value in settings.items():
        if key not in known.keys():
            continue
        size = getattr(known[key], "array_length", 0)
        arguments[key] = [value] * size if size and isinstance(value, (int, float)) else value
    bpy.ops.curve.tree_add(**arguments)
    utils.perform_pruning = original
    names = [o if isinstance(o, str) else o[0] for o in origins]  # "bone0003.005": the point of a spline
    parents = [int(n[4:-4]) if n else -1 for n in names]
    return bpy.data.objects["tree"], bpy.data.objects.get("leaves"), parents


def mesh_of(thing):
    import bpy
    mesh = thing.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    points = [thing.matrix_world @ v.co for v in mesh.vertices]
    return [(p.x, p.z, -p.y) for p in points], [list(f.vertices) for f in mesh.polygons]


def write(path, parts):
    """OBJ, Y up."""
    with open(path, "w") as f:
        before = 1
        for name, points, faces in parts:
            f.write(f"o {name}\n")
            f.writelines(f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in points)
            f.writelines("f " + " ".join(str(before + v) for v in face) + "\n" for face in faces)
            before += len(points)


def piece_count(points, faces):
    of = list(range(len(points)))

    def find(v):
        while of[v] != v:
            of[v] = of[of[v]]
            v = of[v]
        return v

    for face in faces:
        for v in face[1:]:
            of[find(v)] = find(face[0])
    return len({find(v) for face in faces for v in face})


def make(mesh_path, truth_path, preset):
    import bpy
    import add_curve_sapling
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_enable(module="add_curve_sapling")
    text = (pathlib.Path(add_curve_sapling.__file__).parent / "presets" / f"{preset}.py").read_text()
    tree, leaves, parents = grow(ast.literal_eval(text[text.index("{"):]))
    points, faces = mesh_of(tree)
    parts, leaf_count = [("tree", points, faces)], 0
    if leaves:
        parts.append(("leaves", *mesh_of(leaves)))
        leaf_count = piece_count(*parts[1][1:])
    write(mesh_path, parts)
    sides, at, branches = 4 + 2 * tree.data.bevel_resolution, 0, []
    for i, spline in enumerate(tree.data.splines):  # Blender lays the rings of one after those of the other
        bends = spline.bezier_points
        straight = [a.handle_right_type == "VECTOR" and b.handle_left_type == "VECTOR" for a, b in zip(bends[:-1], bends[1:])]
        rings = []
        for _ in range(1 + sum(1 if s else spline.resolution_u for s in straight)):
            ring = points[at:at + sides]
            centre = [sum(p[k] for p in ring) / sides for k in range(3)]
            rings.append((centre, 2 * sum(math.dist(p, centre) for p in ring) / sides))
            at += sides
        branches.append({"parent": parents[i] if i < len(parents) else -1, "rings": rings})
    assert at == len(points), (at, len(points))
    json.dump({"branches": branches, "leaves": leaf_count, "height": max(p[1] for p in points) - min(p[1] for p in points)}, open(truth_path, "w"))


# --- outside


def cell(point, size):
    return tuple(math.floor(c / size) for c in point)


class Matches:
    """Which recovered radius each true ring is: the nearest that is as thick. Rings in one place may be one radius."""

    def __init__(self, branches, radii, height):
        self.reach = 1e-4 * height
        self.grid = collections.defaultdict(list)
        for j, r in enumerate(radii):
            self.grid[cell(r["center"], self.reach)].append(j)
        self.radius_of, self.branches_at = {}, collections.defaultdict(set)
        for b, branch in enumerate(branches):
            for i, (centre, diameter) in enumerate(branch["rings"]):
                near = sorted(self.near(radii, centre))
                for _, j in near:
                    self.branches_at[j].add(b)
                alike = [j for _, j in near if abs(radii[j]["diameter"] - diameter) <= 1e-3 * diameter]
                if alike:
                    self.radius_of[b, i] = alike[0]

    def near(self, radii, point):
        x, y, z = cell(point, self.reach)
        for dx in (-1, 0, 1):
            for dy in (-1, 0, 1):
                for dz in (-1, 0, 1):
                    for j in self.grid.get((x + dx, y + dy, z + dz), ()):
                        off = math.dist(point, radii[j]["center"])
                        if off <= self.reach:
                            yield off, j


def attached(truth, radii, matches):
    """How many branches hang on their parent: going down from their tip, the first radius that is not theirs alone is their parent's."""
    branches, right, counted = truth["branches"], 0, 0
    for b, branch in enumerate(branches):
        if branch["parent"] < 0:
            continue
        counted += 1
        true = parents(branches, b, matches.reach)
        at = next((matches.radius_of[b, i] for i in reversed(range(len(branch["rings"]))) if (b, i) in matches.radius_of), -1)
        while at >= 0 and b in matches.branches_at[at] and true.isdisjoint(matches.branches_at[at]):
            at = radii[at]["parent"]
        right += at >= 0 and not true.isdisjoint(matches.branches_at[at])
    return right, counted


def parents(branches, b, reach):
    """The true one; and where a branch begins in the very place where that one does, what that hangs on: nobody can tell."""
    base, of, possible = branches[b]["rings"][0][0], branches[b]["parent"], set()
    while of >= 0:
        possible.add(of)
        if math.dist(branches[of]["rings"][0][0], base) > reach:
            break
        of = branches[of]["parent"]
    return possible


def row(preset, folder):
    mesh, truth_path, tree = folder / "tree.obj", folder / "truth.json", folder / "tree.stree"
    subprocess.run(["blender", "-b", "--factory-startup", "--addons", "add_curve_sapling", "--python-exit-code", "1", "--python", __file__, "--",
                    str(mesh), str(truth_path), preset], check=True, capture_output=True)
    truth = json.loads(truth_path.read_text())
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(["treeprep", str(mesh), "-o", str(tree), "-q"], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    found = json.loads(subprocess.run(["treedump", str(tree), "--hierarchy"], check=True, capture_output=True, text=True).stdout)
    radii = found["radii"]
    matches = Matches(truth["branches"], radii, truth["height"])
    right, branches = attached(truth, radii, matches)
    leaves = sum(g["leaves"] for g in found["leaf_groups"])
    print(f"{preset:16s} {sum(len(b['rings']) for b in truth['branches']):6d} {len(matches.radius_of):6d} {sum(r['parent'] < 0 for r in radii):5d} "
          f"{branches:8d} {right:8d} {leaves:6d}/{truth['leaves']:<6d} {after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime:6.2f}", flush=True)


def presets():
    code = "import add_curve_sapling, pathlib; print('PRESETS', *sorted(p.stem for p in (pathlib.Path(add_curve_sapling.__file__).parent / 'presets').glob('*.py')))"
    text = subprocess.run(["blender", "-b", "--factory-startup", "--addons", "add_curve_sapling", "--python-expr", code], check=True, capture_output=True, text=True).stdout
    return next((line.split()[1:] for line in text.splitlines() if line.startswith("PRESETS")), [])


def main():
    if not shutil.which("blender"):
        print("there is no Blender to grow trees with: apt-get install blender")
        return
    print(f"{'preset':16s} {'rings':>6s} {'found':>6s} {'roots':>5s} {'branches':>8s} {'attached':>8s} {'leaves':>13s} {'CPU, s':>6s}")
    with tempfile.TemporaryDirectory() as name:
        for preset in sys.argv[1:] or presets():
            row(preset, pathlib.Path(name))


if __name__ == "__main__":
    if "--" in sys.argv:
        make(*sys.argv[sys.argv.index("--") + 1:])
    else:
        main()
