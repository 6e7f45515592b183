// What an entry of the list of defects, or one element, comes to in the picture: triangles, lines, points, a halo.
import type { Entry } from "./container";
import { edgeEnds } from "./measure";
import { faceCorners, type Mesh } from "./mesh";
import { Triangles } from "./shown";

export interface Focus {
  over: Triangles;
  lines: Float32Array;
  points: Float32Array;
  halo: Float32Array;
  centre: [number, number, number];
  radius: number;
}

function finite(p: ArrayLike<number>): boolean {
  return Number.isFinite(p[0]) && Number.isFinite(p[1]) && Number.isFinite(p[2]);
}

function around(places: number[][], over: Triangles, lines: number[], points: number[], halos: number[][]): Focus {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const p of places)
    for (let k = 0; k < 3; k++) {
      low[k] = Math.min(low[k], p[k]);
      high[k] = Math.max(high[k], p[k]);
    }
  const centre = low.map((x, k) => (places.length ? (x + high[k]) / 2 : 0)) as [number, number, number];
  const radius = places.length ? Math.max(...places.map((p) => Math.hypot(p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]))) : 1;
  return {
    over, lines: Float32Array.from(lines), points: Float32Array.from(points), halo: Float32Array.from(halos.flat()),
    centre: halos.length === 1 ? (halos[0] as [number, number, number]) : centre, radius,
  };
}

/// The triangles of an entry in two colours, so that parts that cross are told apart.
export function focusOnEntry(mesh: Mesh, entry: Entry): Focus {
  const { part, positions } = mesh, count = part.vertices.length / 3, over = new Triangles(16);
  const at = (v: number) => [positions[3 * v], positions[3 * v + 1], positions[3 * v + 2]];
  const fits = (v: number) => v < count && finite(at(v));
  const places: number[][] = [], lines: number[] = [], points: number[] = [];
  entry.facets.forEach((f, i) => {
    if (3 * f + 2 >= part.facets.length) return;
    const [a, b, c] = part.facets.subarray(3 * f, 3 * f + 3);
    if (![a, b, c].every(fits)) return;
    over.add(positions, a, b, c, i % 2 === 0 ? [225, 60, 60] : [50, 110, 220], 7, 0);
    lines.push(...at(a), ...at(b), ...at(b), ...at(c), ...at(c), ...at(a));
    places.push(at(a), at(b), at(c));
  });
  for (const s of entry.segments) {
    if (2 * s + 1 >= part.segments.length) continue;
    const [a, b] = part.segments.subarray(2 * s, 2 * s + 2);
    if (!fits(a) || !fits(b)) continue;
    lines.push(...at(a), ...at(b));
    places.push(at(a), at(b));
  }
  for (const v of entry.vertices) {
    if (!fits(v)) continue;
    points.push(...at(v));
    places.push(at(v));
  }
  const where = entry.where
    .map((p) => p.map((x, k) => (x === null ? NaN : (x - mesh.centre[k]) * mesh.scale)))
    .filter(finite);
  for (const p of where) points.push(...p);
  if (where.length === 2) lines.push(...where[0], ...where[1]);
  let halos = where.length ? where.slice(0, 1) : places.slice(0, 1);
  if (where.length === 2) halos = [where[0].map((x, k) => (x + where[1][k]) / 2)];
  return around([...places, ...where], over, lines, points, halos);
}

/// A tetrahedron, its edges and a halo at its centre.
export function focusOnElement(mesh: Mesh, t: number): Focus {
  const tets = mesh.part.tetrahedra, p = mesh.positions, over = new Triangles(4);
  const corner = (i: number) => {
    const v = 3 * tets[4 * t + i];
    return [p[v], p[v + 1], p[v + 2]];
  };
  for (const f of faceCorners) over.add(p, tets[4 * t + f[0]], tets[4 * t + f[1]], tets[4 * t + f[2]], [225, 60, 60], 7, 0);
  const corners = [0, 1, 2, 3].map(corner);
  const middle = [0, 1, 2].map((k) => (corners[0][k] + corners[1][k] + corners[2][k] + corners[3][k]) / 4);
  const lines = edgeEnds.flatMap(([i, j]) => [...corners[i], ...corners[j]]);
  return around(corners, over, lines, [], [middle]);
}
