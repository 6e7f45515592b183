"""Inputs of the plane: points with segments that do not cross, and polygons, easy and hard ones."""
import math
import random


def write_poly(path, points, segments, holes=()):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"{len(points)} 2 0 0\n")
        file.writelines(f"{i} {x!r} {y!r}\n" for i, (x, y) in enumerate(points))
        file.write(f"{len(segments)} 0\n")
        file.writelines(f"{i} {a} {b}\n" for i, (a, b) in enumerate(segments))
        file.write(f"{len(holes)}\n")
        file.writelines(f"{i} {x!r} {y!r}\n" for i, (x, y) in enumerate(holes))


def write_random(path, count, segments):
    """Random points of the unit square; in each of as many cells as there are segments, one from the leftmost to the rightmost."""
    rng = random.Random(1)
    points = [(rng.random(), rng.random()) for _ in range(count)]
    side = math.isqrt(segments)
    ends = {}
    for i, (x, y) in enumerate(points):
        cell = (int(x * side), int(y * side))
        low, high = ends.get(cell, (i, i))
        ends[cell] = (min(low, i, key=points.__getitem__), max(high, i, key=points.__getitem__))
    write_poly(path, points, [e for e in ends.values() if e[0] != e[1]])


def star(count, seed=1):
    """About a centre with random radii: half of its corners are reflex."""
    rng = random.Random(seed)
    radii = [0.4 + 0.6 * rng.random() for _ in range(count)]
    return [(r * math.cos(2 * math.pi * i / count), r * math.sin(2 * math.pi * i / count)) for i, r in enumerate(radii)]


def spiral(count):
    """A band that goes round twenty times."""
    half = count // 2
    def at(i, width):
        turn = 20 * 2 * math.pi * i / (half - 1)
        return tuple((1 + turn + width) * f(turn) for f in (math.cos, math.sin))
    return [at(i, 0) for i in range(half)] + [at(i, 1) for i in reversed(range(half))]


def comb(count):
    """Teeth ten high on a bar: every second corner is reflex."""
    teeth = [(float(i), 0.3 if i % 2 else 10.0) for i in range(count - 2)]
    return [(-3.0, -1.0), (float(count), -1.0), *reversed(teeth)]


def plate(side):
    """A square with side x side holes of eight corners."""
    holes = [[(i + 0.5 + 0.3 * math.cos(math.pi * k / 4), j + 0.5 - 0.3 * math.sin(math.pi * k / 4)) for k in range(8)]
             for i in range(side) for j in range(side)]
    return [[(0.0, 0.0), (float(side), 0.0), (float(side), float(side)), (0.0, float(side))], *holes]


def touching(rng):
    """Holes that touch the outline, or each other, in a corner."""
    outer = [(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)]
    p = (float(rng.randrange(2, 7)), float(rng.randrange(2, 4)))
    q = (p[0] + rng.choice((-1, 1)), float(rng.randrange(5, 7)))
    first = [(0.0, 0.0), (p[0] - 1, p[1]), p]  # from the outline's corner
    second = [p, (p[0], p[1] + 1), q]          # from a corner of the first
    return [outer, clockwise(first), clockwise(second)][:rng.choice((2, 3))]


def straight(rng):
    """Sides of many corners on one line, on a grid, with a hole of the same kind."""
    def rectangle(x, y, w, h):
        return ([(float(x + i), float(y)) for i in range(w)] + [(float(x + w), float(y + i)) for i in range(h)]
                + [(float(x + w - i), float(y + h)) for i in range(w)] + [(float(x), float(y + h - i)) for i in range(h)])
    w, h = rng.randrange(6, 12), rng.randrange(6, 12)
    x, y = rng.randrange(1, 3), rng.randrange(1, 3)
    return [rectangle(0, 0, w, h), rectangle(x, y, rng.randrange(1, w - x), rng.randrange(1, h - y))[::-1]]


def scaled(rng):
    """Stars from 1e-300 to 1e300."""
    exponent = rng.choice((-300, -200, -160, 150, 200, 300))
    return [[(x * 10.0**exponent, y * 10.0**exponent) for x, y in star(rng.randrange(5, 40), rng.random())]]


def clockwise(outline):
    turn = sum(a[0] * b[1] - a[1] * b[0] for a, b in zip(outline, outline[1:] + outline[:1]))
    return outline if turn < 0 else outline[::-1]
