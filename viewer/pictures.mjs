// Makes the pictures of the documents out of real runs: `make pictures`.
//   node pictures.mjs HOLDFAST FOLDER
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { open, show } from "./test/browser.mjs";

const [, , program, target] = process.argv;
const holdfast = resolve(program), out = resolve(target), examples = new URL("../examples/", import.meta.url).pathname;
const work = mkdtempSync(join(tmpdir(), "holdfast-pictures-"));
const python = (...words) => execFileSync("python3", [join(examples, words[0]), ...words.slice(1)], { cwd: work, stdio: "ignore" });
function run(...words) {
  const ended = spawnSync(holdfast, [...words, "-q"], { cwd: work, encoding: "utf8" });
  if (![0, 4].includes(ended.status)) throw new Error(`${words.join(" ")}: ${ended.stderr}`);
}

/// A sphere of `rings` rings, its triangles turned outward.
function sphere(centre, radius, rings) {
  const around = 2 * rings, points = [[0, 0, radius]], triangles = [];
  for (let i = 1; i < rings; i++)
    for (let j = 0; j < around; j++) {
      const a = (Math.PI * i) / rings, b = (2 * Math.PI * (j + i / 2)) / around;
      points.push([radius * Math.sin(a) * Math.cos(b), radius * Math.sin(a) * Math.sin(b), radius * Math.cos(a)]);
    }
  points.push([0, 0, -radius]);
  const at = (i, j) => 1 + (i - 1) * around + (j % around), last = points.length - 1;
  for (let j = 0; j < around; j++) {
    triangles.push([0, at(1, j), at(1, j + 1)], [last, at(rings - 1, j + 1), at(rings - 1, j)]);
    for (let i = 1; i + 1 < rings; i++) triangles.push([at(i, j), at(i + 1, j), at(i, j + 1)], [at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)]);
  }
  return { points: points.map((p) => p.map((x, k) => x + centre[k])), triangles };
}

function off(name, shapes) {
  const points = shapes.flatMap((s) => s.points);
  let first = 0;
  const triangles = shapes.flatMap((s) => {
    const list = s.triangles.map((t) => t.map((v) => v + first));
    first += s.points.length;
    return list;
  });
  writeFileSync(join(work, name), `OFF\n${points.length} ${triangles.length} 0\n${points.map((p) => p.join(" ")).join("\n")}\n${triangles.map((t) => `3 ${t.join(" ")}`).join("\n")}\n`);
}

python("make_part.py", "part.stl");
run("mesh", "part.stl", "--size", "2.5", "-o", "part.vtu", "--html", "part.html");
off("materials.off", [sphere([0, 0, 0], 3, 14), sphere([0, 0, 0], 2, 12), sphere([0.9, 0, 0], 0.8, 10), sphere([-0.9, 0, 0], 0.8, 10)]);
run("mesh", "materials.off", "-o", "materials.vtu", "--keep", "bounded", "--html", "materials.html");
off("crossing.off", [sphere([0, 0, 0], 1, 9), sphere([1.1, 0.2, 0.1], 0.8, 8)]);
run("diagnose", "crossing.off", "--html", "crossing.html");
run("repair", "crossing.off", "-o", "repaired.off", "--union");
run("mesh", "repaired.off", "-o", "repaired.vtu", "--html", "repaired.html");
python("make_hard.py", "schonhardt", "schonhardt.off", "--twist", "50");
run("mesh", "schonhardt.off", "-o", "schonhardt.vtu", "--fill", "--html", "schonhardt.html");
python("make_hard.py", "chazelle", "chazelle.off", "-n", "3");
run("mesh", "chazelle.off", "-o", "chazelle.vtu", "--fill", "--html", "chazelle.html");

const pictures = [
  ["part", "part.html", "cut=true&axis=y&colour=angle"],
  ["before-repair", "crossing.html", "entry=0&ghost=false&view=0.1728,0.531824,0.788462,0.256187,0,0,0,4.9"],
  ["after-repair", "repaired.html", "cut=true&axis=z&position=0.55&colour=angle"],
  ["materials", "materials.html", "cut=true&axis=y&cap=flat&colour=region"],
  ["schonhardt", "schonhardt.html", "cut=true&axis=x&position=0.3&colour=angle&added=true"],
  ["chazelle", "chazelle.html", "cut=true&axis=x&position=0.6&colour=angle&added=true"],
];
mkdirSync(out, { recursive: true });
const browser = await open();
for (const [name, page, hash] of pictures) {
  const { page: tab, wrong, close } = await show(browser, join(work, page), { hash: `#${hash}`, width: 1100, height: 620 });
  if (wrong.length) throw new Error(`${page}: ${wrong.join()}`);
  // The canvas alone, as WebP, which is a fifth of a PNG.
  const base64 = await tab.evaluate(() => {
    const { view } = window.holdfastPage;
    view.drawNow();
    return view.canvas.toDataURL("image/webp", 0.85).split(",")[1];
  });
  const bytes = Buffer.from(base64, "base64");
  writeFileSync(join(out, `${name}.webp`), bytes);
  console.log(`${name}.webp: ${bytes.length} bytes`);
  await close();
}
await browser.close();
rmSync(work, { recursive: true });
