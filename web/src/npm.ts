// Holdfast fills any triangulated surface with tetrahedra and keeps every input triangle.
//
// `load` gives the library in this thread, `startWorker` in a Worker of its own, where calls do not stop a page and can
// be ended at once. Both work in browsers and in Node.
import factory from "holdfast-module";
import { HoldfastWorker, type Port } from "./client";
import { Holdfast, type Factory } from "./core";
import type { FromWorker, ToWorker } from "./serve";

export { Holdfast, HoldfastError, type Answer, type ErrorCode, type Request, type Response } from "./core";
export { HoldfastWorker, type CallWatch } from "./client";
export type * from "./types";

export interface LoadOptions {
  /** The bytes of holdfast.wasm; without, they are read from beside this module. */
  wasm?: Uint8Array;
}

const isNode = typeof process !== "undefined" && process.versions?.node !== undefined;

async function wasmBytes({ wasm }: LoadOptions): Promise<Uint8Array> {
  if (wasm) return wasm;
  const url = new URL("./holdfast.wasm", import.meta.url);
  if (isNode) return new Uint8Array(await (await import("node:fs/promises")).readFile(url));
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  return new Uint8Array(await response.arrayBuffer());
}

/** The library in this thread: a call occupies it until it is done. */
export async function load(options: LoadOptions = {}): Promise<Holdfast> {
  return Holdfast.of(factory as Factory, await wasmBytes(options));
}

async function spawn(onMessage: (message: FromWorker) => void, onError: (text: string) => void): Promise<Port> {
  const url = new URL("./worker.js", import.meta.url);
  if (isNode) {
    const worker = new (await import("node:worker_threads")).Worker(url);
    worker.on("message", (message: FromWorker) => {
      if (!("share" in message)) worker.unref(); // one that waits for calls does not keep the program running
      onMessage(message);
    });
    worker.on("error", (error: Error) => onError(error.message));
    return {
      post: (message: ToWorker) => {
        worker.ref();
        worker.postMessage(message);
      },
      terminate: () => void worker.terminate(),
    };
  }
  const worker = new Worker(url, { type: "module" });
  worker.onmessage = ({ data }) => onMessage(data);
  worker.onerror = (event) => onError(event.message);
  return { post: (message) => worker.postMessage(message), terminate: () => worker.terminate() };
}

/** The library in a Worker. Start several to make calls side by side. */
export function startWorker(options: LoadOptions = {}): HoldfastWorker {
  return new HoldfastWorker(spawn, () => wasmBytes(options));
}
