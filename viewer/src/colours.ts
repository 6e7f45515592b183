// Colours: kinds (regions, markers) by a wheel, quantities by a scale in bins, which the histogram shares.
import type { Measures } from "./measure";
import { none, type Mesh } from "./mesh";
import type { Quantity, State } from "./state";

export type Rgb = readonly [number, number, number];
export const plain: Rgb = [176, 190, 205];
const inner: Rgb = [222, 200, 150]; // faces inside where only facets have a colour
const wheel: Rgb[] = [
  [78, 121, 167], [242, 142, 43], [89, 161, 79], [225, 87, 89], [118, 183, 178], [237, 201, 72], [176, 122, 161],
  [255, 157, 167], [156, 117, 95], [186, 176, 172], [31, 119, 180], [188, 189, 34], [23, 190, 207], [127, 60, 141],
];
// From bad to good; the ends of a scale that people with any colour vision tell apart.
const ramp: Rgb[] = [[165, 0, 38], [215, 48, 39], [244, 109, 67], [253, 174, 97], [254, 224, 144], [224, 243, 248], [171, 217, 233], [116, 173, 209], [69, 117, 180]];

export interface Scale {
  limits: number[]; // between bins: bin i is from limits[i - 1] to limits[i]
  colours: Rgb[]; // one a bin
  labels: string[];
}

function mixed(share: number): Rgb {
  const at = Math.min(1, Math.max(0, share)) * (ramp.length - 1), i = Math.min(ramp.length - 2, Math.floor(at)), s = at - i;
  return [0, 1, 2].map((k) => Math.round(ramp[i][k] * (1 - s) + ramp[i + 1][k] * s)) as unknown as Rgb;
}

export const number = (x: number) => (Number.isFinite(x) ? String(Number(x.toPrecision(3))) : "∞");

export function scaleOf(quantity: Quantity, measures: Measures): Scale {
  if (quantity === "angle") {
    const limits = [0, 5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60];
    const labels = ["≤ 0°", ...limits.slice(1).map((x, i) => `${limits[i]}° – ${x}°`), "> 60°"];
    return { limits, labels, colours: labels.map((_, i) => mixed((i - 1) / (labels.length - 3))) };
  }
  if (quantity === "q") {
    const limits = [1.25, 1.5, 2, 3, 5, 10, 30, 100, 1000];
    const labels = ["1 – 1.25", ...limits.slice(1).map((x, i) => `${limits[i]} – ${x}`), "> 1000"];
    return { limits, labels, colours: labels.map((_, i) => mixed(1 - i / (labels.length - 1))) };
  }
  let low = Infinity, high = 0;
  for (const x of measures.size) {
    if (x < low) low = x;
    if (x > high) high = x;
  }
  if (!(low > 0)) low = high > 0 ? high * 1e-9 : 1;
  if (!(high > low)) high = low * 1.001;
  const bins = 12, limits: number[] = [];
  for (let i = 1; i < bins; i++) limits.push(low * (high / low) ** (i / bins));
  const ends = [low, ...limits, high];
  const labels = Array.from({ length: bins }, (_, i) => `${number(ends[i])} – ${number(ends[i + 1])}`);
  return { limits, labels, colours: labels.map((_, i) => mixed(i / (bins - 1))) };
}

export function binOf(scale: Scale, value: number): number {
  let bin = 0;
  while (bin < scale.limits.length && value > scale.limits[bin]) bin++;
  return bin;
}

/// The bins of all tetrahedra.
export function binsOf(scale: Scale, values: Float32Array): Uint8Array {
  const bins = new Uint8Array(values.length);
  for (let t = 0; t < values.length; t++) bins[t] = binOf(scale, values[t]);
  return bins;
}

export const forcedKinds: { label: string; colour: Rgb }[] = [
  { label: "no angle below 10°", colour: [176, 190, 205] },
  { label: "below 10°, facets force it", colour: [242, 142, 43] },
  { label: "below 10°, not forced", colour: [200, 20, 60] },
];

/// Ids in ascending order, and each one's colour.
export interface Kinds {
  ids: number[];
  colour: Map<number, Rgb>;
  name: (id: number) => string;
}

export function kindsOf(ids: Int32Array, names: Record<string, string>, word: string): Kinds {
  const seen = new Set<number>();
  for (const id of ids) seen.add(id);
  const sorted = [...seen].sort((a, b) => a - b);
  const colour = new Map<number, Rgb>();
  sorted.forEach((id, i) => colour.set(id, wheel[i % wheel.length]));
  return { ids: sorted, colour, name: (id) => (Object.hasOwn(names, id) ? `${id} ${names[id]}` : `${word} ${id}`) };
}

/// What colours the faces of a mesh under a state.
export interface Painter {
  ofFace: (tet: number, facet: number) => Rgb; // facet: none inside
  ofFacet: (facet: number) => Rgb;
}

export interface Palette {
  regions: Kinds;
  markers: Kinds;
  scales: Record<Quantity, Scale>;
  bins: Record<Quantity, Uint8Array>;
}

export function paletteOf(mesh: Mesh, measures: Measures): Palette {
  const part = mesh.part;
  const of = (quantity: Quantity) => scaleOf(quantity, measures);
  const scales = { angle: of("angle"), q: of("q"), size: of("size") };
  return {
    regions: kindsOf(part.regions, part.names.regions, "region"),
    markers: kindsOf(part.facetMarkers.length ? part.facetMarkers : new Int32Array(part.facets.length ? 1 : 0), part.names.facets, "marker"),
    scales,
    bins: { angle: binsOf(scales.angle, measures.angle), q: binsOf(scales.q, measures.q), size: binsOf(scales.size, measures.size) },
  };
}

export function painterOf(state: State, mesh: Mesh, measures: Measures, palette: Palette): Painter {
  const part = mesh.part;
  const marker = (facet: number) => (part.facetMarkers.length ? part.facetMarkers[facet] : 0);
  const byMarker = (facet: number) => palette.markers.colour.get(marker(facet)) ?? plain;
  switch (state.colour) {
    case "region":
      return {
        ofFace: (tet) => palette.regions.colour.get(part.regions[tet]) ?? plain,
        ofFacet: part.kind === "surface" ? byMarker : () => plain,
      };
    case "marker":
      return { ofFace: (_tet, facet) => (facet === none ? inner : byMarker(facet)), ofFacet: byMarker };
    case "angle": case "q": case "size": {
      const { colours } = palette.scales[state.colour], bins = palette.bins[state.colour];
      return { ofFace: (tet) => colours[bins[tet]], ofFacet: () => plain };
    }
    case "forced":
      return { ofFace: (tet) => forcedKinds[measures.forced[tet]].colour, ofFacet: () => plain };
    default:
      return { ofFace: (_tet, facet) => (facet === none ? inner : plain), ofFacet: () => plain };
  }
}
