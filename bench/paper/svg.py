"""Drawings of triangles in the plane as SVG, side by side."""

INK, PALE, FILL, WARM, POINT, MISSING = "#222222", "#9a9a9a", "#dbe7f3", "#f2c879", "#c0392b", "#c0392b"
WIDTH, GAP, FOOT = 300, 20, 34


class Panel:
    """Shapes in coordinates of their own, and a line of text below."""

    def __init__(self, words, stretch=1.0):
        self.words, self.stretch, self.shapes = words, stretch, []

    def triangles(self, points, triangles, fill=FILL, stroke=INK):
        self.shapes += [("polygon", [points[v] for v in t], fill, stroke) for t in triangles]
        return self

    def lines(self, pairs, colour=MISSING, dashed=True, width=1.4):
        self.shapes += [("line", list(pair), colour, dashed, width) for pair in pairs]
        return self

    def dots(self, points, colour=POINT, radius=2.2):
        self.shapes += [("dot", [p], colour, radius) for p in points]
        return self

    def text(self, point, words):
        self.shapes.append(("text", [point], words))
        return self

    def svg(self, left, height):
        if not self.shapes:
            return []
        points = [p for shape in self.shapes for p in shape[1]]
        x0, x1 = min(p[0] for p in points), max(p[0] for p in points)
        y0, y1 = min(p[1] for p in points), max(p[1] for p in points)
        scale = min((WIDTH - 12) / (x1 - x0 or 1), (height - 12) / ((y1 - y0 or 1) * self.stretch))

        def at(p):
            return (left + WIDTH / 2 + scale * (p[0] - (x0 + x1) / 2), height / 2 - scale * self.stretch * (p[1] - (y0 + y1) / 2))

        parts = []
        for kind, where, *how in self.shapes:
            flat = [at(p) for p in where]
            if kind == "polygon":
                fill, stroke = how
                parts.append('<polygon points="' + " ".join(f"{x:.1f},{y:.1f}" for x, y in flat)
                             + f'" fill="{fill}" stroke="{stroke}" stroke-width="0.6" stroke-linejoin="round"/>')
            elif kind == "line":
                colour, dashed, width = how
                (xa, ya), (xb, yb) = flat
                parts.append(f'<line x1="{xa:.1f}" y1="{ya:.1f}" x2="{xb:.1f}" y2="{yb:.1f}" stroke="{colour}" stroke-width="{width}"'
                             + (' stroke-dasharray="5 3"/>' if dashed else "/>"))
            elif kind == "dot":
                colour, radius = how
                parts.append(f'<circle cx="{flat[0][0]:.1f}" cy="{flat[0][1]:.1f}" r="{radius}" fill="{colour}"/>')
            else:
                parts.append(f'<text x="{flat[0][0] + 4:.1f}" y="{flat[0][1] - 4:.1f}" font-size="12">{how[0]}</text>')
        return parts


def write(path, panels, height=210):
    parts = []
    for k, panel in enumerate(panels):
        left = k * (WIDTH + GAP)
        parts += panel.svg(left, height)
        parts.append(f'<text x="{left + WIDTH / 2:.0f}" y="{height + 22}" text-anchor="middle">{panel.words}</text>')
    width = len(panels) * (WIDTH + GAP) - GAP
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height + FOOT}" width="{width}" '
                    f'height="{height + FOOT}" font-family="sans-serif" font-size="13" fill="{INK}">\n'
                    f'<rect width="{width}" height="{height + FOOT}" fill="white"/>\n' + "\n".join(parts) + "\n</svg>\n", encoding="utf-8")
