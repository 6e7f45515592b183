// Measures of tetrahedra: dihedral angles, the paper's Q, edges, volume; and which flat ones facets force.
import { pause } from "./container";
import { faceCorners, none, type Mesh } from "./mesh";

export interface Measures {
  angle: Float32Array; // least dihedral angle, degrees; negative where the tetrahedron is inverted
  q: Float32Array; // sqrt(6) / 12 h_max / inradius: 1 is regular; Infinity where it is not positive
  size: Float32Array; // mean length of the six edges, in the file's unit
  forced: Uint8Array; // 0: no angle below 10 degrees; 1: one that facets force; 2: another one
}

export interface Shape {
  volume: number;
  angles: number[]; // at edges 01 02 03 12 13 23, degrees
  q: number;
  edges: number[]; // their lengths
}

export const edgeEnds = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]] as const;
export const smallAngle = 10;

/// Of tetrahedron t; coordinates are doubles, taken relative to a corner.
export function shapeOf(vertices: Float64Array, tets: Uint32Array, t: number): Shape {
  const p: number[][] = [];
  for (let i = 0; i < 4; i++) {
    const v = 3 * tets[4 * t + i];
    p.push([vertices[v], vertices[v + 1], vertices[v + 2]]);
  }
  const minus = (a: number[], b: number[]) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const cross = (a: number[], b: number[]) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot = (a: number[], b: number[]) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const edges = edgeEnds.map(([i, j]) => Math.hypot(...(minus(p[j], p[i]) as [number, number, number])));
  const longest = Math.max(...edges);
  const unit = longest > 0 ? longest : 1;
  const scaled = p.map((x) => minus(x, p[0]).map((c) => c / unit));
  const det = dot(cross(minus(scaled[1], scaled[0]), minus(scaled[2], scaled[0])), minus(scaled[3], scaled[0]));
  // Normals of the faces outward, twice their area long.
  const normals = faceCorners.map(([a, b, c]) => cross(minus(scaled[b], scaled[a]), minus(scaled[c], scaled[a])));
  const angles = edgeEnds.map(([i, j]) => {
    const [k, l] = [0, 1, 2, 3].filter((m) => m !== i && m !== j);
    const m = normals[k], n = normals[l]; // the faces at edge ij are those opposite the other two
    const c = cross(m, n);
    const angle = (Math.atan2(Math.sqrt(dot(c, c)), -dot(m, n)) * 180) / Math.PI;
    return det < 0 ? -angle : angle;
  });
  const area = normals.reduce((sum, n) => sum + Math.sqrt(dot(n, n)), 0) / 2;
  const q = det > 0 ? (Math.sqrt(6) / 12) / (det / 2 / area) : Infinity; // inradius 3 V / area, h_max = 1
  return { volume: (det / 6) * unit * unit * unit, angles, q, edges };
}

/// The same for all, without allocation: least angle, Q and mean edge, `tell` gets the share that is done.
export async function measure(mesh: Mesh, tell: (share: number) => void): Promise<Measures> {
  const tets = mesh.part.tetrahedra, x = mesh.part.vertices, count = tets.length / 4;
  const angle = new Float32Array(count), q = new Float32Array(count), size = new Float32Array(count);
  const forced = new Uint8Array(count);
  const c = new Float64Array(12), n = new Float64Array(12), long = new Float64Array(4);
  const scale = mesh.scale, [cx, cy, cz] = mesh.centre;
  for (let t = 0; t < count; t++) {
    for (let i = 0; i < 4; i++) {
      const v = 3 * tets[4 * t + i];
      c[3 * i] = (x[v] - cx) * scale; c[3 * i + 1] = (x[v + 1] - cy) * scale; c[3 * i + 2] = (x[v + 2] - cz) * scale;
    }
    let longest = 0, sum = 0;
    for (const [i, j] of edgeEnds) {
      const a = c[3 * j] - c[3 * i], b = c[3 * j + 1] - c[3 * i + 1], d = c[3 * j + 2] - c[3 * i + 2];
      const length = Math.sqrt(a * a + b * b + d * d);
      sum += length;
      if (length > longest) longest = length;
    }
    let area = 0;
    for (let i = 0; i < 4; i++) {
      const f = faceCorners[i], a = 3 * f[0], b = 3 * f[1], d = 3 * f[2];
      const ux = c[b] - c[a], uy = c[b + 1] - c[a + 1], uz = c[b + 2] - c[a + 2];
      const vx = c[d] - c[a], vy = c[d + 1] - c[a + 1], vz = c[d + 2] - c[a + 2];
      const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      n[3 * i] = nx; n[3 * i + 1] = ny; n[3 * i + 2] = nz;
      long[i] = Math.sqrt(nx * nx + ny * ny + nz * nz);
      area += long[i] / 2;
    }
    // Six times the volume: the face opposite corner 0 against the edge to it.
    const det = -(n[0] * (c[0] - c[3]) + n[1] * (c[1] - c[4]) + n[2] * (c[2] - c[5]));
    let most = -1; // the least angle has the largest cosine
    for (let i = 0; i < 4; i++)
      for (let j = i + 1; j < 4; j++) {
        const cosine = -(n[3 * i] * n[3 * j] + n[3 * i + 1] * n[3 * j + 1] + n[3 * i + 2] * n[3 * j + 2]) / (long[i] * long[j]);
        if (cosine > most) most = cosine;
      }
    let least = (Math.acos(Math.min(1, most)) * 180) / Math.PI;
    if (!(det > 0)) least = -least;
    angle[t] = Number.isNaN(least) ? 0 : least;
    q[t] = det > 0 ? ((Math.sqrt(6) / 12) * longest * 2 * area) / det : Infinity;
    size[t] = sum / 6 / scale;
    if (angle[t] < smallAngle) forced[t] = 2;
    if ((t & 0x1ffff) === 0) {
      tell(t / count);
      await pause();
    }
  }
  blame(mesh, forced);
  return { angle, q, size, forced };
}

/// Among the flat ones, those that facets force, as the library's report counts them: two facets meet at the least
/// angle, or a face that is a facet has such an angle itself, or two facets at that edge enclose such an angle.
function blame(mesh: Mesh, forced: Uint8Array): void {
  const { vertices, tetrahedra: tets, facets } = mesh.part;
  const key = (a: number, b: number) => (a < b ? a * 4294967296 + b : b * 4294967296 + a);
  let wings: Map<number, number[]> | null = null;
  const point = (v: number) => [vertices[3 * v], vertices[3 * v + 1], vertices[3 * v + 2]];
  const minus = (a: number[], b: number[]) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const dot = (a: number[], b: number[]) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const between = (a: number[], b: number[]) =>
    (Math.acos(Math.max(-1, Math.min(1, dot(a, b) / Math.sqrt(dot(a, a) * dot(b, b))))) * 180) / Math.PI;
  const hasSmallAngle = (code: number) => {
    const f = faceCorners[code & 3].map((i) => point(tets[(code & ~3) + i]));
    return [0, 1, 2].some((i) => between(minus(f[(i + 1) % 3], f[i]), minus(f[(i + 2) % 3], f[i])) < smallAngle);
  };
  const wingsAt = (a: number, b: number): number[] => {
    if (!wings) {
      wings = new Map();
      for (let f = 0; f < facets.length; f += 3)
        for (let k = 0; k < 3; k++) {
          const of = key(facets[f + ((k + 1) % 3)], facets[f + ((k + 2) % 3)]);
          const list = wings.get(of);
          if (list) list.push(facets[f + k]);
          else wings.set(of, [facets[f + k]]);
        }
    }
    return wings.get(key(a, b)) ?? [];
  };
  for (let t = 0; t < forced.length; t++) {
    if (forced[t] === 0) continue;
    const shape = shapeOf(vertices, tets, t);
    const least = shape.angles.indexOf(Math.min(...shape.angles));
    const [i, j] = edgeEnds[least];
    const isFacet = (face: number) => mesh.facetOfFace[4 * t + face] !== none;
    const others = [0, 1, 2, 3].filter((m) => m !== i && m !== j);
    let found = others.every(isFacet) || [0, 1, 2, 3].some((face) => isFacet(face) && hasSmallAngle(4 * t + face));
    if (!found) {
      const a = tets[4 * t + i], b = tets[4 * t + j], axis = minus(point(b), point(a));
      const across = wingsAt(a, b).map((apex) => {
        const u = minus(point(apex), point(a)), s = dot(u, axis) / dot(axis, axis);
        return [u[0] - s * axis[0], u[1] - s * axis[1], u[2] - s * axis[2]];
      });
      found = across.some((u, k) => across.slice(0, k).some((w) => between(u, w) < smallAngle));
    }
    if (found) forced[t] = 1;
  }
}
