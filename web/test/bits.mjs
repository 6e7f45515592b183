// The same bits as the native program on surfaces of a corpus, of which it takes some evenly out of the files up to a size;
// --write FILE puts the result into a document.
//   HOLDFAST=build/release/holdfast WEB=build/web node web/test/bits.mjs FOLDER [--count 200] [--largest 40000] [--write FILE]
import { spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const words = process.argv.slice(2);
const option = (name, usual) => (words.includes(name) ? words.splice(words.indexOf(name), 2)[1] : usual);
const count = Number(option("--count", 200)), largest = Number(option("--largest", 40000)), document = option("--write", "");
const native = resolve(process.env.HOLDFAST ?? "build/release/holdfast");
const { load } = await import(pathToFileURL(resolve(process.env.WEB ?? "build/web", "npm/index.js")));
const corpus = words[0];
if (!corpus || !existsSync(corpus)) throw new Error(`there is no folder '${corpus}': give one of surfaces`);
const all = readdirSync(corpus).filter((name) => /\.(off|stl|mesh|obj|poly)$/.test(name))
  .map((name) => ({ name, size: statSync(join(corpus, name)).size })).filter(({ size }) => size <= largest).sort((a, b) => a.size - b.size || (a.name < b.name ? -1 : 1));
const names = Array.from({ length: Math.min(count, all.length) }, (_, i) => all[Math.floor((i * all.length) / Math.min(count, all.length))]);
const folder = mkdtempSync(join(tmpdir(), "holdfast-bits-")), output = join(folder, "out.vtu");
const digest = (bytes) => createHash("sha256").update(bytes).digest("hex");
let holdfast = await load(), same = 0, different = [], nativeSeconds = 0, wasmSeconds = 0, tetrahedra = 0, refused = 0;
for (const { name } of names) {
  for (const [options, given] of [[{}, []], [{ fill: true }, ["--fill"]]]) {
    rmSync(output, { force: true });
    let started = performance.now();
    const { status } = spawnSync(native, ["mesh", join(corpus, name), "-o", output, "-q", "--threads", "1", ...given], { stdio: "ignore" });
    nativeSeconds += (performance.now() - started) / 1000;
    const expected = existsSync(output) ? digest(readFileSync(output)) : `exit code ${status}`;
    started = performance.now();
    let found;
    try {
      const { files, volume } = holdfast.mesh({ name, bytes: readFileSync(join(corpus, name)) }, { ...options, format: ".vtu", name: "out" });
      found = digest(files[0].bytes);
      tetrahedra += volume.tetrahedra.length / 4;
    } catch (error) {
      found = `exit code ${{ invalid_input: 4, not_representable: 7 }[error.code] ?? error.message}`;
      if (error.code === "stopped") holdfast = await load();
      refused += 1;
    }
    wasmSeconds += (performance.now() - started) / 1000;
    if (found === expected) same += 1;
    else different.push(`${name} ${given.join(" ")}: ${found}, not ${expected}`);
  }
}
rmSync(folder, { recursive: true });
const text = `${names.length} surfaces of up to ${largest} bytes, each meshed with field points and with \`--fill\`: ${same} of ${2 * names.length} \`.vtu\` files have the bytes of the native program's (${tetrahedra} tetrahedra; ${nativeSeconds.toFixed(0)} s natively on one thread, ${wasmSeconds.toFixed(0)} s in Node ${process.versions.node})${refused ? `; ${refused} runs end without a mesh, for the same reason` : ""}.`;
console.log([...different, text].join("\n"));
if (document) {
  const old = readFileSync(document, "utf8"), mark = /(<!-- make web-bits -->\n)[^]*?(\n<!-- end -->)/;
  if (!mark.test(old)) throw new Error(`${document} has no place for it`);
  writeFileSync(document, old.replace(mark, (_, begin, end) => begin + text + end));
}
process.exitCode = different.length ? 1 : 0;
