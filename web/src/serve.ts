// The side of a Worker: takes calls as messages and answers them.
import { Holdfast, HoldfastError, type Factory } from "./core";

export interface Call {
  id: number;
  method: string;
  args: unknown[];
  cancel?: Int32Array;
}
export type ToWorker = { wasm: Uint8Array } | Call;
export type FromWorker =
  | { ready: true }
  | { id: number; share: number; stage: string }
  | { id: number; result: unknown }
  | { id?: number; error: { code: string; message: string; defects: unknown[]; file: string; where: string; report: object } };

export const methods = ["run", "mesh", "diagnose", "repair", "check", "readSurface", "writeSurface", "readVolume", "writeVolume", "about"] as const;

/// Buffers of arrays in a result, which need not be copied.
function buffersOf(value: unknown, found = new Set<ArrayBuffer>()): ArrayBuffer[] {
  if (ArrayBuffer.isView(value)) {
    if (value.buffer instanceof ArrayBuffer) found.add(value.buffer);
  } else if (Array.isArray(value)) {
    for (const of of value) if (typeof of === "object") buffersOf(of, found);
  } else if (typeof value === "object" && value !== null) {
    for (const [key, of] of Object.entries(value)) if (key !== "report" && key !== "response") buffersOf(of, found);
  }
  return [...found];
}

export function serve(factory: Factory, post: (message: FromWorker, moved?: ArrayBuffer[]) => void): (message: ToWorker) => Promise<void> {
  let holdfast: Holdfast | undefined;
  return async (message) => {
    const id = "id" in message ? message.id : undefined;
    try {
      if ("wasm" in message) {
        holdfast = await Holdfast.of(factory, message.wasm);
        return post({ ready: true });
      }
      if (!(methods as readonly string[]).includes(message.method) || !holdfast) throw new HoldfastError("bad_argument", `there is no call '${message.method}'`);
      const watch = { progress: (share: number, stage: string) => post({ id: message.id, share, stage }), cancel: message.cancel };
      const call = holdfast[message.method as "mesh"] as (...args: unknown[]) => unknown;
      const result = call.apply(holdfast, message.method === "about" ? [] : [...message.args, watch]);
      post({ id: message.id, result }, buffersOf(result));
    } catch (error) {
      const { code = "internal_error", defects = [], file = "", where = "", report = {} } = error as Partial<HoldfastError>;
      post({ id, error: { code, message: error instanceof Error ? error.message : String(error), defects, file, where, report } });
    }
  };
}
