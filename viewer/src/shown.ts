// Which tetrahedra and facets a state shows, and the triangles that are drawn of them.
import type { Measures } from "./measure";
import { painterOf, type Palette, type Rgb } from "./colours";
import { edgeEnds } from "./measure";
import { faceCorners, loose, none, type Mesh } from "./mesh";
import type { State } from "./state";

/// Points x with normal . x <= offset are kept, in the coordinates of Mesh.positions.
export interface Plane {
  normal: [number, number, number];
  offset: number;
}

export function planeOf(state: State, mesh: Mesh): Plane | null {
  if (!state.cut) return null;
  const raw = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1], free: [state.nx, state.ny, state.nz] }[state.axis];
  const length = Math.hypot(...(raw as [number, number, number])) || 1;
  const sign = state.flip ? -1 : 1;
  const n = raw.map((x) => (x / length) * sign) as [number, number, number];
  let low = Infinity, high = -Infinity;
  const p = mesh.positions;
  for (let i = 0; i < p.length; i += 3) {
    const d = n[0] * p[i] + n[1] * p[i + 1] + n[2] * p[i + 2];
    if (d < low) low = d;
    if (d > high) high = d;
  }
  if (!(low < high)) return { normal: n, offset: low === high ? low : 0 };
  const share = state.flip ? 1 - state.position : state.position;
  return { normal: n, offset: low + (high - low) * share };
}

/// Triangles with a colour each: what a mesh of three.js takes. `source` tells picking what a triangle is: the code
/// of a face (4 tetrahedron + face), or facetBit + facet.
export class Triangles {
  count = 0;
  positions: Float32Array;
  colours: Uint8Array; // r g b and which sides are edges (bits 0 to 2: of corners 01, 12, 20), a corner
  source: Float64Array;

  constructor(room = 1024) {
    this.positions = new Float32Array(9 * room);
    this.colours = new Uint8Array(12 * room);
    this.source = new Float64Array(room);
  }

  private grow(): void {
    const room = this.source.length * 2;
    const larger = new Triangles(room);
    larger.positions.set(this.positions);
    larger.colours.set(this.colours);
    larger.source.set(this.source);
    this.positions = larger.positions;
    this.colours = larger.colours;
    this.source = larger.source;
  }

  add(p: Float32Array, a: number, b: number, c: number, colour: Rgb, edges: number, source: number): void {
    if (this.count === this.source.length) this.grow();
    const to = 9 * this.count, paint = 12 * this.count;
    for (let k = 0; k < 3; k++) {
      this.positions[to + k] = p[3 * a + k];
      this.positions[to + 3 + k] = p[3 * b + k];
      this.positions[to + 6 + k] = p[3 * c + k];
    }
    for (let corner = 0; corner < 3; corner++) {
      const at = paint + 4 * corner;
      this.colours[at] = colour[0]; this.colours[at + 1] = colour[1]; this.colours[at + 2] = colour[2];
      this.colours[at + 3] = edges;
    }
    this.source[this.count++] = source;
  }
}

export const facetBit = 2 ** 40;

export interface Shown {
  solid: Triangles; // what is cut away is not there, but for a flat cut, which the graphics card does
  cap: Triangles; // of a flat cut
  dangling: Triangles;
  plane: Plane | null;
  tetrahedra: number; // that are shown
  kept: Uint8Array;
}

/// What the controls other than the plane let through.
export function chosen(state: State, mesh: Mesh, measures: Measures, palette: Palette): Uint8Array {
  const part = mesh.part, count = part.tetrahedra.length / 4, kept = new Uint8Array(count).fill(1);
  const hiddenRegions = new Set(state.hidden.filter((w) => w[0] === "r").map((w) => Number(w.slice(1))));
  if (hiddenRegions.size) for (let t = 0; t < count; t++) if (hiddenRegions.has(part.regions[t])) kept[t] = 0;
  const hiddenKinds = new Set(state.hidden.filter((w) => w[0] === "k").map((w) => Number(w.slice(1))));
  if (hiddenKinds.size) for (let t = 0; t < count; t++) if (hiddenKinds.has(measures.forced[t])) kept[t] = 0;
  if (state.bars.length) {
    const wanted = new Set(state.bars), bins = palette.bins[state.histogram];
    for (let t = 0; t < count; t++) if (!wanted.has(bins[t])) kept[t] = 0;
  }
  return kept;
}

function distances(mesh: Mesh, plane: Plane): Float32Array {
  const p = mesh.positions, [a, b, c] = plane.normal, d = new Float32Array(p.length / 3);
  for (let v = 0; v < d.length; v++) d[v] = a * p[3 * v] + b * p[3 * v + 1] + c * p[3 * v + 2] - plane.offset;
  return d;
}

export function show(state: State, mesh: Mesh, measures: Measures, palette: Palette): Shown {
  const part = mesh.part, tets = part.tetrahedra, p = mesh.positions;
  const plane = planeOf(state, mesh), d = plane ? distances(mesh, plane) : null;
  const painter = painterOf(state, mesh, measures, palette);
  const hiddenMarkers = new Set(state.hidden.filter((w) => w[0] === "m").map((w) => Number(w.slice(1))));
  const isHidden = (facet: number) =>
    hiddenMarkers.size > 0 && hiddenMarkers.has(part.facetMarkers.length ? part.facetMarkers[facet] : 0);
  const kept = chosen(state, mesh, measures, palette);
  const solid = new Triangles(), cap = new Triangles(64), dangling = new Triangles(64);
  const flat = state.cap === "flat";
  if (flat && d && state.elements) addCap(cap, mesh, kept, d, (tet) => painter.ofFace(tet, none));
  // A crinkle cut keeps whole every tetrahedron that has a corner on the kept side.
  if (d && !flat)
    for (let t = 0; t < kept.length; t++)
      if (d[tets[4 * t]] > 0 && d[tets[4 * t + 1]] > 0 && d[tets[4 * t + 2]] > 0 && d[tets[4 * t + 3]] > 0) kept[t] = 0;
  let tetrahedra = 0;
  for (let t = 0; t < kept.length; t++) {
    if (!kept[t]) continue;
    tetrahedra++;
    for (let face = 0; face < 4; face++) {
      const code = 4 * t + face, other = mesh.neighbours[code];
      if (other !== none && kept[other >> 2]) continue;
      const facet = mesh.facetOfFace[code];
      if (facet === none ? !state.elements : !state.surface || isHidden(facet)) continue;
      const f = faceCorners[face];
      solid.add(p, tets[4 * t + f[0]], tets[4 * t + f[1]], tets[4 * t + f[2]], painter.ofFace(t, facet), 7, code);
    }
  }
  const onSide = (f: number) => !d || d[part.facets[3 * f]] <= 0 || d[part.facets[3 * f + 1]] <= 0 || d[part.facets[3 * f + 2]] <= 0;
  for (let f = 0; f < part.facets.length / 3; f++) {
    if (isHidden(f)) continue;
    const [a, b, c] = part.facets.subarray(3 * f, 3 * f + 3);
    if (part.kind === "surface") {
      if (state.surface && onSide(f)) solid.add(p, a, b, c, painter.ofFacet(f), 7, facetBit + f);
    } else if (mesh.dangling[f] === loose) {
      if (state.surface && onSide(f)) solid.add(p, a, b, c, painter.ofFacet(f), 7, facetBit + f);
    } else if (state.dangling && mesh.dangling[f] && onSide(f)) {
      dangling.add(p, a, b, c, state.colour === "marker" ? painter.ofFacet(f) : [230, 60, 200], 7, facetBit + f);
    }
  }
  return { solid, cap, dangling, plane, tetrahedra, kept };
}

/// Where the plane cuts the kept tetrahedra: a triangle or a quadrangle each.
function addCap(cap: Triangles, mesh: Mesh, kept: Uint8Array, d: Float32Array, colour: (tet: number) => Rgb): void {
  const tets = mesh.part.tetrahedra, p = mesh.positions, at = new Float32Array(12);
  for (let t = 0; t < kept.length; t++) {
    if (!kept[t]) continue;
    let below = 0;
    for (let i = 0; i < 4; i++) if (d[tets[4 * t + i]] <= 0) below++;
    if (below === 0 || below === 4) continue;
    let points = 0;
    const sides: number[] = []; // two numbers a point: the edge's ends
    for (const [i, j] of edgeEnds) {
      const a = tets[4 * t + i], b = tets[4 * t + j];
      if (d[a] <= 0 === d[b] <= 0) continue;
      const s = d[a] / (d[a] - d[b]);
      for (let k = 0; k < 3; k++) at[3 * points + k] = p[3 * a + k] * (1 - s) + p[3 * b + k] * s;
      sides.push(i, j);
      points++;
    }
    if (points === 3) {
      cap.add(at, 0, 1, 2, colour(t), 7, 4 * t);
      continue;
    }
    // Neighbouring corners of the quadrangle lie on edges with an end in common.
    const fit = (m: number, n: number) => sides[2 * m] === sides[2 * n] || sides[2 * m] === sides[2 * n + 1] || sides[2 * m + 1] === sides[2 * n] || sides[2 * m + 1] === sides[2 * n + 1];
    const opposite = [1, 2, 3].find((m) => !fit(0, m)) ?? 2;
    const [one, other] = [1, 2, 3].filter((m) => m !== opposite);
    cap.add(at, 0, one, opposite, colour(t), 3, 4 * t);
    cap.add(at, opposite, other, 0, colour(t), 3, 4 * t);
  }
}

/// The boundary of everything, for a ghost.
export function ghostOf(mesh: Mesh): Triangles {
  const part = mesh.part, ghost = new Triangles();
  const grey: Rgb = [128, 140, 155];
  if (part.kind === "surface")
    for (let f = 0; f < part.facets.length; f += 3)
      ghost.add(mesh.positions, part.facets[f], part.facets[f + 1], part.facets[f + 2], grey, 0, 0);
  for (let code = 0; code < mesh.neighbours.length; code++) {
    if (mesh.neighbours[code] !== none) continue;
    const f = faceCorners[code & 3], base = code & ~3, tets = part.tetrahedra;
    ghost.add(mesh.positions, tets[base + f[0]], tets[base + f[1]], tets[base + f[2]], grey, 0, 0);
  }
  return ghost;
}
