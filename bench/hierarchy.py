#!/usr/bin/env python3
"""How exactly treeprep recovers hierarchies: on every species of treegrow as it is, on each with every named break, and on
the meshes with truth at ../shared/trees where they are there (those with the scorer that comes with them).

./run bench hierarchy; prints a row a mesh and ends with the number of rows that are not exact.

  hierarchy.py [--species NAME,...] [--breaks NAME,...] [--seeds N,...] [--triangles N] [--format obj|glb|ply]
               [--draws N] [--no-shared] [--quiet] [--check]

--seeds: specimens (0, treegrow's own); --triangles: of the whole mesh (what the species has by itself); --draws: instead of all that,
so many specimens of each seed with random species, k from 3 to 24, size from millimetres to kilometres, triangles, and up to three
breaks; --quiet: only the rows that are not exact; --check: status 1 when there are any.
"""
import argparse
import json
import pathlib
import random
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "samples"))
from exactness import exactness  # noqa: E402

SHARED = ROOT.parent / "shared"
TOO_FEW_TRIANGLES = 4  # treegrow's exit status: a limit that was asked for is not met
USAGE = 2  # breaks that exclude one another


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def recover(mesh, folder, *options):
    tree = folder / "tree.stree"
    run("treeprep", str(mesh), "-o", str(tree), "-q", *options)
    hierarchy = folder / "hierarchy.json"
    hierarchy.write_text(run("treedump", str(tree), "--hierarchy"))
    return hierarchy


def grown(species, kind, options, folder):
    mesh, truth = folder / f"tree.{kind}", folder / "truth.json"
    grow = subprocess.run(["treegrow", *([species] if species else []), "-o", str(mesh), "--truth", str(truth), "-q", *options], capture_output=True, text=True)
    if grow.returncode == TOO_FEW_TRIANGLES:
        return None
    grow.check_returncode()
    true, up = json.loads(truth.read_text()), []
    if any("z-up" in o for o in options):  # treeprep asks for --up z and stands the tree up; the truth is in the file's coordinates
        up = ["--up", "z"]
        for r in true["radii"]:
            x, y, z = r["center"]
            r["center"] = [x, z, -y]
    return exactness(true, json.loads(recover(mesh, folder, *up).read_text()))


def is_exact(e):
    return e.found == e.rings == e.parents_right and e.extra == 0 and e.leaves == e.true_leaves


def row(name, e, quiet):
    if e is None:
        print(f"{name:44s} not grown: its rings need more triangles", flush=True)
        return 0
    verdict = "exact" if is_exact(e) else "NOT EXACT"
    if quiet and is_exact(e):
        return 0
    print(f"{name:44s} {e.found:6d}/{e.rings:<6d} {e.parents_right:6d} {e.extra:5d} {e.worst_centre:9.1e} {e.worst_diameter:9.1e} "
          f"{e.leaves:6d}/{e.true_leaves:<6d} {verdict}", flush=True)
    return not is_exact(e)


def grown_rows(folder, options):
    print(f"{'treegrow':44s} {'rings':>13s} {'parent':>6s} {'extra':>5s} {'centre':>9s} {'diameter':>9s} {'leaves':>13s}")
    species = options.species or [line.split()[0] for line in run("treegrow", "--list").splitlines() if line.strip()]
    breaks = [line.split()[0] for line in run("treegrow", "--list-breaks").splitlines() if line.strip()] if options.breaks is None else options.breaks
    more = ["--triangles", str(options.triangles)] if options.triangles else []
    bad = 0
    for seed in options.seeds:
        for way in [[], ["--strict-model"], *(["--break", b] for b in breaks)]:
            for s in species:
                name = " ".join([s, *way, *(["--seed", seed] if seed != "0" else [])])
                try:
                    bad += row(name, grown(s, options.format, [*way, "--seed", seed, *more], folder), options.quiet)
                except subprocess.CalledProcessError as e:
                    print(f"{name:44s} {' '.join(e.cmd)}: status {e.returncode} {e.stderr}", flush=True)
                    bad += 1
    return bad


def draw(dice, species, breaks, folder):
    """The options of a random specimen, whose parameters are written to `folder`, and what to call it."""
    kind, k = dice.choice(species), dice.randint(3, 24)
    params = run("treegrow", "--print", kind)
    height = float(re.search(r"^height = (\S+)", params, re.M)[1]) * 10 ** dice.uniform(-2.5, 2.5)
    if kind != "grass":
        params = re.sub(r"^(ring_size|sides) = \d+", lambda m: f"{m[1]} = {k}", params, flags=re.M)
    (folder / "species.toml").write_text(params)
    some = ",".join(dice.sample(breaks, dice.randint(0, 3))) or "none"
    triangles = round(10 ** dice.uniform(3.4, 4.6))
    shape = ["--break", some, "--height", f"{height:.4g}", "--triangles", str(triangles), "--seed", str(dice.randrange(1000))]
    return ["--params", str(folder / "species.toml"), "--texture-size", "64", *shape], " ".join([kind, f"k {k}", *shape[1::2]])


def drawn_rows(folder, options):
    species = options.species or [line.split()[0] for line in run("treegrow", "--list").splitlines() if line.strip()]
    breaks = options.breaks or [line.split()[0] for line in run("treegrow", "--list-breaks").splitlines() if line.strip()]
    bad, scored = 0, 0
    for seed in options.seeds:
        dice = random.Random(int(seed))
        for _ in range(options.draws):
            how, name = draw(dice, species, breaks, folder)
            try:
                e = grown(None, options.format, how, folder)
            except subprocess.CalledProcessError as error:
                if error.cmd[0] == "treegrow" and error.returncode == USAGE:
                    continue  # breaks that exclude one another
                print(f"{name:44s} {' '.join(error.cmd)}: status {error.returncode} {error.stderr}", flush=True)
                bad += 1
                continue
            scored += e is not None
            if e is not None:
                bad += row(name, e, options.quiet)
    print(f"{scored} grown and scored; the others ask for breaks that exclude one another, or for too few triangles")
    return bad


def shared_rows(folder):
    scorer, trees = SHARED / "tools/evaluate_hierarchy.py", SHARED / "trees"
    if not scorer.exists():
        print("../shared is not there: its meshes with truth are not scored")
        return 0
    keys = ["ring_recall", "ring_precision", "ring_recall_strict", "parent_link_exact", "attach_accuracy_of_all", "attach_tight_of_seen",
            "centre_err_over_height_p95", "diameter_rel_err_p95", "leaf_conservation_error", "leaf_coverage"]
    short = ["recall", "precis.", "strict", "parents", "attach", "tight", "centre", "diameter", "leaves", "covered"]
    print(f"\n{'../shared/trees':28s} " + " ".join(f"{k:>8s}" for k in short))
    bad = 0
    for truth in sorted((trees / "truth").glob("*.json.gz")):
        name = truth.name.removesuffix(".json.gz")
        mesh = next((trees / (name + end) for end in (".obj", ".obj.gz") if (trees / (name + end)).exists()), None)
        if mesh is None or name.endswith(".rings"):
            continue
        result = folder / "score.json"
        run("/usr/bin/python3", str(scorer), str(truth), str(recover(mesh, folder)), "--json", str(result))
        score = json.loads(result.read_text())
        print(f"{name:28s} " + " ".join(f"{score.get(k, float('nan')):8.4f}" if score.get(k) is not None else f"{'-':>8s}" for k in keys), flush=True)
        bad += any(score[k] < 1 for k in keys[:6]) or score[keys[6]] > 1e-4 or score[keys[7]] > 1e-3
    return bad


def names(text):
    return [n for n in text.split(",") if n]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--species", type=names, default=[])
    parser.add_argument("--breaks", type=lambda text: [b.replace("+", ",") for b in names(text)], help="A+B: both")
    parser.add_argument("--seeds", type=names, default=["0"])
    parser.add_argument("--triangles", type=int)
    parser.add_argument("--format", choices=["obj", "glb", "ply"], default="obj")
    parser.add_argument("--draws", type=int)
    parser.add_argument("--no-shared", action="store_true")
    parser.add_argument("--quiet", action="store_true")
    parser.add_argument("--check", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        bad = 0 if options.no_shared else shared_rows(folder)
        bad += drawn_rows(folder, options) if options.draws else grown_rows(folder, options)
    print(f"\n{bad} not exact")
    sys.exit(options.check and bad > 0)


if __name__ == "__main__":
    main()
