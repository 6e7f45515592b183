"""Sets of points, and files of them as TetGen writes them."""
import random


def write_node(path, count, points):
    with open(path, "w", encoding="ascii") as file:
        file.write(f"{count} 3 0 0\n")
        file.writelines(f"{i} {x!r} {y!r} {z!r}\n" for i, (x, y, z) in enumerate(points))


def write_random(path, count):
    """Uniform in a cube; one at a time, since ten million of them would take gigabytes here."""
    draw = random.Random(1).random
    write_node(path, count, ((draw(), draw(), draw()) for _ in range(count)))


def write_list(path, make, *arguments):
    points = make(*arguments)
    write_node(path, len(points), points)


def count_of(path):
    with open(path, encoding="ascii") as file:
        return int(file.readline().split()[0])


def vertices_of(path):
    """Distinct vertices of an OFF file."""
    words = path.read_text(encoding="ascii", errors="replace").split("\n", 2)
    count = int(words[1].split()[0])
    rows = words[2].split("\n", count)[:count]
    return list(dict.fromkeys(tuple(float(x) for x in row.split()[:3]) for row in rows))
