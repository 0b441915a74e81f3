#!/usr/bin/env python3
"""CPU seconds of treeprep on trunks that no artist makes, twice as many each time: triangles thrown on one heap, as large as the heap and
a third of it, and three-sided tubes that all begin in one point. Growth by two is linear, by four quadratic.

./run bench heaps
"""
import math
import os
import pathlib
import random
import subprocess
import tempfile


def heap(count, size):
    draw = random.Random(1)
    for _ in range(count):
        centre = [draw.random() for _ in range(3)]
        yield [[c + size * (draw.random() - .5) for c in centre] for _ in range(3)], [(0, 1, 2)]


def tubes_of_one_point(count, size):
    for i in range(count):
        y, turn = 1 - (i + .5) / count, i * 2.399963
        r = math.sqrt(1 - y * y)
        along, side, up = (r * math.cos(turn), y, r * math.sin(turn)), (-math.sin(turn), 0, math.cos(turn)), (-y * math.cos(turn), r, -y * math.sin(turn))
        rings = [[[t * a + (.01 - .002 * t) * (math.cos(k * 2.0944) * s + math.sin(k * 2.0944) * u) for a, s, u in zip(along, side, up)] for k in range(3)]
                 for t in (0, size / 2, size)]
        faces = [f for j in (0, 3) for k in range(3) for f in ((j + k, j + 3 + k, j + (k + 1) % 3), (j + (k + 1) % 3, j + 3 + k, j + 3 + (k + 1) % 3))]
        yield sum(rings, []), faces


def write(path, pieces):
    with open(path, "w") as out:
        first = 1
        for vertices, faces in pieces:
            for v in vertices:
                print("v", *v, file=out)
            for f in faces:
                print("f", *(first + c for c in f), file=out)
            first += len(vertices)


def cpu_seconds(command):
    before = os.times()
    subprocess.run(command, check=True, stderr=subprocess.DEVNULL)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def main():
    with tempfile.TemporaryDirectory() as name:
        mesh, tree = pathlib.Path(name) / "heap.obj", pathlib.Path(name) / "heap.stree"
        for what, maker, size, counts in (("triangles as large as their heap", heap, 2, (4000, 8000, 16000)),
                                          ("triangles a third of it", heap, .3, (4000, 8000, 16000)),
                                          ("tubes that begin in one point", tubes_of_one_point, 3, (1000, 2000, 4000))):
            for count in counts:
                write(mesh, maker(count, size))
                print(f"{count:6d} {what:34s} {cpu_seconds(['treeprep', str(mesh), '-o', str(tree), '-q', '--trunk', '*']):6.2f} CPU s", flush=True)


if __name__ == "__main__":
    main()
