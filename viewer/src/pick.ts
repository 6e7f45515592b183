// What lies under the pointer, and all that is known of it as text.
import { Vector3 } from "three";
import type { Orbit } from "./camera";
import { none, type Mesh } from "./mesh";
import { shapeOf } from "./measure";
import { facetBit, type Shown, type Triangles } from "./shown";

interface Hit {
  source: number;
  distance: number;
  at: Vector3;
}

/// The nearest triangle of a list that a ray meets, on the kept side of a plane where that is cut by the graphics card.
function nearest(triangles: Triangles, from: Vector3, along: Vector3, side: ((p: Vector3) => boolean) | null): Hit | null {
  const x = triangles.positions;
  let best: Hit | null = null;
  const a = new Vector3(), u = new Vector3(), v = new Vector3(), h = new Vector3(), s = new Vector3(), q = new Vector3();
  for (let i = 0; i < triangles.count; i++) {
    const k = 9 * i;
    a.set(x[k], x[k + 1], x[k + 2]);
    u.set(x[k + 3], x[k + 4], x[k + 5]).sub(a);
    v.set(x[k + 6], x[k + 7], x[k + 8]).sub(a);
    h.crossVectors(along, v);
    const det = u.dot(h);
    if (det === 0) continue;
    s.subVectors(from, a);
    const b = s.dot(h) / det;
    if (b < 0 || b > 1) continue;
    q.crossVectors(s, u);
    const c = along.dot(q) / det;
    if (c < 0 || b + c > 1) continue;
    const distance = v.dot(q) / det;
    if (distance <= 0 || (best && distance >= best.distance)) continue;
    const at = from.clone().addScaledVector(along, distance);
    if (side && !side(at)) continue;
    best = { source: triangles.source[i], distance, at };
  }
  return best;
}

export function pick(orbit: Orbit, shown: Shown, flat: boolean, x: number, y: number, width: number, height: number): Hit | null {
  orbit.apply(width, height);
  const from = orbit.camera.position.clone();
  const along = new Vector3((2 * x) / width - 1, 1 - (2 * y) / height, 0.5).unproject(orbit.camera).sub(from).normalize();
  const plane = shown.plane;
  const side = plane && flat ? (p: Vector3) => p.dot(new Vector3(...plane.normal)) <= plane.offset + 1e-6 : null;
  const hits = [nearest(shown.solid, from, along, side), nearest(shown.cap, from, along, null), nearest(shown.dangling, from, along, side)];
  return hits.reduce((best, hit) => (hit && (!best || hit.distance < best.distance) ? hit : best), null);
}

const exact = (x: number) => (Number.isFinite(x) ? x.toPrecision(17) : String(x));
const rounded = (x: number) => (Number.isFinite(x) ? String(Number(x.toPrecision(6))) : "infinite");

function named(id: number, names: Record<string, string>): string {
  return Object.hasOwn(names, id) ? `${id} (${names[id]})` : String(id);
}

function vertexLines(mesh: Mesh, vertices: number[]): string[] {
  const x = mesh.part.vertices;
  return vertices.map((v) => {
    const added = mesh.addedIsKnown && mesh.part.added[v] ? " added" : "";
    return `vertex ${v}${added}: ${exact(x[3 * v])} ${exact(x[3 * v + 1])} ${exact(x[3 * v + 2])}`;
  });
}

export function numberOf(mesh: Mesh, tet: number): number {
  return mesh.part.numbers.length ? mesh.part.numbers[tet] : tet;
}

export function tellFacet(mesh: Mesh, f: number): string[] {
  const { part } = mesh;
  const marker = part.facetMarkers.length ? part.facetMarkers[f] : 0;
  return [`facet ${f}, marker ${named(marker, part.names.facets)}`, ...vertexLines(mesh, [...part.facets.subarray(3 * f, 3 * f + 3)])];
}

export function tellTetrahedron(mesh: Mesh, t: number): string[] {
  const { part } = mesh, shape = shapeOf(part.vertices, part.tetrahedra, t);
  return [
    `tetrahedron ${numberOf(mesh, t)}, region ${named(part.regions.length ? part.regions[t] : 0, part.names.regions)}`,
    ...vertexLines(mesh, [...part.tetrahedra.subarray(4 * t, 4 * t + 4)]),
    `volume ${exact(shape.volume)}`,
    `dihedral angles ${shape.angles.map(rounded).join(" ")} degrees (edges 01 02 03 12 13 23)`,
    `Q ${rounded(shape.q)}`,
    `edges ${shape.edges.map(rounded).join(" ")}`,
  ];
}

export function tell(mesh: Mesh, source: number): string {
  if (source >= facetBit) return tellFacet(mesh, source - facetBit).join("\n");
  const lines = tellTetrahedron(mesh, source >> 2), facet = mesh.facetOfFace[source];
  if (facet !== none) lines.push(...tellFacet(mesh, facet));
  return lines.join("\n");
}
