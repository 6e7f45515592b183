// A part made ready to be drawn: coordinates near 0 for the graphics card, neighbours, and which faces are facets.
import { pause, type Part } from "./container";

/// The corners of face i of a tetrahedron, which lies opposite corner i, seen from outside.
export const faceCorners = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]] as const;

export const none = 0xffffffff;
/// A facet whose tetrahedra a page that holds a slab alone has not.
export const loose = 2;

export interface Mesh {
  part: Part;
  centre: [number, number, number];
  radius: number; // of a ball round 0 that holds all positions
  scale: number; // of the drawing, a unit of length of the file
  positions: Float32Array; // 3 a vertex: (x - centre) * scale, within -1 .. 1
  neighbours: Uint32Array; // of face i of tetrahedron t at 4 t + i: the code of the other side, or none
  facetOfFace: Uint32Array; // of face 4 t + i: the facet that it is, or none
  dangling: Uint8Array; // one a facet: 1 for those with one region, or nothing, on both sides, or `loose`
  pointsAdded: Uint32Array; // vertices
  addedIsKnown: boolean;
}

function box(vertices: Float64Array): { centre: [number, number, number]; scale: number } {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (let v = 0; v < vertices.length; v++) {
    const x = vertices[v];
    if (!Number.isFinite(x)) continue;
    const k = v % 3;
    if (x < low[k]) low[k] = x;
    if (x > high[k]) high[k] = x;
  }
  const centre = [0, 1, 2].map((k) => (low[k] <= high[k] ? low[k] / 2 + high[k] / 2 : 0)) as [number, number, number];
  let half = 0; // halves, since the whole extent may be more than a double holds
  for (let k = 0; k < 3; k++) if (low[k] <= high[k]) half = Math.max(half, high[k] / 2 - low[k] / 2);
  return { centre, scale: half > 0 && Number.isFinite(1 / half) ? 1 / half : 1 };
}

/// All faces by their least corner: the faces whose least corner is v are codes[first[v]] to codes[first[v + 1] - 1].
class FaceTable {
  first: Uint32Array;
  codes: Uint32Array;
  private low = 0;
  private mid = 0;
  private high = 0;

  constructor(private tets: Uint32Array, vertices: number) {
    this.first = new Uint32Array(vertices + 1);
    this.codes = new Uint32Array(tets.length);
  }

  private sort(a: number, b: number, c: number): void {
    let t;
    if (a > b) { t = a; a = b; b = t; }
    if (b > c) { t = b; b = c; c = t; }
    if (a > b) { t = a; a = b; b = t; }
    this.low = a; this.mid = b; this.high = c;
  }

  private sortFace(code: number): void {
    const base = code & ~3, corners = faceCorners[code & 3], tets = this.tets;
    this.sort(tets[base + corners[0]], tets[base + corners[1]], tets[base + corners[2]]);
  }

  async fill(): Promise<void> {
    const { tets, first, codes } = this;
    const usable = (code: number) => this.low !== this.mid && this.mid !== this.high && code >= 0;
    for (let code = 0; code < tets.length; code++) {
      this.sortFace(code);
      if (usable(code)) first[this.low + 1]++;
      if ((code & 0xfffff) === 0) await pause();
    }
    for (let v = 1; v < first.length; v++) first[v] += first[v - 1];
    const next = first.slice();
    for (let code = 0; code < tets.length; code++) {
      this.sortFace(code);
      if (usable(code)) codes[next[this.low]++] = code;
      if ((code & 0xfffff) === 0) await pause();
    }
  }

  /// Codes of the faces with three corners, but for `but`; the first two of them.
  find(a: number, b: number, c: number, but: number): [number, number] {
    this.sort(a, b, c);
    const { low, mid, high } = this;
    let one = none;
    for (let i = this.first[low]; i < this.first[low + 1]; i++) {
      const code = this.codes[i];
      if (code === but) continue;
      this.sortFace(code);
      if (this.mid !== mid || this.high !== high) continue;
      if (one === none) one = code;
      else return [one, code];
    }
    return [one, none];
  }

  async match(neighbours: Uint32Array): Promise<void> {
    const { first, codes } = this;
    const mids = new Uint32Array(codes.length), highs = new Uint32Array(codes.length);
    for (let i = 0; i < first[first.length - 1]; i++) {
      this.sortFace(codes[i]);
      mids[i] = this.mid; highs[i] = this.high;
      if ((i & 0xfffff) === 0) await pause();
    }
    for (let v = 0; v + 1 < first.length; v++) {
      const end = first[v + 1];
      for (let i = first[v]; i < end; i++) {
        if (neighbours[codes[i]] !== none) continue;
        const mid = mids[i], high = highs[i];
        for (let j = i + 1; j < end; j++)
          if (mids[j] === mid && highs[j] === high && neighbours[codes[j]] === none) {
            neighbours[codes[i]] = codes[j];
            neighbours[codes[j]] = codes[i];
            break;
          }
      }
      if ((v & 0x3fff) === 0) await pause();
    }
  }
}

function addedPoints(part: Part): Uint32Array {
  const count = part.vertices.length / 3, list: number[] = [];
  if (part.added.length === count) {
    for (let v = 0; v < count; v++) if (part.added[v]) list.push(v);
    return Uint32Array.from(list);
  }
  if (part.kind === "surface") return new Uint32Array(0);
  // Points that the mesher adds lie on no facet and on no segment.
  const used = new Uint8Array(count);
  for (const v of part.facets) used[v] = 1;
  for (const v of part.segments) used[v] = 1;
  const inTet = new Uint8Array(count);
  for (const v of part.tetrahedra) inTet[v] = 1;
  for (let v = 0; v < count; v++) if (!used[v] && inTet[v]) list.push(v);
  return Uint32Array.from(list);
}

export async function prepare(part: Part): Promise<Mesh> {
  const { centre, scale } = box(part.vertices);
  const positions = new Float32Array(part.vertices.length);
  for (let i = 0; i < positions.length; i++) positions[i] = (part.vertices[i] - centre[i % 3]) * scale;
  let radius = 0;
  for (let i = 0; i < positions.length; i += 3) {
    const r = Math.hypot(positions[i], positions[i + 1], positions[i + 2]);
    if (r > radius) radius = r;
  }
  const neighbours = new Uint32Array(part.tetrahedra.length).fill(none);
  const facetOfFace = new Uint32Array(part.tetrahedra.length).fill(none);
  const facets = part.facets.length / 3;
  const dangling = new Uint8Array(facets);
  if (part.kind === "volume") {
    const table = new FaceTable(part.tetrahedra, part.vertices.length / 3);
    await table.fill();
    await table.match(neighbours);
    for (let f = 0; f < facets; f++) {
      const [one, other] = table.find(part.facets[3 * f], part.facets[3 * f + 1], part.facets[3 * f + 2], none);
      if (one !== none) facetOfFace[one] = f;
      if (other !== none) facetOfFace[other] = f;
      const region = (code: number) => part.regions[code >> 2];
      if (one === none) dangling[f] = part.total > part.tetrahedra.length / 4 ? loose : 1;
      else if (other !== none && region(one) === region(other)) dangling[f] = 1;
      if ((f & 0x3fff) === 0) await pause();
    }
  }
  return {
    part, centre, radius: radius || 1, scale, positions, neighbours, facetOfFace, dangling,
    pointsAdded: addedPoints(part),
    addedIsKnown: part.added.length > 0,
  };
}
