#!/usr/bin/env python3
"""The demo's page: a card a sample, with its pictures, how exact the recovered hierarchy is, and the time of each step.

demo_page.py OUT_FOLDER SAMPLES_FILE > index.html

The truth is treegrow's; exactness.py says what counts as found and as right.
"""
import html
import json
import os
import sys

from exactness import exactness


def load(path):
    with open(path, encoding="utf-8") as f:
        return json.load(f)


def seconds(value):
    return f"{value * 1e3:.0f} ms" if value < 1 else f"{value:.2f} s"


def card(out, name):
    prep, play = load(f"{out}/{name}.prep.json"), load(f"{out}/{name}.play.json")
    e = exactness(load(f"{out}/{name}.truth.json"), load(f"{out}/{name}.hierarchy.json"))
    stages = "".join(f"<tr><td>treeprep: {html.escape(s['name'])}</td><td>{seconds(s['seconds'])}</td></tr>" for s in prep["stages"])
    stages += f"<tr><td>treeplay</td><td>{seconds(play['seconds'])}</td></tr>"
    size = os.path.getsize(f"{out}/{name}.stree")
    return f"""<article>
<h2>{html.escape(name)}</h2>
<div class="pictures"><img src="{name}.png" alt="{html.escape(name)} as treeplay draws it" width="320" height="360">
<img src="{name}.skeleton.png" alt="its recovered hierarchy" width="320" height="360"></div>
<p>{e.found} of {e.rings} rings found, {e.parents_right} of {e.rings} parents right; worst centre {e.worst_centre:.1e} of the height,
worst diameter {e.worst_diameter:.1e}; {e.leaves} of {e.true_leaves} leaves. {size / 1e6:.2f} MB.</p>
<table>{stages}</table>
<p><a href="{name}.prep.html">treeprep's report</a> · <a href="{name}.volumes.html">volumes</a> · <a href="{name}.lod.html">levels of detail</a> · <a href="{name}.txt">treedump</a> · <a href="{name}.glb">mesh</a> · <a href="{name}.stree">tree</a></p>
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
<main>{cards}</main>
<h2>A forest of them</h2>
<p>ecogen: eight species on a valley from a page of JSON and six maps; on the left as treeplay draws the .eco, on the right from above.
<a href="forest/forest.html">ecogen's report</a> · <a href="forest/forest.txt">treedump</a> · <a href="forest/forest.json">the page</a> · <a href="forest/forest.eco">the ecosystem</a></p>
<div class="pictures"><img src="forest.png" alt="the forest as treeplay draws it" style="width:64%"><img src="forest/map.png" alt="the forest from above" style="width:36%"></div>
</body></html>""")


if __name__ == "__main__":
    main()
