// What the calls take and give.

/** A file: its name, whose ending tells the format, and its bytes. */
export interface NamedBytes {
  name: string;
  bytes: Uint8Array;
}

/** x, y, z in the input's own unit. */
export type Place = [number, number, number];

/** The region that holds `where` gets `id`. */
export interface RegionSeed {
  where: Place;
  id: number;
  size?: number;
  maxVolume?: number;
}

/** Names of ids. */
export interface Names {
  facets?: Record<number, string>;
  regions?: Record<number, string>;
  segments?: Record<number, string>;
  vertices?: Record<number, string>;
}

/** A triangulated surface. Indices count from 0; markers are as many as their entities. */
export interface Surface {
  /** x y z, one vertex after the other. */
  vertices: Float64Array;
  /** Three indices each. */
  triangles: Uint32Array;
  /** Two indices each. */
  segments?: Uint32Array;
  triangleMarkers?: Int32Array;
  segmentMarkers?: Int32Array;
  vertexMarkers?: Int32Array;
  names?: Names;
  /** Seeds that some formats carry (.poly, .smesh); `mesh` takes them behind those of its options. */
  seeds?: { holes?: Place[]; regions?: RegionSeed[] };
}

/** A tetrahedral mesh. A tetrahedron a b c d has det(b-a, c-a, d-a) > 0. */
export interface Volume extends Surface {
  /** Four indices each. */
  tetrahedra: Uint32Array;
  /** One a tetrahedron. */
  regions?: Int32Array;
  /** One a vertex: which of the surface it is, -1 for an added one. */
  inputVertices?: Int32Array;
}

/** A surface as files (several are put together; .node and .ele, say, are one) or as arrays. */
export type SurfaceInput = NamedBytes | NamedBytes[] | Surface;
export type VolumeInput = NamedBytes | NamedBytes[] | Volume;

/** Called every 20 ms or so with the share of the call that is done, 0 to 1, and the stage; false cancels. */
export type Progress = (share: number, stage: string) => boolean | void;

export interface Limits {
  /** Seconds. */
  timeLimit?: number;
  /** Bytes of the module's memory, which grows and does not shrink. */
  memoryLimit?: number;
}

/** What bounds and watches a call of a `Holdfast`. */
export interface Watch {
  progress?: Progress;
  /** The call ends soon after another thread has stored a number other than 0 in its first element. Over a
   * SharedArrayBuffer. */
  cancel?: Int32Array;
}

/** As the options of `holdfast mesh`; the same ones give the same bits. */
export interface MeshOptions extends Limits {
  /** Only the points that the surface forces, and a few against flat elements. */
  fill?: boolean;
  /** The most that edges inside should measure. */
  size?: number;
  /** 0 to 1; by default 0.3 to 0.5, by the surface. */
  gradation?: number;
  noGrowth?: boolean;
  maxVolume?: number;
  maxRatio?: number;
  quality?: "fast" | "good" | "best";
  keep?: "auto" | "bounded" | "winding" | "box";
  /** For keep: "box"; 0.1. */
  boxMargin?: number;
  holes?: Place[];
  regions?: RegionSeed[];
  dropOutside?: boolean;
  seed?: number;
}

/** As the options of `holdfast repair`. */
export interface RepairOptions extends Limits {
  /** Vertices within this distance become one, or are put on the side or triangle that is this near. */
  weld?: number;
  /** Closes holes: all, or those of so many sides. */
  fillHoles?: boolean | number;
  union?: boolean;
}

export interface DiagnoseOptions extends Limits {
  /** Bounds the number of defects. */
  most?: number;
}

export interface CheckOptions extends Limits {
  outsideDropped?: boolean;
  box?: boolean;
}

/** Of results: a file in this format (".vtu", ...), and the name of the file without its ending. */
export interface Output {
  format?: string;
  name?: string;
}

/** A broken rule of a surface. */
export interface Defect {
  /** Stable: DefectKind in holdfast/types.h. */
  kind: number;
  name: string;
  message: string;
  vertices: number[];
  facets: number[];
  segments: number[];
  where: Place[];
}

/** What the program writes by --report; docs/command-line.md has the keys. */
export interface Report {
  [key: string]: unknown;
}

export interface MeshResult {
  volume: Volume;
  /** Of `format`, the one that was asked for first; else none. */
  files: NamedBytes[];
  report: Report;
}

export interface RepairResult {
  surface: Surface;
  files: NamedBytes[];
  report: Report;
}

export interface Diagnosis {
  valid: boolean;
  defects: Defect[];
  report: Report;
}

export interface Check {
  holds: boolean;
  rules: { name: string; holds: boolean; detail: string }[];
}

export interface About {
  version: string;
  volumeFormats: string[];
  readableVolumeFormats: string[];
  surfaceFormats: string[];
}
