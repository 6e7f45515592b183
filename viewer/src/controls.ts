// The controls: HTML elements whose names are those of the state's fields.
import { Vector3 } from "three";
import type { Page } from "./main";
import type { Axis, Colour, State } from "./state";

const named = <T extends Element>(name: string) => document.querySelector(`[name="${name}"]`) as T;
const checks = ["cut", "flip", "surface", "elements", "edges", "added", "dangling", "segments", "ghost"] as const;
const selects = ["axis", "cap", "wheel", "colour", "histogram", "worst", "theme"] as const;
const numbers = ["nx", "ny", "nz"] as const;
const tabs = ["view", "elements", "defects", "verdict", "report", "help"] as const;

export class Controls {
  private media = window.matchMedia("(prefers-color-scheme: dark)");

  constructor(private page: Page) {
    const model = named<HTMLSelectElement>("model");
    page.data.parts.forEach((part, i) => model.add(new Option(part.name, String(i))));
    model.addEventListener("change", () => {
      const { state } = page;
      Object.assign(state, { model: Number(model.value), entry: -1, element: -1, bars: [], hidden: [] });
      void page.load();
    });
    for (const name of checks)
      named<HTMLInputElement>(name).addEventListener("change", (event) => {
        page.state[name] = (event.target as HTMLInputElement).checked;
        page.changed();
      });
    for (const name of selects)
      named<HTMLSelectElement>(name).addEventListener("change", (event) => {
        (page.state as unknown as Record<string, string>)[name] = (event.target as HTMLSelectElement).value;
        if (name === "histogram") page.state.bars = [];
        if (name === "axis") page.state.cut = true;
        page.changed();
      });
    for (const name of numbers)
      named<HTMLInputElement>(name).addEventListener("change", (event) => {
        const value = Number((event.target as HTMLInputElement).value);
        if (Number.isFinite(value)) page.state[name] = value;
        page.changed();
      });
    const position = named<HTMLInputElement>("position");
    position.addEventListener("input", () => {
      page.state.position = Number(position.value);
      page.state.cut = true;
      page.changed();
    });
    position.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.drag(Math.sign(event.deltaY));
    }, { passive: false });
    const press = (name: string, action: () => void) => named<HTMLButtonElement>(name).addEventListener("click", action);
    press("facing", () => this.facing());
    press("clear", () => {
      Object.assign(page.state, { bars: [], hidden: [] });
      page.changed();
    });
    press("reset", () => page.leave());
    press("leave", () => page.leave());
    press("next", () => this.step(1));
    press("previous", () => this.step(-1));
    press("png", () => void this.save());
    press("copy", () => void this.copy());
    press("unpick", () => page.hidePicked());
    for (const tab of tabs)
      press(`tab-${tab}`, () => {
        page.state.tab = tab;
        page.changed();
      });
    document.addEventListener("click", (event) => {
      const button = (event.target as Element).closest?.("button[data-entry]");
      if (button) void page.goToEntry(Number(button.getAttribute("data-entry")));
    });
    document.addEventListener("submit", (event) => event.preventDefault());
    document.addEventListener("keydown", (event) => this.key(event));
    this.media.addEventListener("change", () => this.write());
    page.orbit.listen(page.view.canvas,
      (steps, shift) => {
        if (!shift && page.state.wheel !== "plane") return false;
        this.drag(steps);
        return true;
      },
      (x, y) => page.pickAt(x, y));
    this.write();
  }

  /// The controls as the state is.
  write(): void {
    const { state, data } = this.page;
    named<HTMLSelectElement>("model").value = String(state.model);
    for (const name of checks) named<HTMLInputElement>(name).checked = state[name];
    for (const name of selects) named<HTMLSelectElement>(name).value = state[name];
    for (const name of numbers) named<HTMLInputElement>(name).value = String(state[name]);
    named<HTMLInputElement>("position").value = String(state.position);
    (document.getElementById("free") as HTMLElement).hidden = state.axis !== "free";
    const volume = data.parts[state.model]?.kind === "volume";
    for (const name of ["elements", "added", "dangling"]) named<HTMLInputElement>(name).disabled = !volume;
    for (const option of named<HTMLSelectElement>("colour").options)
      option.disabled = !volume && !["plain", "marker"].includes(option.value);
    for (const tab of tabs) {
      const on = state.tab === tab;
      named<HTMLButtonElement>(`tab-${tab}`).setAttribute("aria-selected", String(on));
      (document.getElementById(`tab-${tab}`) as HTMLElement).hidden = !on;
    }
    for (const button of document.querySelectorAll("button[aria-current][data-entry]")) button.removeAttribute("aria-current");
    if (state.entry >= 0) document.querySelector(`button[data-entry="${state.entry}"]`)?.setAttribute("aria-current", "true");
    const dark = state.theme === "dark" || (state.theme === "auto" && this.media.matches);
    document.documentElement.dataset.theme = dark ? "dark" : "light";
    this.page.view.setBackground(dark ? "#0e1216" : "#eef1f5");
  }

  /// The plane goes a hundredth of the part a step.
  drag(steps: number): void {
    const { state } = this.page;
    state.position = Math.min(1, Math.max(0, Math.round((state.position + steps / 100) * 1000) / 1000));
    state.cut = true;
    this.page.changed();
  }

  private facing(): void {
    const { state, orbit } = this.page, n: Vector3 = orbit.direction();
    Object.assign(state, { axis: "free", cut: true, nx: n.x, ny: n.y, nz: n.z });
    this.page.changed();
  }

  private step(by: number): void {
    const { data, state } = this.page, count = data.entries.length;
    if (count) void this.page.goToEntry((state.entry + by + count + (state.entry < 0 && by < 0 ? 1 : 0)) % count);
  }

  private async save(): Promise<void> {
    const blob = await this.page.view.picture();
    if (!blob) return;
    const link = document.createElement("a");
    link.href = URL.createObjectURL(blob);
    link.download = "holdfast.png";
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  }

  private async copy(): Promise<void> {
    const text = document.getElementById("picked-text") as HTMLElement;
    try {
      await navigator.clipboard.writeText(text.textContent ?? "");
    } catch {
      const selection = window.getSelection();
      selection?.selectAllChildren(text);
      document.execCommand("copy");
    }
  }

  private key(event: KeyboardEvent): void {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey || target.matches("input:not([type=checkbox]), select, textarea")) return;
    const { page } = this, { state } = page;
    const flip = (name: (typeof checks)[number]) => () => {
      state[name] = !state[name];
      page.changed();
    };
    const axis = (name: Axis) => () => {
      Object.assign(state, { axis: name, cut: true });
      page.changed();
    };
    const colours: Colour[] = ["plain", "region", "marker", "angle", "q", "size", "forced"];
    const actions: Record<string, () => void> = {
      c: flip("cut"), f: flip("flip"), s: flip("surface"), e: flip("edges"), a: flip("added"), d: flip("dangling"), g: flip("ghost"),
      x: axis("x"), y: axis("y"), z: axis("z"),
      k: () => {
        state.cap = state.cap === "flat" ? "crinkle" : "flat";
        page.changed();
      },
      "[": () => this.drag(-1), "]": () => this.drag(1),
      n: () => this.step(1), p: () => this.step(-1), r: () => page.leave(), Escape: () => page.leave(),
      ArrowLeft: () => page.orbit.rotate(-0.1, 0), ArrowRight: () => page.orbit.rotate(0.1, 0),
      ArrowUp: () => page.orbit.rotate(0, -0.1), ArrowDown: () => page.orbit.rotate(0, 0.1),
      "+": () => page.orbit.zoom(1 / 1.15), "-": () => page.orbit.zoom(1.15),
    };
    colours.forEach((colour, i) => {
      actions[String(i + 1)] = () => {
        state.colour = colour;
        page.changed();
      };
    });
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }
}

export type { State };
