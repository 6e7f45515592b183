// The legend with its toggles, the histogram whose bars choose, and the list of the worst elements.
import { forcedKinds, number, type Kinds, type Palette, type Rgb } from "./colours";
import type { Measures } from "./measure";
import { numberOf } from "./pick";
import type { Mesh } from "./mesh";
import type { Quantity, State } from "./state";

const css = (c: Rgb) => `rgb(${c[0]} ${c[1]} ${c[2]})`;
const mostKinds = 300;

export function element<K extends keyof HTMLElementTagNameMap>(tag: K, text = "", name = ""): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  made.textContent = text;
  if (name) made.setAttribute("name", name);
  return made;
}

function swatch(colour: Rgb): HTMLElement {
  const made = element("i");
  made.style.background = css(colour);
  return made;
}

/// A row that switches a kind on or off: `word` is what State::hidden has of it.
function toggle(state: State, word: string, colour: Rgb, label: string, changed: () => void): HTMLElement {
  const row = element("label"), box = element("input", "", `show-${word}`);
  box.type = "checkbox";
  box.checked = !state.hidden.includes(word);
  box.addEventListener("change", () => {
    state.hidden = state.hidden.filter((w) => w !== word);
    if (!box.checked) state.hidden.push(word);
    changed();
  });
  row.append(box, swatch(colour), element("span", label));
  return row;
}

export function fillLegend(box: HTMLElement, state: State, mesh: Mesh, palette: Palette, changed: () => void): void {
  box.replaceChildren();
  const kinds = (of: Kinds, letter: string) => {
    for (const id of of.ids.slice(0, mostKinds))
      box.append(toggle(state, letter + id, of.colour.get(id)!, of.name(id), changed));
    if (of.ids.length > mostKinds) box.append(element("div", `and ${of.ids.length - mostKinds} more`));
  };
  const title = (text: string) => box.append(element("div", text));
  switch (state.colour) {
    case "region":
      title("Region");
      kinds(mesh.part.kind === "surface" ? palette.markers : palette.regions, mesh.part.kind === "surface" ? "m" : "r");
      break;
    case "marker":
      title("Marker of triangles");
      kinds(palette.markers, "m");
      break;
    case "forced":
      title("Small angles");
      forcedKinds.forEach((kind, i) => box.append(toggle(state, `k${i}`, kind.colour, kind.label, changed)));
      break;
    case "angle": case "q": case "size": {
      title({ angle: "Least dihedral angle", q: "Q (1 is regular)", size: "Mean edge" }[state.colour]);
      const { labels, colours } = palette.scales[state.colour];
      labels.forEach((label, i) => {
        const row = element("div");
        row.append(swatch(colours[i]), element("span", label));
        box.append(row);
      });
      break;
    }
    default:
  }
  box.hidden = box.childElementCount === 0;
}

export function fillBars(box: HTMLElement, state: State, palette: Palette, changed: () => void): void {
  const { labels, colours } = palette.scales[state.histogram], counts = labels.map(() => 0);
  for (const bin of palette.bins[state.histogram]) counts[bin]++;
  const most = Math.max(1, ...counts);
  box.replaceChildren(...labels.map((label, i) => {
    const button = element("button", "", `bar-${i}`), bar = element("span"), name = element("span", label);
    button.type = "button";
    button.setAttribute("aria-pressed", String(state.bars.includes(i)));
    name.className = "name";
    bar.className = "bar";
    bar.style.background = css(colours[i]);
    bar.style.width = `${counts[i] ? Math.max(1, (40 * counts[i]) / most) : 0}%`;
    const count = element("span", String(counts[i]));
    count.className = "count";
    button.append(name, bar, count);
    button.addEventListener("click", () => {
      state.bars = state.bars.includes(i) ? state.bars.filter((b) => b !== i) : [...state.bars, i];
      changed();
    });
    return button;
  }));
}

/// The 100 worst: of the least angle, the largest Q, the shortest edges.
export function worstOf(values: Float32Array, quantity: Quantity): number[] {
  const sign = quantity === "q" ? -1 : 1, most = 100;
  let list: number[] = [], bound = Infinity;
  for (let t = 0; t < values.length; t++) {
    if (sign * values[t] >= bound) continue;
    list.push(t);
    if (list.length >= 2 * most) {
      list = list.sort((a, b) => sign * (values[a] - values[b]) || a - b).slice(0, most);
      bound = sign * values[list[most - 1]];
    }
  }
  // Infinite less infinite is no number: equal ones go by their index.
  return list.sort((a, b) => (values[a] === values[b] ? a - b : sign * (values[a] - values[b]))).slice(0, most);
}

export function fillWorst(box: HTMLElement, state: State, mesh: Mesh, measures: Measures, go: (tet: number) => void): void {
  const values = measures[state.worst], unit = state.worst === "angle" ? "°" : "";
  box.replaceChildren(...worstOf(values, state.worst).map((t, rank) => {
    const item = element("li"), button = element("button", `tetrahedron ${numberOf(mesh, t)}: ${number(values[t])}${unit}`, `worst-${rank}`);
    button.type = "button";
    button.setAttribute("aria-current", String(state.element === t));
    button.addEventListener("click", () => go(t));
    item.append(button);
    return item;
  }));
}
