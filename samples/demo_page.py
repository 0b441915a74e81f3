#!/usr/bin/env python3
"""The demo's page: a card a sample, with its pictures, how exact the recovered hierarchy is, and the time of each step.

demo_page.py OUT_FOLDER SAMPLES_FILE > index.html

The truth is treegrow's; a ring is found when a recovered radius lies within 1e-4 of the height of it and its diameter
is within 0.1 %; its parent is right when the recovered parent is the true one (or the other ring of the segment that the
branch grows from).
"""
import html
import json
import math
import os
import sys


def load(path):
    with open(path, encoding="utf-8") as f:
        return json.load(f)


def exactness(truth, found):
    """(rings, rings found, parents right, worst centre error / height, worst diameter error)"""
    height = truth["height"]
    cell = max(height * 1e-4, 1e-30)
    grid = {}
    for i, radius in enumerate(found["radii"]):
        grid.setdefault(tuple(math.floor(c / cell) for c in radius["center"]), []).append(i)

    def matches(ring):
        key = [math.floor(c / cell) for c in ring["center"]]
        near = []
        for dx in (-1, 0, 1):
            for dy in (-1, 0, 1):
                for dz in (-1, 0, 1):
                    near += grid.get((key[0] + dx, key[1] + dy, key[2] + dz), [])
        for i in near:
            radius = found["radii"][i]
            centre = math.dist(radius["center"], ring["center"]) / height
            diameter = abs(radius["diameter"] - ring["diameter"]) / max(ring["diameter"], 1e-30)
            if centre <= 1e-4 and diameter <= 1e-3:
                yield i, centre, diameter

    rings = [i for i, r in enumerate(truth["radii"]) if not r.get("tip") and r.get("same_as") is None]
    match, worst_centre, worst_diameter = {}, 0.0, 0.0
    for i in range(len(truth["radii"])):
        best = min(matches(truth["radii"][i]), key=lambda m: m[1] + m[2], default=None)
        if best:
            match[i] = best[0]
            if i in rings:
                worst_centre, worst_diameter = max(worst_centre, best[1]), max(worst_diameter, best[2])
    alternatives = {b["first"]: b.get("attach") or [] for b in truth["branches"]}

    def parents(i):
        allowed, todo = set(), [i]
        while todo:
            j = todo.pop()
            for p in [truth["radii"][j]["parent"], *alternatives.get(j, [])]:
                if p == -1:
                    allowed.add(-1)
                elif truth["radii"][j].get("same_as") == p or truth["radii"][p].get("same_as") == j:
                    todo.append(p)
                else:
                    allowed.add(match.get(p, None))
                    twin = truth["radii"][p].get("same_as")
                    if twin is not None:
                        allowed.add(match.get(twin, None))
        return allowed

    right = sum(1 for i in rings if i in match and found["radii"][match[i]]["parent"] in parents(i))
    return len(rings), sum(i in match for i in rings), right, worst_centre, worst_diameter


def seconds(value):
    return f"{value * 1e3:.0f} ms" if value < 1 else f"{value:.2f} s"


def card(out, name):
    prep, play = load(f"{out}/{name}.prep.json"), load(f"{out}/{name}.play.json")
    rings, found, right, centre, diameter = exactness(load(f"{out}/{name}.truth.json"), load(f"{out}/{name}.hierarchy.json"))
    stages = "".join(f"<tr><td>treeprep: {html.escape(s['name'])}</td><td>{seconds(s['seconds'])}</td></tr>" for s in prep["stages"])
    stages += f"<tr><td>treeplay</td><td>{seconds(play['seconds'])}</td></tr>"
    size = os.path.getsize(f"{out}/{name}.stree")
    return f"""<article>
<h2>{html.escape(name)}</h2>
<div class="pictures"><img src="{name}.png" alt="{html.escape(name)} as treeplay draws it" width="320" height="360">
<img src="{name}.skeleton.png" alt="its recovered hierarchy" width="320" height="360"></div>
<p>{found} of {rings} rings found, {right} of {rings} parents right; worst centre {centre:.1e} of the height, worst diameter {diameter:.1e}.
{size / 1e6:.2f} MB.</p>
<table>{stages}</table>
<p><a href="{name}.prep.html">treeprep's report</a> · <a href="{name}.txt">treedump</a> · <a href="{name}.glb">mesh</a> · <a href="{name}.stree">tree</a></p>
</article>"""


def main():
    out, samples = sys.argv[1:]
    with open(samples, encoding="utf-8") as f:
        names = [line.split()[0] for line in f if line.strip() and not line.startswith("#")]
    cards = "\n".join(card(out, name) for name in names)
    print(f"""<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>copse: the samples</title>
<style>
:root {{ color-scheme: light dark; --line: #8884; }}
body {{ font: 16px/1.5 system-ui, sans-serif; max-width: 1500px; margin: 2rem auto; padding: 0 1rem; }}
main {{ display: grid; grid-template-columns: repeat(auto-fill, minmax(340px, 1fr)); gap: 1.5rem; }}
article {{ border: 1px solid var(--line); border-radius: 10px; padding: 1rem; }}
h1, h2 {{ line-height: 1.2; margin: 0 0 .6rem; }}
.pictures {{ display: flex; gap: .5rem; }} .pictures img {{ width: 50%; height: auto; border-radius: 6px; background: #8882; }}
table {{ width: 100%; border-collapse: collapse; font-variant-numeric: tabular-nums; font-size: .9rem; }}
td {{ border-top: 1px solid var(--line); padding: .15rem 0; }} td + td {{ text-align: right; }}
</style></head><body>
<h1>copse: from a mesh to a tree that a program can load, move and draw</h1>
<p>Each sample was grown as an artist would export it, prepared, checked, and drawn: on the left from the .stree file, on the right the
hierarchy that treeprep recovered from the bare mesh.</p>
<main>{cards}</main></body></html>""")


if __name__ == "__main__":
    main()
