// Small surfaces for the tests.
const corners = (x, y, z, s) => [0, 1].flatMap((k) => [0, 1].flatMap((j) => [0, 1].map((i) => [x + s * i, y + s * j, z + s * k])));
const faces = [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]];

/// Points and triangles of cubes [x, y, z, side], each by itself.
export function cubes(list) {
  return {
    points: list.flatMap(([x, y, z, s]) => corners(x, y, z, s)),
    triangles: list.flatMap((_, i) => faces.map((f) => f.map((v) => v + 8 * i))),
  };
}

export function off({ points, triangles }) {
  return `OFF\n${points.length} ${triangles.length} 0\n${points.map((p) => p.join(" ")).join("\n")}\n${triangles.map((t) => `3 ${t.join(" ")}`).join("\n")}\n`;
}

export function stl({ points, triangles }, name = "part") {
  const facet = (t) => `facet normal 0 0 0\nouter loop\n${t.map((v) => `vertex ${points[v].join(" ")}`).join("\n")}\nendloop\nendfacet\n`;
  return `solid ${name}\n${triangles.map(facet).join("")}endsolid ${name}\n`;
}

/// A sphere of longitudes and latitudes, whose numbers take all bits.
export function sphere(n, radius = 1) {
  const points = [[0, 0, radius], [0, 0, -radius]], triangles = [];
  for (let i = 1; i < n; ++i)
    for (let k = 0; k < 2 * n; ++k) {
      const a = (Math.PI * i) / n, b = (Math.PI * k) / n;
      points.push([radius * Math.sin(a) * Math.cos(b), radius * Math.sin(a) * Math.sin(b), radius * Math.cos(a)]);
    }
  const at = (i, k) => 2 + (i - 1) * 2 * n + (k % (2 * n));
  for (let k = 0; k < 2 * n; ++k) {
    triangles.push([0, at(1, k), at(1, k + 1)], [1, at(n - 1, k + 1), at(n - 1, k)]);
    for (let i = 1; i < n - 1; ++i) triangles.push([at(i, k), at(i + 1, k), at(i + 1, k + 1)], [at(i, k), at(i + 1, k + 1), at(i, k + 1)]);
  }
  return { points, triangles };
}

export const crossing = (pairs) => cubes(Array.from({ length: pairs }, (_, i) => [[3 * i, 0, 0, 1], [3 * i + 0.5, 0.25, 0.125, 1]]).flat());
