// What the controls say: one plain object, which the address keeps.

export type Quantity = "angle" | "q" | "size";
export type Colour = "region" | "marker" | Quantity | "forced" | "plain";
export type Axis = "x" | "y" | "z" | "free";

export interface State {
  model: number;
  cut: boolean;
  axis: Axis;
  nx: number; ny: number; nz: number; // of a free plane
  position: number; // of the plane, from 0 to 1 through the part
  flip: boolean;
  cap: "crinkle" | "flat";
  wheel: "zoom" | "plane";
  colour: Colour;
  surface: boolean; elements: boolean; edges: boolean; added: boolean; dangling: boolean; segments: boolean; ghost: boolean;
  histogram: Quantity;
  bars: number[]; // of the histogram that are chosen; none: everything is shown
  hidden: string[]; // regions "r1", markers "m7" and kinds "k2" that are switched off
  worst: Quantity;
  theme: "auto" | "light" | "dark";
  tab: string;
  entry: number; // that is flown to, -1: none
  element: number; // likewise
  view: number[]; // camera: quaternion, target, distance; empty: as the page opens
}

export function initial(): State {
  return {
    model: 0, cut: false, axis: "x", nx: 1, ny: 1, nz: 1, position: 0.5, flip: false, cap: "crinkle", wheel: "zoom",
    colour: "plain", surface: true, elements: true, edges: true, added: false, dangling: true, segments: true, ghost: true,
    histogram: "angle", bars: [], hidden: [], worst: "angle", theme: "auto", tab: "view", entry: -1, element: -1, view: [],
  };
}

const choices: Partial<Record<keyof State, readonly string[]>> = {
  axis: ["x", "y", "z", "free"], cap: ["crinkle", "flat"], wheel: ["zoom", "plane"],
  colour: ["plain", "region", "marker", "angle", "q", "size", "forced"], histogram: ["angle", "q", "size"],
  worst: ["angle", "q", "size"], theme: ["auto", "light", "dark"],
  tab: ["view", "defects", "elements", "verdict", "report", "help"],
};

export function toAddress(state: State, usual: State): string {
  const words: string[] = [];
  for (const key of Object.keys(state) as (keyof State)[]) {
    const value = state[key], text = Array.isArray(value) ? value.join(",") : String(value);
    const was = usual[key];
    if (text !== (Array.isArray(was) ? was.join(",") : String(was))) words.push(`${key}=${encodeURIComponent(text)}`);
  }
  return words.join("&");
}

/// What an address says, laid over `state`; anything that is no value of a control is passed over.
export function fromAddress(address: string, state: State): State {
  const result = { ...state } as Record<string, unknown>;
  for (const [key, text] of new URLSearchParams(address.replace(/^#/, ""))) {
    if (!Object.hasOwn(state, key)) continue;
    const was = state[key as keyof State];
    if (typeof was === "boolean") result[key] = text === "true";
    else if (typeof was === "number") {
      const value = Number(text);
      if (text !== "" && Number.isFinite(value)) result[key] = value;
    } else if (key === "hidden") result[key] = text.split(",").filter((word) => /^[rmk]-?\d+$/.test(word));
    else if (Array.isArray(was)) {
      const list = text === "" ? [] : text.split(",").map(Number);
      if (list.every(Number.isFinite)) result[key] = list;
    } else if (choices[key as keyof State]?.includes(text)) result[key] = text;
  }
  const done = result as unknown as State;
  if (done.view.length !== 8) done.view = [];
  done.position = Math.min(1, Math.max(0, done.position));
  return done;
}
