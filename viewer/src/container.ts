// Reads the data of a page: what src/view/container.cpp writes. Base64 of a zlib stream, in which a header in JSON is
// followed by arrays whose bytes stand in planes (all first bytes, then all second ones), so that they pack well.

export interface Names {
  facets: Record<string, string>;
  regions: Record<string, string>;
  segments: Record<string, string>;
}

/// One surface or volume as the page holds it.
export interface Part {
  name: string;
  kind: "volume" | "surface";
  names: Names;
  total: number; // tetrahedra of the file, of which the page may hold a slab alone
  note: string;
  vertices: Float64Array; // 3 a vertex
  tetrahedra: Uint32Array; // 4 each
  numbers: Uint32Array; // of the tetrahedra in the file; empty: they count from 0
  regions: Int32Array; // one a tetrahedron
  facets: Uint32Array; // 3 each
  facetMarkers: Int32Array; // one a facet, or none
  segments: Uint32Array; // 2 each
  segmentMarkers: Int32Array;
  added: Uint8Array; // one a vertex: 1 for points that the input has not; or none, where it is not known
}

/// A place that the page's text tells of: a defect, a gap, the worst place of a cause.
export interface Entry {
  part: number;
  vertices: number[];
  facets: number[];
  segments: number[];
  where: (number | null)[][];
}

export interface PageData {
  title: string;
  version: string;
  parts: Part[];
  entries: Entry[];
}

/// Lets the browser draw and answer between pieces of long work.
export function pause(): Promise<void> {
  return new Promise((resolve) => setTimeout(resolve, 0));
}

export async function decodeBase64(text: string): Promise<Uint8Array> {
  const clean = text.trim();
  const padding = clean.endsWith("==") ? 2 : clean.endsWith("=") ? 1 : 0;
  const bytes = new Uint8Array((clean.length / 4) * 3 - padding);
  const piece = 1 << 22; // a multiple of 4
  let at = 0;
  for (let from = 0; from < clean.length; from += piece) {
    const binary = atob(clean.slice(from, from + piece));
    for (let i = 0; i < binary.length; i++) bytes[at++] = binary.charCodeAt(i);
    await pause();
  }
  return bytes;
}

export async function inflate(bytes: Uint8Array): Promise<Uint8Array> {
  const stream = new Blob([bytes as BlobPart]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

type Kind = "f64" | "u32" | "i32" | "u8";
interface ArrayInfo {
  name: string;
  kind: Kind;
  count: number;
  step: number; // differences to the value so many before, unless 0
}
const sizes: Record<Kind, number> = { f64: 8, u32: 4, i32: 4, u8: 1 };

function unshuffle(bytes: Uint8Array, from: number, info: ArrayInfo): Float64Array | Uint32Array | Int32Array | Uint8Array {
  const size = sizes[info.kind], count = info.count;
  const raw = new Uint8Array(count * size);
  for (let k = 0; k < size; k++) {
    const plane = from + k * count;
    for (let i = 0, to = k; i < count; i++, to += size) raw[to] = bytes[plane + i];
  }
  if (info.kind === "u8") return raw;
  if (info.kind === "f64") return new Float64Array(raw.buffer);
  const words = info.kind === "u32" ? new Uint32Array(raw.buffer) : new Int32Array(raw.buffer);
  if (info.step > 0) for (let i = info.step; i < count; i++) words[i] += words[i - info.step];
  return words;
}

/// Indices that no vertex has are possible in a surface that is to be diagnosed: what has one cannot be drawn.
function withinRange(indices: Uint32Array, corners: number, vertices: number): Uint32Array {
  const out = indices;
  for (let i = 0; i < out.length; i += corners) {
    let inside = true;
    for (let k = 0; k < corners; k++) inside &&= out[i + k] < vertices;
    if (!inside) for (let k = 0; k < corners; k++) out[i + k] = 0;
  }
  return out;
}

export async function readPage(bytes: Uint8Array): Promise<PageData> {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const length = view.getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(bytes.subarray(4, 4 + length)));
  let at = 4 + length;
  const parts: Part[] = [];
  for (const told of header.parts) {
    const arrays: Record<string, Float64Array | Uint32Array | Int32Array | Uint8Array> = {};
    for (const info of told.arrays as ArrayInfo[]) {
      arrays[info.name] = unshuffle(bytes, at, info);
      at += info.count * sizes[info.kind];
      await pause();
    }
    const vertices = arrays.vertices as Float64Array;
    parts.push({
      name: told.name, kind: told.kind, names: told.names, total: told.total, note: told.note, vertices,
      tetrahedra: withinRange(arrays.tetrahedra as Uint32Array, 4, vertices.length / 3),
      numbers: arrays.numbers as Uint32Array,
      regions: arrays.regions as Int32Array,
      facets: withinRange(arrays.facets as Uint32Array, 3, vertices.length / 3),
      facetMarkers: arrays.facet_markers as Int32Array,
      segments: withinRange(arrays.segments as Uint32Array, 2, vertices.length / 3),
      segmentMarkers: arrays.segment_markers as Int32Array,
      added: arrays.added as Uint8Array,
    });
  }
  return { title: header.title, version: header.version, parts, entries: header.entries };
}
