// Triangles of polygons by npm's earcut, cdt2d or poly2tri: for each polygon of a JSON file (outlines of points, the first
// one outer) a line of JSON with the median of the processor's milliseconds and the triangles, by corners counted through all outlines.
//
//   node ears.mjs PACKAGE POLYGONS.json TURNS     (in a folder with node_modules)
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const [name, path, turns] = process.argv.slice(2);
const found = createRequire(pathToFileURL(process.cwd() + "/")).resolve(name);
const loaded = await import(pathToFileURL(found));
const library = loaded.default || loaded;

// Each takes outlines and gives a function that triangulates them, as its package wants the data, and one that makes
// corners of what comes out.
const packages = {
  earcut(outlines) {
    const flat = outlines.flat(2), holes = [];
    for (let i = 0, n = 0; i + 1 < outlines.length; ++i) holes.push((n += outlines[i].length));
    return {
      solve: () => library(flat, holes, 2),
      corners: (t) => Array.from({ length: t.length / 3 }, (_, i) => [t[3 * i], t[3 * i + 1], t[3 * i + 2]]),
    };
  },
  cdt2d(outlines) {
    const points = outlines.flat(), edges = [];
    let first = 0;
    for (const { length } of outlines) {
      for (let i = 0; i < length; ++i) edges.push([first + i, first + ((i + 1) % length)]);
      first += length;
    }
    return { solve: () => library(points, edges, { exterior: false }), corners: (t) => t };
  },
  poly2tri(outlines) {
    return {
      solve: () => {
        let number = 0;
        const [outer, ...holes] = outlines.map((o) =>
          o.map((p) => Object.assign(new library.Point(p[0], p[1]), { number: number++ })));
        const sweep = new library.SweepContext(outer);
        for (const hole of holes) sweep.addHole(hole);
        sweep.triangulate();
        return sweep.getTriangles();
      },
      corners: (t) => t.map((triangle) => triangle.getPoints().map((p) => p.number)),
    };
  },
};

for (const outlines of JSON.parse(readFileSync(path, "utf8"))) {
  let told;
  try {
    const { solve, corners } = packages[name](outlines);
    const times = [];
    let triangles;
    for (let i = 0; i < Number(turns); ++i) {
      const start = process.cpuUsage();
      triangles = solve();
      const { user, system } = process.cpuUsage(start);
      times.push((user + system) / 1e3);
    }
    times.sort((a, b) => a - b);
    told = { ms: times[times.length >> 1], triangles: corners(triangles) };
  } catch (error) {
    told = { error: String(error.message || error).slice(0, 80) };
  }
  console.log(JSON.stringify(told));
}
