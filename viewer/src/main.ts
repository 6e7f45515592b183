// The page: reads its data, ties controls to the picture, and keeps what is seen in the address.
import { Orbit } from "./camera";
import { paletteOf, type Palette } from "./colours";
import { decodeBase64, inflate, readPage, type PageData } from "./container";
import { Controls } from "./controls";
import { focusOnElement, focusOnEntry, type Focus } from "./focus";
import { element, fillBars, fillLegend, fillWorst } from "./lists";
import { measure, type Measures } from "./measure";
import { prepare, type Mesh } from "./mesh";
import { pick, tell, tellTetrahedron } from "./pick";
import { View } from "./scene";
import { ghostOf, show, type Shown, type Triangles } from "./shown";
import { fromAddress, initial, toAddress, type State } from "./state";

const byId = <T extends HTMLElement>(id: string) => document.getElementById(id) as T;

class Page {
  readonly orbit = new Orbit();
  readonly view: View;
  readonly controls: Controls;
  state: State;
  usual: State = initial();
  private ready = new Map<number, { mesh: Mesh; measures: Measures; palette: Palette; ghost: Triangles | null }>();
  shown: Shown | null = null;
  private saving = 0;
  private loading = 0;

  constructor(readonly data: PageData) {
    this.view = new View(byId<HTMLCanvasElement>("canvas"), this.orbit);
    const first = data.parts[0];
    if (first?.kind === "volume" && new Set(first.regions).size > 1) this.usual.colour = "region";
    // A page with defects opens on the surface that has them.
    if (data.entries.length && data.parts[data.entries[0].part]?.kind === "surface") {
      this.usual.model = data.entries[0].part;
      this.usual.tab = "defects";
    }
    this.state = fromAddress(location.hash, this.usual);
    if (!data.parts[this.state.model]) this.state.model = 0;
    this.controls = new Controls(this);
    this.orbit.changed = () => {
      this.view.draw();
      this.save();
    };
    if (this.state.view.length) this.orbit.write(this.state.view);
  }

  get current() {
    return this.ready.get(this.state.model);
  }

  status(text: string): void {
    byId("status").textContent = text;
  }

  /// Makes the part that is chosen ready, then draws it.
  async load(): Promise<void> {
    const turn = ++this.loading, model = this.state.model;
    if (!this.ready.has(model)) {
      document.documentElement.dataset.ready = "";
      this.status("Looking for neighbours …");
      const mesh = await prepare(this.data.parts[model]);
      const measures = await measure(mesh, (share) => this.status(`Measuring elements, ${Math.round(100 * share)} % …`));
      this.ready.set(model, { mesh, measures, palette: paletteOf(mesh, measures), ghost: null });
    }
    if (turn !== this.loading) return;
    this.status("");
    const { mesh } = this.current!;
    this.view.setPoints(this.places(mesh, this.state.added ? mesh.pointsAdded : new Uint32Array(0)));
    this.setSegments(mesh);
    // As near as a ball round the part fits into the window.
    this.orbit.whole = mesh.radius / Math.sin(Math.PI / 12);
    if (this.state.view.length === 0) {
      this.orbit.home();
      this.goToFocus(true);
    }
    this.refresh();
    document.documentElement.dataset.ready = "yes";
  }

  private places(mesh: Mesh, vertices: Uint32Array): Float32Array {
    const at = new Float32Array(3 * vertices.length);
    for (let i = 0; i < vertices.length; i++) at.set(mesh.positions.subarray(3 * vertices[i], 3 * vertices[i] + 3), 3 * i);
    return at;
  }

  private setSegments(mesh: Mesh): void {
    this.view.setSegments(this.state.segments ? this.places(mesh, mesh.part.segments) : new Float32Array(0));
  }

  /// Everything that a change of the controls may change.
  refresh(): void {
    const now = this.current;
    if (!now) return;
    const { state } = this, { mesh, measures, palette } = now;
    const shown = show(state, mesh, measures, palette);
    this.shown = shown;
    this.view.setPoints(this.places(mesh, state.added ? mesh.pointsAdded : new Uint32Array(0)));
    this.setSegments(mesh);
    this.view.setSolid(shown.solid, shown.cap, shown.dangling, shown.plane, state.cap === "flat");
    this.view.setEdges(state.edges);
    fillLegend(byId("legend"), state, mesh, palette, () => this.changed());
    const elements = mesh.part.tetrahedra.length > 0;
    if (state.tab === "elements" && elements) {
      fillBars(byId("bars"), state, palette, () => this.changed());
      fillWorst(byId("worst"), state, mesh, measures, (t) => this.goToElement(t));
    }
    const part = mesh.part;
    const of = part.kind === "volume"
      ? `${shown.tetrahedra} of ${part.tetrahedra.length / 4} tetrahedra shown; ${part.facets.length / 3} triangles, ${part.vertices.length / 3} points, ${mesh.pointsAdded.length} ${mesh.addedIsKnown ? "of them added" : "on no triangle"}`
      : `${part.facets.length / 3} triangles, ${part.segments.length / 2} segments, ${part.vertices.length / 3} points`;
    byId("counts").textContent = part.note ? `${of}. ${part.note}` : of;
    this.setFocus();
    this.controls.write();
    this.save();
    this.view.draw();
  }

  changed(): void {
    this.refresh();
  }

  private focus(): Focus | null {
    const now = this.current, { entry, element: tet, model } = this.state;
    if (!now) return null;
    if (entry >= 0 && this.data.entries[entry]?.part === model) return focusOnEntry(now.mesh, this.data.entries[entry]);
    if (tet >= 0 && 4 * tet < now.mesh.part.tetrahedra.length) return focusOnElement(now.mesh, tet);
    return null;
  }

  private setFocus(): void {
    const now = this.current!, focus = this.focus(), none = new Float32Array(0);
    const some = this.state.bars.length > 0 || this.state.hidden.length > 0;
    const ghost = this.state.ghost && (focus !== null || some);
    if (ghost) now.ghost ??= ghostOf(now.mesh);
    this.view.setGhost(ghost ? now.ghost : null);
    this.view.setOver(focus?.over ?? null, focus?.lines ?? none, focus?.points ?? none, focus?.halo ?? none, focus !== null && this.state.ghost);
  }

  private goToFocus(move: boolean): void {
    const focus = this.focus();
    if (!focus || !move) return;
    this.orbit.target.set(...focus.centre);
    this.orbit.distance = Math.min(this.orbit.whole, Math.max(1e-5, focus.radius * 5));
  }

  goToElement(tet: number): void {
    this.state.element = tet;
    this.state.entry = -1;
    this.goToFocus(true);
    this.showPicked(tellTetrahedron(this.current!.mesh, tet).join("\n"));
    this.refresh();
  }

  async goToEntry(entry: number): Promise<void> {
    if (!this.data.entries[entry]) return;
    this.state.entry = entry;
    this.state.element = -1;
    const other = this.data.entries[entry].part;
    if (other !== this.state.model) {
      this.state.model = other;
      this.state.view = [];
      await this.load();
    }
    this.goToFocus(true);
    this.refresh();
  }

  leave(): void {
    this.state.entry = this.state.element = -1;
    this.orbit.home();
    this.hidePicked();
    this.refresh();
  }

  pickAt(x: number, y: number): void {
    const now = this.current, { canvas } = this.view;
    if (!now || !this.shown) return;
    const hit = pick(this.orbit, this.shown, this.state.cap === "flat", x, y, canvas.clientWidth, canvas.clientHeight);
    if (hit) this.showPicked(tell(now.mesh, hit.source));
    else this.hidePicked();
  }

  showPicked(text: string): void {
    byId("picked-text").textContent = text;
    byId("picked").hidden = false;
  }

  hidePicked(): void {
    byId("picked").hidden = true;
    byId("picked-text").textContent = "";
  }

  /// Writes the address, not more than a few times a second.
  save(): void {
    this.state.view = this.orbit.read();
    if (this.saving) return;
    this.saving = window.setTimeout(() => {
      this.saving = 0;
      try {
        history.replaceState(null, "", `#${toAddress(this.state, this.usual)}`);
      } catch {
        // Some browsers let no page from a file do so; then the address stays as it was.
      }
    }, 250);
  }

  /// The page as an address says.
  async go(address: string): Promise<void> {
    this.state = fromAddress(address, this.usual);
    if (!this.data.parts[this.state.model]) this.state.model = 0;
    if (this.state.view.length) this.orbit.write(this.state.view);
    else this.orbit.home();
    await this.load();
  }
}

export type { Page };

async function start(): Promise<void> {
  const status = byId("status"), holder = byId("data");
  try {
    const text = holder.textContent ?? "";
    holder.textContent = "";
    if (text.trim() === "") throw new Error("this page has no data");
    const began = performance.now();
    const page = new Page(await readPage(await inflate(await decodeBase64(text))));
    (window as unknown as { holdfastPage: Page }).holdfastPage = page;
    await page.load();
    document.documentElement.dataset.seconds = ((performance.now() - began) / 1000).toFixed(2);
    window.addEventListener("hashchange", () => void page.go(location.hash));
  } catch (error) {
    status.replaceChildren(element("span", `This page cannot be shown: ${error instanceof Error ? error.message : String(error)}. A browser with WebGL 2 is needed.`));
    document.documentElement.dataset.ready = "failed";
  }
}

void start();
