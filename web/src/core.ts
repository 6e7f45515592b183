// Calls of the module: files and arrays in, a response, files and arrays out.
import { arrayNames, arrayTypes, bytesOf, meshOf, snake, surfaceNames, volumeNames } from "./arrays";
import type {
  About, Check, CheckOptions, Defect, Diagnosis, DiagnoseOptions, Limits, MeshOptions, MeshResult, NamedBytes, Output,
  RepairOptions, RepairResult, Report, Surface, SurfaceInput, Volume, VolumeInput, Watch,
} from "./types";

/** What emscripten makes (build/web/wasm/holdfast.js). */
export interface Module {
  FS: {
    mkdir(path: string): void;
    chdir(path: string): void;
    writeFile(path: string, bytes: Uint8Array): void;
    readFile(path: string): Uint8Array;
    readdir(path: string): string[];
    unlink(path: string): void;
  };
  ccall(name: string, returns: "string", types: ["string"], values: [string]): string;
  progress?: (share: number, stage: string) => boolean;
}
export type Factory = (options: { wasmBinary: Uint8Array; print: () => void; printErr: () => void }) => Promise<Module>;

/** Why a call has no result. The codes are those of holdfast/c.h, and "stopped": the module ran out of its memory or
 * stack in a way that it cannot go on from; load another one. */
export type ErrorCode =
  | "invalid_input" | "time_limit" | "memory_limit" | "cancelled" | "not_representable" | "bad_argument" | "file_error"
  | "out_of_memory" | "too_large" | "internal_error" | "stopped";

export class HoldfastError extends Error {
  override readonly name = "HoldfastError";
  constructor(
    readonly code: ErrorCode,
    message: string,
    /** Of an invalid surface. */
    readonly defects: Defect[] = [],
    /** For "file_error": which file, and where in it. */
    readonly file: string = "",
    readonly where: string = "",
    readonly report: Report = {},
  ) {
    super(message);
  }
}

/** What the module answers. */
export interface Response {
  outcome: string;
  message?: string;
  [key: string]: unknown;
}
export interface Request {
  call: string;
  inputs?: NamedBytes[];
  surface?: Surface;
  volume?: VolumeInput;
  options?: object;
  output?: string; // the name of a file
  arrays?: boolean; // whether the result is wanted as arrays
  page?: string; // the title of a page that is wanted
}
export interface Answer {
  response: Response;
  files: NamedBytes[];
  arrays: Record<string, Uint8Array>;
  page?: Uint8Array;
}

const folders = ["/in", "/out", "/arrays", "/page"];

/** A name without folders, which the file system of the module takes. */
export function safeName(name: string): string {
  const last = name.slice(Math.max(name.lastIndexOf("/"), name.lastIndexOf("\\")) + 1).replace(/[\0]/g, "").slice(-200);
  return last === "" || last === "." || last === ".." ? "file" : last;
}

/** Options as the module spells them; those that are undefined are not given. */
function spelled(options: unknown): unknown {
  if (Array.isArray(options)) return options.map(spelled);
  if (typeof options !== "object" || options === null) return options;
  return Object.fromEntries(Object.entries(options).filter(([, value]) => value !== undefined).map(([key, value]) => [snake(key), spelled(value)]));
}

const surfaceOf = (answer: Answer) => meshOf(answer, surfaceNames) as unknown as Surface;
const volumeOf = (answer: Answer) => meshOf(answer, volumeNames) as unknown as Volume;
const isFile = (input: object): input is NamedBytes => "bytes" in input;
const filesOf = (input: object): NamedBytes[] | undefined => (Array.isArray(input) ? input : isFile(input) ? [input] : undefined);

const stemOf = (name: string) => safeName(name).replace(/\.gz$/, "").replace(/(.)\.[^.]*$/, "$1");

/** The library. A call occupies its thread until it is done: on a page, make one in a Worker (`HoldfastWorker` does). */
export class Holdfast {
  private stopped = false;

  private constructor(private readonly module: Module) {
    for (const folder of folders) module.FS.mkdir(folder);
    module.FS.chdir("/in");
  }

  /** Of the bytes of holdfast.wasm. */
  static async of(factory: Factory, wasmBinary: Uint8Array): Promise<Holdfast> {
    return new Holdfast(await factory({ wasmBinary, print: () => {}, printErr: () => {} }));
  }

  /** One call as the module takes it; failures are answers, too. For what the other functions do not do. */
  run(request: Request, watch: Watch = {}): Answer {
    if (this.stopped) throw new HoldfastError("stopped", "the module has stopped: load another one");
    const { FS } = this.module;
    for (const folder of folders) for (const name of FS.readdir(folder)) if (name !== "." && name !== "..") FS.unlink(`${folder}/${name}`);
    const { call, options = {}, inputs = [], output, arrays, page } = request;
    const json: Record<string, unknown> = { call, options: spelled(options), arrays };
    const taken = new Set<string>();
    const put = (file: NamedBytes) => {
      let name = safeName(file.name);
      for (let i = 1; taken.has(name); ++i) name = `${i}_${safeName(file.name)}`;
      taken.add(name);
      FS.writeFile(`/in/${name}`, bytesOf(file.bytes));
      return name;
    };
    json.inputs = inputs.map(put);
    const putArrays = (mesh: Surface | Volume) => {
      for (const name of arrayNames) {
        const array = (mesh as Volume)[name];
        if (array === undefined) continue;
        if (!(array instanceof arrayTypes[name])) throw new HoldfastError("bad_argument", `${name}: ${arrayTypes[name].name} is expected`);
        if (array.length > 0) FS.writeFile(`/arrays/${snake(name)}`, bytesOf(array));
      }
      if (mesh.names) json.names = mesh.names;
      if (mesh.seeds) json.seeds = spelled(mesh.seeds);
    };
    if (request.surface) {
      putArrays(request.surface);
      json.surface_arrays = true;
    }
    if (request.volume) {
      const files = filesOf(request.volume);
      if (files) [json.volume] = files.map(put);
      else if (request.surface) throw new HoldfastError("bad_argument", "of a surface and a volume one is a file");
      else {
        putArrays(request.volume as Volume);
        json.volume_arrays = true;
      }
    }
    if (output?.endsWith(".openfoam")) throw new HoldfastError("bad_argument", "OpenFOAM's mesh is a folder, which only the program writes");
    if (output) json.output = `/out/${safeName(output)}`;
    if (page !== undefined) Object.assign(json, { page: "/page/page.html", title: page });
    const { progress, cancel } = watch;
    this.module.progress = (share, stage) => {
      if (cancel && Atomics.load(cancel, 0) !== 0) return false;
      return progress?.(share, stage) !== false;
    };
    let response: Response;
    try {
      response = JSON.parse(this.module.ccall("holdfast_call", "string", ["string"], [JSON.stringify(json)]));
    } catch (error) {
      this.stopped = true;
      throw new HoldfastError("stopped", `the module stopped: ${String(error)}`);
    }
    const files = FS.readdir("/out").filter((name) => name !== "." && name !== "..").sort().map((name) => ({ name, bytes: FS.readFile(`/out/${name}`) }));
    if (output) files.sort((a, b) => Number(b.name === safeName(output)) - Number(a.name === safeName(output)));
    const answer: Answer = { response, files, arrays: {} };
    if (arrays && response.outcome === "done")
      for (const name of arrayNames.map(snake)) if (FS.readdir("/arrays").includes(name)) answer.arrays[name] = FS.readFile(`/arrays/${name}`);
    if (FS.readdir("/page").includes("page.html")) answer.page = FS.readFile("/page/page.html");
    return answer;
  }

  private done(request: Request, watch?: Watch): Answer {
    const answer = this.run(request, watch), { response } = answer;
    if (response.outcome === "done") return answer;
    throw new HoldfastError(
      response.outcome as ErrorCode, response.message ?? response.outcome, (response.defects ?? []) as Defect[],
      (response.file ?? "") as string, (response.where ?? "") as string, response);
  }

  private surfaceRequest(call: string, input: SurfaceInput, options: object, output?: Output): Request {
    const inputs = filesOf(input);
    const name = output?.name ?? (inputs?.[0] ? stemOf(inputs[0].name) : "mesh");
    return {
      call, options, ...(inputs ? { inputs } : { surface: input as Surface }),
      ...(output ? { arrays: true } : {}), ...(output?.format ? { output: name + output.format } : {}),
    };
  }

  /** Fills a surface with tetrahedra and keeps every triangle. Throws HoldfastError, for an invalid surface with its
   * defects. */
  mesh(input: SurfaceInput, options: MeshOptions & Output = {}, watch?: Watch): MeshResult {
    const { format, name, ...rest } = options;
    const answer = this.done(this.surfaceRequest("mesh", input, rest, { format, name }), watch);
    return { volume: volumeOf(answer), files: answer.files, report: answer.response };
  }

  /** Every broken rule of a surface. */
  diagnose(input: SurfaceInput, options: DiagnoseOptions = {}, watch?: Watch): Diagnosis {
    const { response } = this.done(this.surfaceRequest("diagnose", input, options), watch);
    return { valid: response.valid as boolean, defects: response.defects as Defect[], report: response };
  }

  /** Makes a valid surface out of any. */
  repair(input: SurfaceInput, options: RepairOptions & Output = {}, watch?: Watch): RepairResult {
    const { format, name, ...rest } = options;
    const answer = this.done(this.surfaceRequest("repair", input, rest, { format, name }), watch);
    return { surface: surfaceOf(answer), files: answer.files, report: answer.response };
  }

  /** Whether a volume keeps a surface, exactly. One of the two may be arrays, or both files. */
  check(input: SurfaceInput, volume: VolumeInput, options: CheckOptions = {}, watch?: Watch): Check {
    // The arrays of both would have the same names, so those of the volume go as a file, which keeps every bit.
    const asFile = filesOf(input) || filesOf(volume) ? volume : this.writeVolume(volume as Volume, { format: ".vtu", name: "volume" });
    const { response } = this.done({ ...this.surfaceRequest("check", input, options), volume: asFile }, watch);
    return { holds: response.holds as boolean, rules: response.rules as Check["rules"] };
  }

  readSurface(files: NamedBytes | NamedBytes[], options: Limits = {}, watch?: Watch): Surface {
    return surfaceOf(this.done(this.surfaceRequest("surface", files, options, {}), watch));
  }

  /** The first file is that of the surface, others are those that its format has beside it. */
  writeSurface(input: SurfaceInput, output: { format: string; name?: string } & Limits, watch?: Watch): NamedBytes[] {
    const { format, name, ...limits } = output;
    return this.done({ ...this.surfaceRequest("surface", input, limits, { format, name }), arrays: false }, watch).files;
  }

  readVolume(files: NamedBytes | NamedBytes[], options: Limits = {}, watch?: Watch): Volume {
    return volumeOf(this.done({ call: "volume", volume: files, options, arrays: true }, watch));
  }

  writeVolume(input: VolumeInput, output: { format: string; name?: string } & Limits, watch?: Watch): NamedBytes[] {
    const { format, name = "mesh", ...limits } = output;
    return this.done({ call: "volume", volume: input, options: limits, output: name + format }, watch).files;
  }

  about(): About {
    const { response } = this.done({ call: "about" });
    return {
      version: response.version as string, volumeFormats: response.volume_formats as string[],
      readableVolumeFormats: response.readable_volume_formats as string[], surfaceFormats: response.surface_formats as string[],
    };
  }
}
