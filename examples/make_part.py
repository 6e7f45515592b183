"""Makes a mechanical part as a binary STL, or as OFF where the name ends in .off: a flanged bearing housing, triangulated as a CAD system exports it.

    make_part.py part.stl [--detail D]

A square flange with counterbored bolt holes, a fillet at the foot of the body, a stepped bore with a bearing seat
and a snap ring groove, chamfers, blind threaded holes with drill points, and a grease hole from the side. The
triangles are those of an exporter: long and thin on the cylinders, fans between circles of different fineness on the
flat faces. --detail multiplies the number of segments of every circle.
"""
import argparse
from math import cos, pi, sin

from polygons import GRID, Surface


def grid(*xs):
    return tuple(round(x * GRID) for x in xs)


def circle(n, radius, z, at=(0.0, 0.0), phase=0.0):
    """A loop about the z axis, counterclockwise from above."""
    return [grid(at[0] + radius * cos(2 * pi * i / n + phase), at[1] + radius * sin(2 * pi * i / n + phase), z)
            for i in range(n)]


def rounded_square(half, radius, arc, z):
    """Loops: the whole outline, and where its four straight sides end."""
    outline = []
    for corner in range(4):
        centre = [(1, 1), (-1, 1), (-1, -1), (1, -1)][corner]
        for i in range(arc + 1):
            a = (corner + i / arc) * pi / 2
            outline.append(grid(centre[0] * (half - radius) + radius * cos(a),
                                centre[1] * (half - radius) + radius * sin(a), z))
    return outline


def housing(detail=1):
    part = Surface()
    body_n, seat_n, bore_n, bolt_n, thread_n, grease_n = (detail * n for n in (96, 120, 64, 32, 20, 24))
    flange, top = 12.0, 52.0

    # The flange's outline, and its four sides; the side at +x has the grease hole.
    arc = 8 * detail
    low, high = rounded_square(60, 15, arc, 0), rounded_square(60, 15, arc, flange)
    grease_z = 6.0

    def grease(x):
        return [grid(x, 3 * cos(2 * pi * i / grease_n), grease_z + 3 * sin(2 * pi * i / grease_n))
                for i in range(grease_n)]

    for i in range(len(low)):
        a, b, c, d = low[i - 1], low[i], high[i], high[i - 1]
        if i == 0:  # from the last point of the arc at (+,-) to the first of the one at (+,+): x = 60
            part.face(0, 1, [a, b, c, d], [grease(60)])
        else:
            part.triangles += [(a, b, c), (a, c, d)]
    part.strip(grease(60), grease(44))
    part.fan(grease(44), grid(42.2, 0, grease_z))

    # Bolt holes: 11 through, counterbore 18.
    bolts = [(x, y) for x in (-45, 45) for y in (-45, 45)]
    for at in bolts:
        through = [circle(bolt_n, 5.5, z, at) for z in (0, 6)]
        bore = [circle(bolt_n * 3 // 2, 9, z, at) for z in (6, flange)]
        part.strip(through[1], through[0])
        part.face(2, 1, bore[0], [through[1]])
        part.strip(bore[1], bore[0])

    # Outside of the body: fillet of radius 5 from the flange, cylinder, chamfer.
    fillet = 6 * detail
    rings = [circle(body_n, 45 - 5 * sin(i / fillet * pi / 2), flange + 5 - 5 * cos(i / fillet * pi / 2))
             for i in range(fillet + 1)]
    rings += [circle(body_n, 40, top - 2), circle(body_n, 38, top)]
    for lower, upper in zip(rings, rings[1:]):
        part.strip(lower, upper)

    # Inside, from the bottom up: seal recess, bore, bearing seat with groove, entry chamfer.
    seal = [circle(body_n, 23, z) for z in (0, 8)]
    bore = [circle(bore_n, 20, z) for z in (8, 30)]
    seat = [circle(seat_n, 26, z) for z in (30, 46)]
    groove = [circle(seat_n, 27.5, z) for z in (46, 48)]
    entry = [circle(seat_n, 26, 48), circle(seat_n, 26, top - 1), circle(seat_n, 27, top)]
    for lower, upper in ((seal[0], seal[1]), (bore[0], bore[1]), (seat[0], seat[1]), (groove[0], groove[1]),
                         (entry[0], entry[1]), (entry[1], entry[2])):
        part.strip(upper, lower)
    part.face(2, -1, seal[1], [bore[0]])
    part.face(2, 1, seat[0], [bore[1]])
    part.face(2, 1, groove[0], [seat[1]])
    part.face(2, -1, groove[1], [entry[0]])

    # Blind holes in the top, with drill points.
    screws = []
    for i in range(6):
        at = (32.5 * cos(pi * i / 3), 32.5 * sin(pi * i / 3))
        mouth, floor = (circle(thread_n, 2.1, z, at) for z in (top, top - 14))
        part.strip(mouth, floor)
        part.fan(floor, grid(*at, top - 15.2))
        screws.append(mouth)

    part.face(2, 1, rings[-1], [entry[2], *screws])
    part.face(2, 1, high, [rings[0], *(circle(bolt_n * 3 // 2, 9, flange, at) for at in bolts)])
    part.face(2, -1, low, [seal[0], *(circle(bolt_n, 5.5, 0, at) for at in bolts)])
    part.check()
    return part


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--detail", type=int, default=1)
    arguments = parser.parse_args()
    surface = housing(arguments.detail)
    (surface.write_off if arguments.file.endswith(".off") else surface.write_stl)(arguments.file)
    print(f"{arguments.file}: {len(surface.triangles)} triangles, {surface.volume6() / 6 / GRID**3 / 1000:.1f} cm3")
