// The other side: calls that a Worker makes, one after the other. Ending the Worker ends a call at once.
import { HoldfastError, type Answer, type ErrorCode, type Request } from "./core";
import type { Call, FromWorker, ToWorker } from "./serve";
import type {
  About, Check, CheckOptions, Defect, Diagnosis, DiagnoseOptions, Limits, MeshOptions, MeshResult, NamedBytes, Output, RepairOptions,
  RepairResult, Surface, SurfaceInput, Volume, VolumeInput,
} from "./types";

/** A Worker, whatever kind the place has. */
export interface Port {
  post(message: ToWorker): void;
  terminate(): void;
}
export type Spawn = (onMessage: (message: FromWorker) => void, onError: (text: string) => void) => Promise<Port> | Port;

export interface CallWatch {
  progress?: (share: number, stage: string) => void;
  /** Ends the call, wherever it is: the Worker is ended, and the next call starts another one. */
  signal?: AbortSignal;
}

interface Waiting {
  call: Omit<Call, "id">;
  watch: CallWatch;
  resolve: (result: never) => void;
  reject: (error: Error) => void;
}

const cancelled = () => new HoldfastError("cancelled", "cancelled");

export class HoldfastWorker {
  private port: Promise<Port> | undefined;
  private running: (Waiting & { id: number }) | undefined;
  private queue: Waiting[] = [];
  private count = 0;

  constructor(private readonly spawn: Spawn, private readonly wasm: () => Promise<Uint8Array>) {}

  mesh(input: SurfaceInput, options: MeshOptions & Output = {}, watch?: CallWatch): Promise<MeshResult> {
    return this.call("mesh", [input, options], watch);
  }
  diagnose(input: SurfaceInput, options: DiagnoseOptions = {}, watch?: CallWatch): Promise<Diagnosis> {
    return this.call("diagnose", [input, options], watch);
  }
  repair(input: SurfaceInput, options: RepairOptions & Output = {}, watch?: CallWatch): Promise<RepairResult> {
    return this.call("repair", [input, options], watch);
  }
  check(input: SurfaceInput, volume: VolumeInput, options: CheckOptions = {}, watch?: CallWatch): Promise<Check> {
    return this.call("check", [input, volume, options], watch);
  }
  readSurface(files: NamedBytes | NamedBytes[], options: Limits = {}, watch?: CallWatch): Promise<Surface> {
    return this.call("readSurface", [files, options], watch);
  }
  writeSurface(input: SurfaceInput, output: { format: string; name?: string } & Limits, watch?: CallWatch): Promise<NamedBytes[]> {
    return this.call("writeSurface", [input, output], watch);
  }
  readVolume(files: NamedBytes | NamedBytes[], options: Limits = {}, watch?: CallWatch): Promise<Volume> {
    return this.call("readVolume", [files, options], watch);
  }
  writeVolume(input: VolumeInput, output: { format: string; name?: string } & Limits, watch?: CallWatch): Promise<NamedBytes[]> {
    return this.call("writeVolume", [input, output], watch);
  }
  about(watch?: CallWatch): Promise<About> {
    return this.call("about", [], watch);
  }
  /** See Holdfast.run. */
  run(request: Request, watch?: CallWatch): Promise<Answer> {
    return this.call("run", [request], watch);
  }

  /** Ends the call that runs, at once. */
  cancel(): void {
    if (this.running) this.end(cancelled());
  }
  /** Ends the Worker and all calls. */
  close(): void {
    for (const waiting of this.queue.splice(0)) waiting.reject(cancelled());
    this.end(cancelled());
  }

  private call<T>(method: string, args: unknown[], watch: CallWatch = {}): Promise<T> {
    return new Promise<T>((resolve, reject) => {
      const { signal } = watch;
      if (signal?.aborted) return reject(cancelled());
      const waiting: Waiting = { call: { method, args }, watch, resolve: resolve as (result: never) => void, reject };
      signal?.addEventListener("abort", () => {
        if (this.running?.resolve === waiting.resolve) return this.end(cancelled());
        const at = this.queue.indexOf(waiting);
        if (at >= 0) this.queue.splice(at, 1)[0].reject(cancelled());
      });
      this.queue.push(waiting);
      void this.next();
    });
  }

  private async next(): Promise<void> {
    if (this.running) return;
    const waiting = this.queue.shift();
    if (!waiting) return;
    const running = (this.running = { ...waiting, id: ++this.count });
    try {
      const port = await (this.port ??= this.start());
      if (this.running === running) port.post({ ...waiting.call, id: running.id });
    } catch (error) {
      if (this.running === running) this.end(error instanceof HoldfastError ? error : new HoldfastError("internal_error", String(error)));
    }
  }

  private async start(): Promise<Port> {
    const wasm = await this.wasm();
    let ready: () => void = () => {}, failed: (error: Error) => void = () => {};
    const started = new Promise<void>((resolve, reject) => ([ready, failed] = [resolve, reject]));
    const port = await this.spawn((message) => {
      if ("ready" in message) return ready();
      if (message.id === undefined && "error" in message) return failed(new HoldfastError("internal_error", message.error.message));
      this.take(message as Exclude<FromWorker, { ready: true }>);
    }, (text) => {
      const error = new HoldfastError("stopped", `the worker stopped: ${text}`);
      failed(error);
      this.end(error);
    });
    port.post({ wasm });
    try {
      await started;
    } catch (error) {
      port.terminate();
      throw error;
    }
    return port;
  }

  private take(message: Exclude<FromWorker, { ready: true }>): void {
    const { running } = this;
    if (!running || running.id !== message.id) return;
    if ("share" in message) return running.watch.progress?.(message.share, message.stage);
    if ("error" in message) {
      const { code, message: text, defects, file, where, report } = message.error;
      const error = new HoldfastError(code as ErrorCode, text, defects as Defect[], file, where, report as Record<string, unknown>);
      if (code === "stopped") return this.end(error); // the next call gets another module
      running.reject(error);
    } else running.resolve(message.result as never);
    this.running = undefined;
    void this.next();
  }

  private end(error: Error): void {
    const { port, running } = this;
    this.port = this.running = undefined;
    void port?.then((of) => of.terminate(), () => {});
    running?.reject(error);
    void this.next();
  }
}
