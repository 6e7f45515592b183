// The page that meshes: a file in, what is wrong with it, a mesh out. Everything stays in this browser.
import { decodeBase64, inflate } from "../../viewer/src/container";
import { HoldfastWorker, type Port } from "./client";
import { HoldfastError, type Answer, type Request } from "./core";
import { meshOf, surfaceNames, volumeNames } from "./arrays";
import type { FromWorker } from "./serve";
import type { Check, Defect, NamedBytes, Surface, Volume } from "./types";

const byId = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;
const named = <T extends HTMLElement>(name: string) => document.querySelector(`[name="${name}"]`) as T;
const mostListed = 500;

class App {
  private files: NamedBytes[] = [];
  private repaired: Surface | undefined; // of the files, instead of them
  private volume: Volume | undefined;
  private output: NamedBytes | undefined;
  private taking: Promise<void> = Promise.resolve();
  private urls: string[] = [];
  private turn = 0; // of what was asked for last: what came before it is not shown

  constructor(private readonly holdfast: HoldfastWorker) {
    const input = named<HTMLInputElement>("file"), drop = byId("drop");
    input.addEventListener("change", () => this.take([...(input.files ?? [])]));
    document.addEventListener("dragover", (event) => {
      event.preventDefault();
      drop.classList.add("over");
    });
    document.addEventListener("dragleave", () => drop.classList.remove("over"));
    document.addEventListener("drop", (event) => {
      event.preventDefault();
      drop.classList.remove("over");
      this.take([...(event.dataTransfer?.files ?? [])]);
    });
    document.querySelector("form")!.addEventListener("submit", (event) => event.preventDefault());
    for (const [name, action] of [["mesh", () => this.mesh()], ["repair", () => this.repair()], ["check", () => this.check()]] as const)
      named(name).addEventListener("click", () => void this.taking.then(action));
    named("cancel").addEventListener("click", () => this.holdfast.cancel());
    named("download").addEventListener("click", () => this.output && this.save(this.output));
    named("fill").addEventListener("change", () => this.enable(false));
    named("format").addEventListener("change", () => void this.write());
    this.enable(false);
  }

  private enable(busy: boolean): void {
    const set = (name: string, is: boolean) => void (named<HTMLButtonElement>(name).disabled = !is);
    set("mesh", this.files.length > 0);
    set("repair", this.files.length > 0);
    set("check", this.volume !== undefined);
    set("cancel", busy);
    set("download", this.output !== undefined);
    const fill = named<HTMLInputElement>("fill").checked;
    for (const name of ["size", "gradation", "quality"]) set(name, !fill);
    byId("progress").hidden = !busy;
  }

  private tell(text: string, bad = false): void {
    byId("message").textContent = text;
    byId("message").className = bad ? "bad" : "";
  }

  /// Files that were chosen or dropped.
  private take(list: File[]): void {
    if (list.length === 0) return;
    this.files = list.map((file) => ({ name: file.name, bytes: new Uint8Array() }));
    this.repaired = undefined;
    byId("chosen").textContent = list.map((file) => file.name).join(", ");
    this.clear();
    this.taking = Promise.all(list.map(async (file) => ({ name: file.name, bytes: new Uint8Array(await file.arrayBuffer()) }))).then(
      (files) => void (this.files = files), (error) => this.tell(`The file cannot be read: ${String(error)}`, true));
    void this.taking.then(() => this.diagnose());
  }

  private clear(): void {
    for (const url of this.urls.splice(0)) URL.revokeObjectURL(url);
    this.volume = this.output = undefined;
    named("download").textContent = "Download";
    byId("more").replaceChildren();
    byId("look").replaceChildren();
    byId("defects").replaceChildren();
    byId("defects").hidden = true;
    this.enable(false);
  }

  private stem(): string {
    return (this.files[0]?.name ?? "mesh").replace(/\.gz$/i, "").replace(/(.)\.[^.]*$/, "$1");
  }

  /// Makes a call instead of the one that runs, and gives its answer to `show` unless another one came after it.
  private async run<T>(what: string, call: (watch: { progress: (share: number, stage: string) => void }) => Promise<T>, show: (answer: T) => void): Promise<void> {
    const turn = ++this.turn, bar = byId<HTMLProgressElement>("bar"), started = Date.now();
    this.holdfast.cancel();
    this.tell(`${what} …`);
    bar.value = 0;
    byId("stage").textContent = "";
    this.enable(true);
    const progress = (share: number, stage: string) => {
      if (turn !== this.turn) return;
      bar.value = share;
      byId("stage").textContent = `${stage} ${Math.round(100 * share)} %, ${Math.round((Date.now() - started) / 1000)} s`;
    };
    try {
      const answer = await call({ progress });
      if (turn === this.turn) show(answer);
    } catch (error) {
      if (turn === this.turn) this.tell(this.why(error as Error), true);
    }
    if (turn === this.turn) this.enable(false);
  }

  private why(error: Error): string {
    if (!(error instanceof HoldfastError)) return String(error);
    const needsMore = ["memory_limit", "out_of_memory", "stopped"].includes(error.code);
    return needsMore ? `${error.message}; allow more memory (up to 4000 MiB), or use the program` : error.message;
  }

  private request(call: string, options: object, format = ""): Request {
    const limit = Number(named<HTMLInputElement>("memory").value);
    return {
      call, options: { ...options, ...(limit > 0 ? { memoryLimit: Math.round(limit * 2 ** 20) } : {}) },
      ...(this.repaired ? { surface: this.repaired } : { inputs: this.files }),
      ...(format ? { arrays: true, output: this.stem() + (call === "repair" ? "-repaired" : "") + format } : {}),
      page: this.files.map((file) => file.name).join(", "),
    };
  }

  private ask(call: string, what: string, options: object, format: string, show: (answer: Answer) => void): Promise<void> {
    return this.run(what, (watch) => this.holdfast.run(this.request(call, options, format), watch), (answer) => {
      this.look(answer.page);
      this.list((answer.response.defects ?? []) as Defect[]);
      if (answer.response.outcome === "done") return show(answer);
      this.tell(this.why(new HoldfastError(answer.response.outcome as "cancelled", answer.response.message ?? answer.response.outcome)), true);
    });
  }

  private list(defects: Defect[]): void {
    const lines = defects.slice(0, mostListed).map((defect) => `${defect.name}: ${defect.message}`);
    if (defects.length > mostListed) lines.push(`and ${defects.length - mostListed} more, which the viewer below lists`);
    byId("defects").replaceChildren(...lines.map((line) => {
      const item = document.createElement("li");
      item.textContent = line;
      return item;
    }));
    byId("defects").hidden = lines.length === 0;
  }

  private url(bytes: Uint8Array, type: string): string {
    const url = URL.createObjectURL(new Blob([bytes as BlobPart], { type }));
    this.urls.push(url);
    return url;
  }

  private save(file: NamedBytes): void {
    const link = document.createElement("a");
    link.href = this.url(file.bytes, "application/octet-stream");
    link.download = file.name;
    link.click();
  }

  private offerMore(file: NamedBytes, label: string): void {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = label;
    button.addEventListener("click", () => this.save(file));
    byId("more").append(button, " ");
  }

  private offer(files: NamedBytes[]): void {
    const [first, ...others] = files;
    this.output = first;
    named("download").textContent = `Download ${first.name}`;
    byId("more").replaceChildren();
    for (const file of others) this.offerMore(file, `Also ${file.name}`);
  }

  private look(page: Uint8Array | undefined): void {
    if (!page) return;
    const frame = document.createElement("iframe");
    frame.title = "The viewer";
    frame.allow = "clipboard-write";
    frame.src = this.url(page, "text/html");
    byId("look").replaceChildren(frame);
  }

  private diagnose(): Promise<void> {
    this.clear();
    return this.ask("diagnose", "Looking at the surface", {}, "", ({ response }) => {
      const { valid, triangles, vertices, defects } = response as unknown as { valid: boolean; triangles: number; vertices: number; defects: unknown[] };
      const counts = `${triangles} triangles, ${vertices} vertices`;
      if (valid) this.tell(`The surface is valid: ${counts}.`);
      else this.tell(`The surface is not valid: ${counts}, ${defects.length} ${defects.length === 1 ? "defect" : "defects"}. Repair it, or see what is wrong.`, true);
    });
  }

  private repair(): Promise<void> {
    this.repaired = undefined;
    this.clear();
    const weld = Number(named<HTMLInputElement>("weld").value), format = named<HTMLSelectElement>("surface-format").value;
    const options = {
      ...(weld > 0 ? { weld } : {}), union: named<HTMLInputElement>("union").checked,
      fillHoles: named<HTMLInputElement>("holes").checked,
    };
    return this.ask("repair", "Repairing", options, format, (answer) => {
      this.repaired = meshOf(answer, surfaceNames) as unknown as Surface;
      this.offer(answer.files);
      this.tell("Repaired. Mesh it, or download the surface.");
    });
  }

  private mesh(): Promise<void> {
    this.clear();
    const value = (name: string) => named<HTMLInputElement>(name).value, fill = named<HTMLInputElement>("fill").checked;
    const options: Record<string, unknown> = { fill, keep: value("keep") };
    if (!fill) {
      options.quality = value("quality");
      if (Number(value("size")) > 0) options.size = Number(value("size"));
      if (value("gradation") !== "") options.gradation = Number(value("gradation"));
    }
    return this.ask("mesh", "Meshing", options, value("format"), (answer) => {
      this.volume = meshOf(answer, volumeNames) as unknown as Volume;
      this.offer(answer.files);
      this.tell(`${this.volume.tetrahedra.length / 4} tetrahedra, ${this.volume.vertices.length / 3} vertices.`);
    });
  }

  /// Another format of the mesh that there is.
  private async write(): Promise<void> {
    const { volume } = this;
    if (!volume) return;
    this.output = undefined;
    await this.run("Writing", (watch) => this.holdfast.writeVolume(volume, { format: named<HTMLSelectElement>("format").value, name: this.stem() }, watch), (files) => {
      this.offer(files);
      this.tell("Written.");
    });
  }

  private async check(): Promise<void> {
    const { volume } = this;
    if (!volume) return;
    const options = named<HTMLSelectElement>("keep").value === "box" ? { box: true } : {};
    await this.run("Checking", (watch) => this.holdfast.check(this.repaired ?? this.files, volume, options, watch), ({ holds, rules }: Check) => {
      const lines = rules.map((rule) => `${rule.holds ? "holds" : "is broken"}: ${rule.name} (${rule.detail})`);
      this.tell(`${holds ? "The mesh keeps the surface." : "The mesh does not keep the surface."}\n${lines.join("\n")}`, !holds);
    });
  }
}

async function start(): Promise<void> {
  const text = (id: string) => {
    const { textContent } = byId(id);
    byId(id).textContent = "";
    return textContent ?? "";
  };
  try {
    const wasm = await inflate(await decodeBase64(text("wasm")));
    const script = URL.createObjectURL(new Blob([await inflate(await decodeBase64(text("worker"))) as BlobPart], { type: "text/javascript" }));
    const spawn = (onMessage: (message: FromWorker) => void, onError: (text: string) => void): Port => {
      const worker = new Worker(script);
      worker.onmessage = ({ data }) => onMessage(data);
      worker.onerror = (event) => onError(event.message);
      return { post: (message) => worker.postMessage(message), terminate: () => worker.terminate() };
    };
    new App(new HoldfastWorker(spawn, async () => wasm));
    document.documentElement.dataset.ready = "yes";
  } catch (error) {
    byId("message").textContent = `This browser cannot run the mesher: ${String(error)}`;
    document.documentElement.dataset.ready = "failed";
  }
}

void start();
