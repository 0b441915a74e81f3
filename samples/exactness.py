"""How exactly a recovered hierarchy (treedump --hierarchy) matches a truth (treegrow --truth).

A ring is found when a recovered radius lies within 1e-4 of the tree's height of it and its diameter is within 0.1 %.
Its parent is right when the recovered parent is the true one, or the other ring of the segment that a branch grows from
(the truth's `attach`). Rings collapsed to a point (`tip`) are not asked for; coincident rings count as one: those that the truth calls
so (`same_as`), and those that are as thick, in one place and differ by less than a file's rounding (a twig that starts amid a
ring of its parent and is as thick), as nobody can tell which of two such radii is which.
"""
import math
from collections import namedtuple

Exactness = namedtuple("Exactness", "rings found extra parents_right worst_centre worst_diameter leaves true_leaves")

CENTRE_TOLERANCE = 1e-4
DIAMETER_TOLERANCE = 1e-3
SAME_PLACE = 1e-6  # of the height
SAME_DIAMETER = 1e-4


def _grid(points, cell):
    grid = {}
    for i, p in enumerate(points):
        grid.setdefault(tuple(math.floor(c / cell) for c in p), []).append(i)
    return grid


def _near(grid, cell, p):
    k = [math.floor(c / cell) for c in p]
    for dx in (-1, 0, 1):
        for dy in (-1, 0, 1):
            for dz in (-1, 0, 1):
                yield from grid.get((k[0] + dx, k[1] + dy, k[2] + dz), ())


def _twins(radii, height):
    """Rings that lie in one place, as sets: index -> the lowest index of its set."""
    lowest = list(range(len(radii)))

    def join(a, b):
        while lowest[a] != a:
            a = lowest[a]
        while lowest[b] != b:
            b = lowest[b]
        lowest[max(a, b)] = min(a, b)

    reach = height * SAME_PLACE
    grid = _grid([r["center"] for r in radii], reach)
    for i, r in enumerate(radii):
        if r.get("same_as") is not None:
            join(i, r["same_as"])
        for j in _near(grid, reach, r["center"]):
            other = radii[j]
            alike = abs(other["diameter"] - r["diameter"]) <= SAME_DIAMETER * r["diameter"]
            if j < i and alike and math.dist(other["center"], r["center"]) <= min(reach, SAME_DIAMETER * r["diameter"]):
                join(i, j)
    for i in range(len(lowest)):
        while lowest[i] != lowest[lowest[i]]:
            lowest[i] = lowest[lowest[i]]
    return lowest


def exactness(truth, found):
    radii, height = truth["radii"], max(truth["height"], 1e-300)
    canon = _twins(radii, height)
    cell = height * CENTRE_TOLERANCE
    grid = _grid([r["center"] for r in found["radii"]], cell)
    match, owner, errors = {}, {}, {}
    for i, ring in enumerate(radii):
        best = None
        for j in _near(grid, cell, ring["center"]):
            other = found["radii"][j]
            centre = math.dist(other["center"], ring["center"]) / height
            diameter = abs(other["diameter"] - ring["diameter"]) / max(ring["diameter"], 1e-300)
            if ring.get("tip"):
                diameter = 0
            taken = owner.get(j)
            if centre <= CENTRE_TOLERANCE and diameter <= DIAMETER_TOLERANCE and (taken is None or canon[taken] == canon[i]):
                best = min(best or (True, math.inf), (taken is not None, centre + diameter, j, centre, diameter))
        if best:
            match.setdefault(canon[i], set()).add(best[2])
            owner[best[2]] = i
            errors[i] = best[3:]
    wanted = sorted({canon[i] for i, r in enumerate(radii) if not r.get("tip")})
    hit = [i for i in wanted if i in match]

    attach = {b["first"]: b.get("attach") or [] for b in truth["branches"]}
    members = {}
    for i in range(len(radii)):
        members.setdefault(canon[i], []).append(i)

    def allowed(i):
        """The recovered radii that may be the parent of ring set i; -1 for a root."""
        out = set()
        for member in members[i]:
            for p in [radii[member]["parent"], *attach.get(member, [])]:
                if p == -1:
                    out.add(-1)
                elif canon[p] != i:
                    out |= match.get(canon[p], {None})
        return out or {-1}

    right = 0
    for i in hit:
        ok = allowed(i)
        right += all(found["radii"][j]["parent"] in ok | match[i] for j in match[i])
    asked = [errors[i] for i in errors if not radii[i].get("tip")]
    return Exactness(
        rings=len(wanted),
        found=len(hit),
        extra=len(found["radii"]) - len(owner),
        parents_right=right,
        worst_centre=max((e[0] for e in asked), default=0.0),
        worst_diameter=max((e[1] for e in asked), default=0.0),
        leaves=sum(g["leaves"] for g in found["leaf_groups"]),
        true_leaves=(truth.get("leaves") or {}).get("count", 0),
    )
