// Puts together what emscripten has made: build/web/index.html, the page in one file, and build/web/npm, the package.
// web/build.sh runs this.
//   node web/build.mjs build/web
import { createHash } from "node:crypto";
import { createRequire } from "node:module";
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { deflateSync } from "node:zlib";

const web = import.meta.dirname ?? new URL(".", import.meta.url).pathname, root = resolve(web, ".."), out = resolve(process.argv[2]);
const { build } = createRequire(join(root, "viewer/package.json"))("esbuild");
const wasm = readFileSync(join(out, "wasm/holdfast.wasm")), glue = join(out, "wasm/holdfast.js");
const banner = "/* Holdfast, MIT or Apache-2.0; with parts of emscripten and musl (MIT), LLVM (Apache-2.0 with exceptions), zlib */";
const version = ["MAJOR", "MINOR", "PATCH"].map((part) => readFileSync(join(root, "include/holdfast/version.h"), "utf8").match(new RegExp(`${part} (\\d+)`))[1]).join(".");

/// emscripten's script is found under the name by which the sources import it.
const module = { name: "module", setup: (at) => void at.onResolve({ filter: /^holdfast-module$/ }, () => ({ path: glue })) };
const bundle = async (entry, options) => (await build({
  entryPoints: [join(web, "src", entry)], bundle: true, minify: true, write: false, target: "es2022", legalComments: "none",
  charset: "utf8", banner: { js: banner }, plugins: [module], ...options,
})).outputFiles[0].text;

// ---- The package ----
const npm = join(out, "npm");
rmSync(npm, { recursive: true, force: true });
mkdirSync(npm, { recursive: true });
for (const [entry, file] of [["npm.ts", "index.js"], ["npm-worker.ts", "worker.js"]])
  writeFileSync(join(npm, file), await bundle(entry, { format: "esm", platform: "neutral", external: ["node:*"] }));
writeFileSync(join(npm, "holdfast.wasm"), wasm);
writeFileSync(join(npm, "package.json"), readFileSync(join(web, "npm/package.json"), "utf8").replace("@VERSION@", version));
for (const file of ["LICENSE-MIT", "LICENSE-APACHE"]) copyFileSync(join(root, file), join(npm, file));
copyFileSync(join(web, "npm/README.md"), join(npm, "README.md"));
execFileSync(join(root, "viewer/node_modules/.bin/tsc"), ["-p", join(web, "tsconfig.json"), "--noEmit", "false", "--declaration", "--emitDeclarationOnly", "--outDir", join(out, "types")], { stdio: "inherit" });
// Node's resolution of modules wants the endings.
for (const [file, to] of [["core", "core"], ["client", "client"], ["serve", "serve"], ["types", "types"], ["npm", "index"]]) {
  const text = readFileSync(join(out, `types/web/src/${file}.d.ts`), "utf8");
  writeFileSync(join(npm, `${to}.d.ts`), text.replace(/(from "\.\/\w+)"/g, '$1.js"').replace(/(import\("\.\/\w+)"/g, '$1.js"'));
}

// ---- The page ----
const hash = (text) => `'sha256-${createHash("sha256").update(text, "utf8").digest("base64")}'`;
const packed = (bytes) => deflateSync(bytes, { level: 9 }).toString("base64");
// A script element ends at the first such text, wherever it stands.
const inElement = (script) => script.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
const script = inElement(await bundle("app.ts", { format: "iife" }));
const worker = `${readFileSync(glue, "utf8")}\n${await bundle("worker.ts", { format: "iife" })}`;
const style = readFileSync(join(web, "src/style.css"), "utf8");
// The viewer's page comes from a blob, which the policy of this page binds, too: so its digests are let in.
const viewer = readFileSync(join(root, "viewer/dist/viewer.html"), "utf8").match(/script-src ('sha256-[^']+'); style-src ('sha256-[^']+')/);
const policy = `default-src 'none'; script-src ${hash(script)} ${viewer[1]} 'wasm-unsafe-eval'; style-src ${hash(style)} ${viewer[2]}; worker-src blob:; frame-src blob:; img-src blob: data:; base-uri 'none'; form-action 'none'`;
let page = readFileSync(join(web, "src/index.html"), "utf8");
for (const [mark, text] of [["@CSP@", policy], ["@STYLE@", style], ["@WASM@", packed(wasm)], ["@WORKER@", packed(worker)], ["@VERSION@", version], ["@SCRIPT@", script]])
  page = page.replaceAll(mark, () => text);
writeFileSync(join(out, "index.html"), page);
console.log(`${join(out, "index.html")}: ${page.length} bytes; holdfast.wasm: ${wasm.length} bytes`);
