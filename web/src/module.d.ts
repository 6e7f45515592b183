// What the build puts together (web/build.mjs), and what of Node is used.
declare module "holdfast-module" {
  const factory: unknown;
  export default factory;
}
declare const process: { versions?: { node?: string } } | undefined;
declare module "node:fs/promises" {
  export function readFile(url: URL): Promise<ArrayBuffer>;
}
declare module "node:worker_threads" {
  interface MessagePort {
    postMessage(message: unknown, moved?: ArrayBuffer[]): void;
    on(event: "message", take: (message: never) => void): void;
  }
  export const parentPort: MessagePort | null;
  export class Worker {
    constructor(url: URL);
    postMessage(message: unknown): void;
    on(event: "message", take: (message: never) => void): void;
    on(event: "error", take: (error: Error) => void): void;
    ref(): void;
    unref(): void;
    terminate(): Promise<number>;
  }
}
