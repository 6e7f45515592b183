// Arrays as they go through the file system of the module: each a file of little-endian numbers (web/src/arrays.h).
import type { Answer } from "./core";
import type { Names, Place } from "./types";

/// The module's spelling of a name.
export const snake = (key: string) => key.replace(/[A-Z]/g, (letter) => `_${letter.toLowerCase()}`);

export const bytesOf = (array: ArrayBufferView) => new Uint8Array(array.buffer, array.byteOffset, array.byteLength);

export const arrayTypes = {
  vertices: Float64Array, triangles: Uint32Array, segments: Uint32Array, triangleMarkers: Int32Array, segmentMarkers: Int32Array,
  vertexMarkers: Int32Array, tetrahedra: Uint32Array, regions: Int32Array, inputVertices: Int32Array,
} as const;
export type ArrayName = keyof typeof arrayTypes;
export const arrayNames = Object.keys(arrayTypes) as ArrayName[];

/// What a surface and a volume have even where it is empty.
export const surfaceNames: ArrayName[] = ["vertices", "triangles"];
export const volumeNames: ArrayName[] = ["vertices", "triangles", "tetrahedra"];

export function meshOf(answer: Answer, always: ArrayName[]): Record<string, unknown> {
  const mesh: Record<string, unknown> = {};
  for (const name of arrayNames) {
    const bytes = answer.arrays[snake(name)];
    if (bytes) mesh[name] = new arrayTypes[name](bytes.buffer as ArrayBuffer, bytes.byteOffset, bytes.byteLength / arrayTypes[name].BYTES_PER_ELEMENT);
    else if (always.includes(name)) mesh[name] = new arrayTypes[name](0);
  }
  const { names, seeds } = answer.response as { names?: Names; seeds?: { holes: Place[]; regions: { where: Place; id: number; size: number; max_volume: number }[] } };
  if (names) mesh.names = names;
  if (seeds)
    mesh.seeds = {
      holes: seeds.holes,
      regions: seeds.regions.map(({ where, id, size, max_volume }) => ({ where, id, ...(size ? { size } : {}), ...(max_volume ? { maxVolume: max_volume } : {}) })),
    };
  return mesh;
}
