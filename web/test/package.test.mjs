// The npm package in Node: the bytes of the native program, errors, progress, cancelling, limits, Workers, types.
//   HOLDFAST=build/release/holdfast WEB=build/web node --test web/test/package.test.mjs
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { pathToFileURL } from "node:url";
import { crossing, cubes, off, sphere, stl } from "./surfaces.mjs";

const root = resolve(import.meta.dirname ?? ".", "../.."), native = resolve(process.env.HOLDFAST ?? "build/release/holdfast");
const npm = resolve(process.env.WEB ?? "build/web", "npm");
const { load, startWorker, HoldfastError } = await import(pathToFileURL(join(npm, "index.js")));
let folder, holdfast;
const at = (name) => join(folder, name);
const bytes = (text) => new TextEncoder().encode(text);
const file = (name, text) => (writeFileSync(at(name), text), { name, bytes: typeof text === "string" ? bytes(text) : text });
const run = (...words) => spawnSync(native, words, { cwd: folder, encoding: "utf8" });
const ok = (...words) => assert.equal(run(...words).status, 0, words.join(" "));
const same = (answer, name) => assert.ok(Buffer.from(answer.bytes).equals(readFileSync(at(name))), `${name} has other bytes`);
const throwsCode = (code, action) => {
  let error;
  try {
    action();
  } catch (thrown) {
    error = thrown;
  }
  assert.ok(error instanceof HoldfastError, `${error}`);
  assert.equal(error.code, code, error.message);
  return error;
};

before(async () => {
  folder = mkdtempSync(join(tmpdir(), "holdfast-npm-"));
  holdfast = await load();
});
after(() => rmSync(folder, { recursive: true }));

test("version and formats are the program's", () => {
  const about = holdfast.about();
  assert.match(run("--version").stdout, new RegExp(about.version.replaceAll(".", "\\.")));
  assert.ok(about.volumeFormats.includes(".vtu") && about.surfaceFormats.includes(".stl"));
});

test("every format of volumes has the bytes of the native program", () => {
  const input = file("shells.off", off(cubes([[0, 0, 0, 3], [1, 1, 1, 1]])));
  for (const format of holdfast.about().volumeFormats.filter((of) => of !== ".openfoam")) {
    const { files } = holdfast.mesh(input, { format, keep: "bounded", size: 0.8 });
    mkdirSync(at("native"));
    ok("mesh", "shells.off", "-o", `native/shells${format}`, "--keep", "bounded", "--size", "0.8", "-q");
    const names = readdirSync(at("native")).sort();
    assert.deepEqual(files.map((of) => of.name).sort(), names);
    assert.equal(files[0].name, `shells${format}`);
    for (const of of files) same(of, join("native", of.name));
    rmSync(at("native"), { recursive: true });
  }
  throwsCode("bad_argument", () => holdfast.mesh(input, { format: ".openfoam" }));
});

test("options give what the program's give", () => {
  const input = file("ball.off", off(sphere(9, 1.1)));
  const cases = [
    [{}, []], [{ fill: true }, ["--fill"]], [{ size: 0.2, gradation: 0.1 }, ["--size", "0.2", "--gradation", "0.1"]], [{ noGrowth: true }, ["--no-growth"]],
    [{ quality: "fast", seed: 7 }, ["--quality", "fast", "--seed", "7"]], [{ keep: "box", boxMargin: 0.3, fill: true }, ["--keep", "box=0.3", "--fill"]],
    [{ maxVolume: 0.001 }, ["--max-volume", "0.001"]], [{ regions: [{ where: [0, 0, 0], id: 5, size: 0.3 }] }, ["--region", "0,0,0,5,0.3"]],
  ];
  for (const [options, words] of cases) {
    ok("mesh", "ball.off", "-o", "ball.vtu", "-q", ...words);
    same(holdfast.mesh(input, { ...options, format: ".vtu" }).files[0], "ball.vtu");
  }
});

test("arrays in, arrays out, and files of them", () => {
  const { points, triangles } = sphere(7), surface = { vertices: Float64Array.from(points.flat()), triangles: Uint32Array.from(triangles.flat()) };
  const { volume, files, report } = holdfast.mesh(surface, { format: ".vtu", name: "ball" });
  assert.equal(files[0].name, "ball.vtu");
  assert.equal(report.outcome, "done");
  assert.deepEqual(volume.vertices.subarray(0, surface.vertices.length), surface.vertices);
  assert.equal(volume.regions.length, volume.tetrahedra.length / 4);
  assert.deepEqual(holdfast.readVolume(files).tetrahedra, volume.tetrahedra);
  assert.deepEqual(holdfast.writeVolume(volume, { format: ".vtu" })[0].bytes, files[0].bytes);
  assert.deepEqual(holdfast.mesh(surface).files, []);
  const [written] = holdfast.writeSurface({ ...surface, triangleMarkers: new Int32Array(triangles.length).fill(4), names: { facets: { 4: "skin" } } }, { format: ".stl" });
  const read = holdfast.readSurface(written);
  assert.equal(read.triangles.length, surface.triangles.length);
  assert.deepEqual(Object.values(read.names.facets), ["skin"]);
  assert.ok(holdfast.check(surface, volume).holds);
  throwsCode("bad_argument", () => holdfast.mesh({ ...surface, triangles: Array.from(surface.triangles) }));
  throwsCode("bad_argument", () => holdfast.mesh({ ...surface, triangleMarkers: new Int32Array(3) }));
  throwsCode("bad_argument", () => holdfast.writeVolume({ ...volume, tetrahedra: Uint32Array.of(0, 1, 2, 1e6) }, { format: ".vtk" }));
  throwsCode("invalid_input", () => holdfast.mesh({ ...surface, triangles: Uint32Array.of(0, 1, 1e6) }));
});

test("what is wrong, and repairing it", () => {
  const input = file("crossing.stl", stl(crossing(5)));
  const { valid, defects } = holdfast.diagnose(input);
  run("diagnose", "crossing.stl", "-q", "--report", "crossing.json");
  const report = JSON.parse(readFileSync(at("crossing.json"), "utf8"));
  assert.equal(valid, false);
  assert.deepEqual(defects, report.defects);
  assert.deepEqual(throwsCode("invalid_input", () => holdfast.mesh(input)).defects, report.defects);
  assert.equal(holdfast.diagnose(input, { most: 3 }).defects.length, 3);
  for (const [options, words] of [[{}, []], [{ union: true }, ["--union"]], [{ weld: 0.01, fillHoles: true }, ["--weld", "0.01", "--fill-holes"]]]) {
    for (const format of [".off", ".stl", ".poly"]) {
      ok("repair", "crossing.stl", "-o", `repaired${format}`, "-q", ...words);
      same(holdfast.repair(input, { ...options, format }).files[0], `repaired${format}`);
    }
  }
  const { surface } = holdfast.repair(input);
  assert.ok(holdfast.diagnose(surface).valid);
  ok("mesh", "crossing.stl", "-o", "crossing.vtu", "-q", "--repair");
  same(holdfast.mesh(surface, { format: ".vtu" }).files[0], "crossing.vtu");
});

test("several files, files beside one another, packed ones", () => {
  const one = file("one.off", off(cubes([[0, 0, 0, 1]]))), two = file("two.off", off(cubes([[1, 0, 0, 1]]))), far = file("far.off", off(cubes([[5, 0, 0, 1]])));
  for (const inputs of [[one, far], [one, two]]) {
    ok("mesh", ...inputs.map(({ name }) => name), "-o", "both.vtu", "-q");
    same(holdfast.mesh(inputs, { format: ".vtu" }).files[0], "both.vtu");
  }
  const { files } = holdfast.mesh(one, { format: ".node" });
  assert.ok(files.length > 1);
  assert.ok(holdfast.check(one, files).holds);
  const packed = execFileSync("gzip", ["-c", at("one.off")]);
  assert.deepEqual(holdfast.readSurface({ name: "one.off.gz", bytes: packed }).triangles, holdfast.readSurface(one).triangles);
});

test("a check finds what is broken", () => {
  const one = file("a.off", off(cubes([[0, 0, 0, 1]]))), other = file("b.off", off(cubes([[0, 0, 0, 2]])));
  const { volume } = holdfast.mesh(other), { holds, rules } = holdfast.check(one, volume);
  assert.equal(holds, false);
  assert.ok(rules.some((rule) => !rule.holds && rule.detail));
});

test("errors have codes and places", () => {
  const error = throwsCode("file_error", () => holdfast.mesh({ name: "../x/torn.off", bytes: bytes("OFF\n3 1 0\n0 0 0\n1 0 zero\n") }));
  assert.equal(error.file, "torn.off");
  assert.match(error.where, /line 4/);
  throwsCode("file_error", () => holdfast.mesh({ name: "what.xyzzy", bytes: bytes("?") }));
  throwsCode("file_error", () => holdfast.mesh({ name: "empty.stl", bytes: new Uint8Array() }));
  const cube = { name: "cube.off", bytes: bytes(off(cubes([[0, 0, 0, 1]]))) };
  for (const options of [{ sise: 1 }, { fill: true, size: 1 }, { size: -1 }, { keep: "some" }, { gradation: 2 }, { boxMargin: 1 }, { holes: [[0, 0]] }, { size: "1" }])
    throwsCode("bad_argument", () => holdfast.mesh(cube, options));
  throwsCode("bad_argument", () => holdfast.mesh([]));
  assert.ok(holdfast.mesh(cube).volume.tetrahedra.length > 0, "errors leave it whole");
});

test("progress, cancelling, limits", () => {
  const input = { name: "ball.off", bytes: bytes(off(sphere(30))) }, shares = [], stages = new Set();
  holdfast.mesh(input, {}, { progress: (share, stage) => void (shares.push(share), stages.add(stage)) });
  const meshing = shares.filter((_, i) => i > 2);
  assert.ok(meshing.length > 3 && shares.every((share) => share >= 0 && share <= 1), `${shares}`);
  assert.ok(stages.has("field_points"), [...stages].join());
  throwsCode("cancelled", () => holdfast.mesh(input, {}, { progress: (share, stage) => stage !== "field_points" }));
  const cancel = new Int32Array(new SharedArrayBuffer(4));
  throwsCode("cancelled", () => holdfast.mesh(input, {}, { cancel, progress: () => void Atomics.store(cancel, 0, 1) }));
  throwsCode("time_limit", () => holdfast.mesh(input, { timeLimit: 1e-3 }));
  throwsCode("memory_limit", () => holdfast.mesh(input, { memoryLimit: 1e6 }));
  assert.ok(holdfast.mesh(input).volume.tetrahedra.length > 0);
});

test("in a Worker: the same results, in turn, and an end at once", async () => {
  const worker = startWorker(), ball = { name: "ball.off", bytes: bytes(off(sphere(12))) };
  const [one, two] = await Promise.all([worker.mesh(ball, { format: ".vtu" }), worker.diagnose(ball)]);
  assert.deepEqual(one.files[0].bytes, holdfast.mesh(ball, { format: ".vtu" }).files[0].bytes);
  assert.ok(two.valid);
  const large = { name: "large.off", bytes: bytes(off(sphere(60))) }, abort = new AbortController(), started = Date.now();
  const long = worker.mesh(large, { size: 0.01 }, { signal: abort.signal, progress: () => abort.abort() });
  await assert.rejects(long, (error) => error instanceof HoldfastError && error.code === "cancelled");
  assert.ok(Date.now() - started < 30000);
  assert.ok((await worker.check(ball, one.volume)).holds, "the next call has a Worker again");
  await assert.rejects(worker.mesh({ name: "crossing.off", bytes: bytes(off(crossing(1))) }), (error) => error.code === "invalid_input" && error.defects.length > 0);
  await assert.rejects(worker.mesh(ball, {}, { signal: AbortSignal.abort() }), { code: "cancelled" });
  worker.close();
});

test("an installed package, with types for a user's program", () => {
  const user = at("user");
  mkdirSync(user);
  const packed = JSON.parse(execFileSync("npm", ["pack", npm, "--json", "--silent", "--pack-destination", user], { cwd: user, encoding: "utf8" }));
  writeFileSync(join(user, "package.json"), '{"name": "user", "private": true, "type": "module"}');
  execFileSync("npm", ["install", "--offline", "--no-audit", "--no-fund", "--silent", join(user, packed[0].filename)], { cwd: user });
  writeFileSync(join(user, "use.ts"), `import { load, startWorker, HoldfastError, type MeshResult, type Surface } from "holdfast";
const surface: Surface = { vertices: new Float64Array(0), triangles: new Uint32Array(0) };
const holdfast = await load();
try {
  const result: MeshResult = holdfast.mesh(surface, { size: 1, keep: "bounded", format: ".vtu" }, { progress: (share) => share < 1 });
  result.volume.tetrahedra.length;
} catch (error) {
  if (error instanceof HoldfastError && error.code === "invalid_input") error.defects[0]?.where[0][2].toFixed();
}
// @ts-expect-error: there is no such way to keep regions
holdfast.mesh(surface, { keep: "none" });
await startWorker().diagnose(surface, {}, { signal: new AbortController().signal });
`);
  for (const resolution of [["--module", "nodenext"], ["--module", "esnext", "--moduleResolution", "bundler"]])
    execFileSync(join(root, "viewer/node_modules/.bin/tsc"), ["--noEmit", "--strict", "--target", "es2022", "--lib", "es2022,dom", "--types", "", ...resolution, "use.ts"], { cwd: user, stdio: ["ignore", "inherit", "inherit"] });
  writeFileSync(join(user, "use.mjs"), 'import { load } from "holdfast"; console.log((await load()).about().version);');
  assert.equal(execFileSync("node", ["use.mjs"], { cwd: user, encoding: "utf8" }).trim(), holdfast.about().version);
});
