// Builds viewer/dist/viewer.html, the page without its data, and its checksum. `make viewer` runs this; the program embeds
// what is committed, so that it builds without npm.
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync, mkdirSync } from "node:fs";
import { build } from "esbuild";

const here = new URL("./", import.meta.url);
const bundle = await build({
  entryPoints: [new URL("src/main.ts", here).pathname],
  bundle: true, minify: true, write: false, format: "iife", target: "es2022", legalComments: "none", charset: "utf8",
  banner: { js: "/* Holdfast's viewer, MIT or Apache-2.0; with three.js, Copyright 2010-2026 three.js authors, MIT */" },
});
// A script element ends at the first such text, wherever it stands.
const script = bundle.outputFiles[0].text.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
const style = readFileSync(new URL("src/style.css", here), "utf8");
const hash = (text) => `'sha256-${createHash("sha256").update(text, "utf8").digest("base64")}'`;
const policy = `default-src 'none'; script-src ${hash(script)}; style-src ${hash(style)}; img-src blob: data:; base-uri 'none'; form-action 'none'`;
let page = readFileSync(new URL("src/page.html", here), "utf8");
for (const [mark, text] of [["@CSP@", policy], ["@STYLE@", style], ["@SCRIPT@", script]]) page = page.replace(mark, () => text);
for (const mark of ["@TITLE@", "@DEFECTS@", "@VERDICT@", "@REPORT@", "@DATA@"])
  if (page.split(mark).length !== 2) throw new Error(`${mark} must stand in the page once`);
mkdirSync(new URL("dist/", here), { recursive: true });
writeFileSync(new URL("dist/viewer.html", here), page);
const sum = createHash("sha256").update(page, "utf8").digest("hex");
writeFileSync(new URL("dist/viewer.html.sha256", here), `${sum}  viewer.html\n`);
console.log(`viewer/dist/viewer.html: ${page.length} characters, ${sum}`);
