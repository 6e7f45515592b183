"""Pictures of triangles in space as small PNG files: a z-buffer, flat shading and edges."""
import struct
import zlib

import numpy as np

SIZE = (440, 320)  # pixels of a view, width and height
OVER = 2  # samples a pixel, each way
SKIN, CUT, LARGE, POINT = (166, 196, 226), (244, 206, 130), (226, 120, 100), (192, 57, 43)


def frame(points, eye):
    """Pixel coordinates and depth of points seen along -eye, all of them in view."""
    eye = np.asarray(eye, float) / np.linalg.norm(eye)
    right = np.cross((0, 0, 1), eye)
    right /= np.linalg.norm(right)
    up = np.cross(eye, right)
    flat = points @ np.stack([right, up, eye], axis=1)
    low, high = flat.min(axis=0), flat.max(axis=0)
    size = np.array(SIZE) * OVER
    scale = min((size - 16 * OVER) / np.maximum(high[:2] - low[:2], 1e-300))
    flat -= (low + high) / 2
    flat[:, :2] *= scale
    return np.column_stack([size[0] / 2 + flat[:, 0], size[1] / 2 - flat[:, 1], flat[:, 2] * scale])


class View:
    """One picture: triangles by three rows of coordinates each, drawn in any order."""

    def __init__(self, points, eye=(0.55, -0.75, 0.5)):
        self.eye = np.asarray(eye, float) / np.linalg.norm(eye)
        self.points, self.flat = points, frame(points, eye)
        self.image = np.full((SIZE[1] * OVER, SIZE[0] * OVER, 3), 255, np.uint8)
        self.depth = np.full(self.image.shape[:2], -np.inf)

    def faces(self, triangles, colour, outward=False):
        """`outward`: corners turn left as seen from outside, so that those seen from inside are hidden."""
        normals = np.cross(self.points[triangles[:, 1]] - self.points[triangles[:, 0]], self.points[triangles[:, 2]] - self.points[triangles[:, 0]])
        lengths = np.linalg.norm(normals, axis=1)
        light = 0.55 + 0.45 * np.abs(normals @ np.array([0.35, -0.5, 0.79])) / np.maximum(lengths, 1e-300)
        shown = normals @ self.eye > 0 if outward else np.full(len(triangles), True)
        for t, shade in zip(triangles[shown], light[shown]):
            self._face(self.flat[t], np.clip(np.array(colour) * shade, 0, 255))
        return self

    def _face(self, p, colour):
        height, width = self.depth.shape
        x0, y0 = np.floor(p[:, :2].min(axis=0)).astype(int)
        x1, y1 = np.ceil(p[:, :2].max(axis=0)).astype(int) + 1
        x0, y0, x1, y1 = max(x0, 0), max(y0, 0), min(x1, width), min(y1, height)
        if x0 >= x1 or y0 >= y1:
            return
        y, x = np.mgrid[y0:y1, x0:x1]
        area = (p[1, 0] - p[0, 0]) * (p[2, 1] - p[0, 1]) - (p[1, 1] - p[0, 1]) * (p[2, 0] - p[0, 0])
        if abs(area) < 1e-9:
            return
        weights = []
        near_edge = np.zeros(x.shape, bool)
        for k in range(3):
            a, b = p[(k + 1) % 3], p[(k + 2) % 3]
            w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area
            weights.append(w)
            near_edge |= np.abs(w) * abs(area) < 0.6 * OVER * np.hypot(b[0] - a[0], b[1] - a[1])
        slack = -1e-9
        inside = (weights[0] >= slack) & (weights[1] >= slack) & (weights[2] >= slack)
        z = weights[0] * p[0, 2] + weights[1] * p[1, 2] + weights[2] * p[2, 2]
        box = (slice(y0, y1), slice(x0, x1))
        shown = inside & (z >= self.depth[box])
        self.depth[box][shown] = z[shown]
        self.image[box][shown] = colour
        self.image[box][shown & near_edge] = (70, 70, 70)

    def dots(self, points, colour=POINT, radius=4, through=False):
        """Balls; `through`: seen through what is in front of them."""
        for x, y, z in points:
            x0, y0 = int(x) - radius, int(y) - radius
            yy, xx = np.mgrid[y0:y0 + 2 * radius + 1, x0:x0 + 2 * radius + 1]
            inside = (xx - x) ** 2 + (yy - y) ** 2 <= radius ** 2
            inside &= (xx >= 0) & (yy >= 0) & (xx < self.depth.shape[1]) & (yy < self.depth.shape[0])
            yy, xx = yy[inside], xx[inside]
            seen = np.full(yy.shape, True) if through else z + radius >= self.depth[yy, xx]
            self.image[yy[seen], xx[seen]] = colour
        return self

    def pixels(self):
        height, width = SIZE[1], SIZE[0]
        return self.image.reshape(height, OVER, width, OVER, 3).mean(axis=(1, 3)).astype(np.uint8)


def boundary(tets):
    """Faces that one tetrahedron has, and the index of that tetrahedron."""
    corners = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])
    faces = tets[:, corners].reshape(-1, 3)
    order = np.sort(faces, axis=1)
    _, first, count = np.unique(order, axis=0, return_index=True, return_counts=True)
    chosen = first[count == 1]
    return faces[chosen], chosen // 4


def cut(points, tets, axis, level):
    """Those tetrahedra whose middle lies below a level: faces of the surface, and faces that the cut lays open."""
    outer = {tuple(f) for f in np.sort(boundary(tets)[0], axis=1)}
    kept = tets[points[tets].mean(axis=1)[:, axis] < level]
    faces = boundary(kept)[0]
    old = np.array([tuple(f) in outer for f in np.sort(faces, axis=1)], bool)
    return faces[old], faces[~old]


def write(path, views, columns=2):
    """Views in rows of so many, as one PNG."""
    rows = [np.concatenate([v.pixels() for v in views[k: k + columns]], axis=1) for k in range(0, len(views), columns)]
    widest = max(r.shape[1] for r in rows)
    image = np.concatenate([np.pad(r, ((0, 0), (0, widest - r.shape[1]), (0, 0)), constant_values=255) for r in rows])
    height, width, _ = image.shape
    # Few colours, so that the file is small.
    image = (image // 16 * 17).astype(np.uint8)
    raw = np.concatenate([np.zeros((height, 1), np.uint8), image.reshape(height, -1)], axis=1).tobytes()

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                     + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))
