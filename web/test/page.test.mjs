// build/web/index.html from file:// in headless Chromium: a surface in, the native program's bytes out, nothing sent.
//   HOLDFAST=build/release/holdfast WEB=build/web node --test web/test/page.test.mjs
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { open, show } from "../../viewer/test/browser.mjs";
import { crossing, cubes, off, sphere, stl } from "./surfaces.mjs";

const native = resolve(process.env.HOLDFAST ?? "build/release/holdfast"), html = resolve(process.env.WEB ?? "build/web", "index.html");
let browser, folder;
const at = (name) => join(folder, name);
const run = (...words) => spawnSync(native, words, { cwd: folder, encoding: "utf8" });
const ok = (...words) => assert.equal(run(...words).status, 0, words.join(" "));

before(async () => {
  browser = await open();
  folder = mkdtempSync(join(tmpdir(), "holdfast-page-"));
});
after(async () => {
  await browser?.close();
  rmSync(folder, { recursive: true });
});

/// Drops a file of the folder on the page.
async function drop(page, name, text = readFileSync(at(name), "latin1")) {
  await page.evaluate(([name, text]) => {
    const dataTransfer = new DataTransfer(), bytes = Uint8Array.from(text, (c) => c.charCodeAt(0));
    dataTransfer.items.add(new File([bytes], name));
    document.getElementById("drop").dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true }));
  }, [name, text]);
}
async function told(page, pattern, seconds = 60) {
  try {
    await page.waitForFunction((of) => new RegExp(of).test(document.getElementById("message").textContent), pattern.source, { timeout: seconds * 1000 });
  } catch (error) {
    assert.match(await page.locator("#message").innerText(), pattern, String(error));
  }
}
// Chromium 156 leaves out a download that comes too soon after many others.
const kBetweenDownloads = 1000;
async function download(page, button = "^Download") {
  await new Promise((done) => setTimeout(done, kBetweenDownloads));
  const [file] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: new RegExp(button) }).click()]);
  return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
}
async function same(page, name, button) {
  const file = await download(page, button);
  assert.equal(file.name, name);
  assert.ok(file.bytes.equals(readFileSync(at(name))), `${name} has other bytes`);
}
const viewer = async (page) => {
  const frame = await (await page.waitForSelector("#look iframe")).contentFrame();
  // By the clock: a frame outside the window draws no pictures to poll by.
  await frame.waitForFunction(() => document.documentElement.dataset.ready === "yes", undefined, { polling: 100 });
  return frame;
};
const nothingWrong = (wrong) => assert.deepEqual(wrong, []);

test("a dropped STL is meshed, and every format of the download is the native file", async () => {
  writeFileSync(at("ball.stl"), stl(sphere(10)));
  const { page, wrong, close } = await show(browser, html);
  await drop(page, "ball.stl");
  await told(page, /is valid: 360 triangles/);
  await page.getByRole("button", { name: /^Mesh/ }).click();
  await told(page, /tetrahedra/);
  ok("mesh", "ball.stl", "-o", "ball.vtu", "-q");
  await same(page, "ball.vtu");
  const frame = await viewer(page);
  assert.match(await frame.locator("#counts").innerText(), /tetrahedra/);
  const formats = await page.locator("[name=format] option").allInnerTexts();
  for (const format of formats.slice(1)) {
    await page.selectOption("[name=format]", format);
    await told(page, /Written/);
    ok("mesh", "ball.stl", "-o", `ball${format}`, "-q");
    await same(page, `ball${format}`);
    // Of formats with several files, the others.
    for (const label of await page.locator("#more button").allInnerTexts()) await same(page, label.replace(/^Also /, ""), `^${label.replaceAll(".", "\\.")}$`);
    await page.evaluate(() => (document.getElementById("message").textContent = ""));
  }
  nothingWrong(wrong);
  await close();
});

test("a chosen file, options, and a check", async () => {
  writeFileSync(at("shells.off"), off(cubes([[0, 0, 0, 3], [1, 1, 1, 1]])));
  const { page, wrong, close } = await show(browser, html);
  await page.setInputFiles("[name=file]", at("shells.off"));
  await page.selectOption("[name=keep]", "bounded");
  await page.fill("[name=size]", "0.5");
  await page.fill("[name=gradation]", "0.2");
  await page.selectOption("[name=quality]", "fast");
  await page.selectOption("[name=format]", ".mesh");
  await page.click("[name=mesh]"); // before the diagnosis has ended
  await told(page, /tetrahedra/);
  ok("mesh", "shells.off", "-o", "shells.mesh", "-q", "--keep", "bounded", "--size", "0.5", "--gradation", "0.2", "--quality", "fast");
  await same(page, "shells.mesh");
  await page.check("[name=fill]");
  assert.ok(await page.locator("[name=size]").isDisabled());
  await page.click("[name=mesh]");
  await told(page, /tetrahedra/);
  ok("mesh", "shells.off", "-o", "shells.mesh", "-q", "--keep", "bounded", "--fill");
  await same(page, "shells.mesh");
  await page.click("[name=check]");
  await told(page, /keeps the surface[^]*holds: facets kept/);
  nothingWrong(wrong);
  await close();
});

test("what is wrong is listed and seen; repaired and meshed as by the program", async () => {
  writeFileSync(at("crossing.off"), off(crossing(13)));
  const { page, wrong, close } = await show(browser, html);
  await drop(page, "crossing.off");
  await told(page, /is not valid/);
  run("diagnose", "crossing.off", "-q", "--report", "crossing.json");
  const { defects } = JSON.parse(readFileSync(at("crossing.json"), "utf8"));
  assert.ok(defects.length >= 100);
  const lines = await page.locator("#defects li").allInnerTexts();
  assert.equal(lines.length, defects.length);
  for (const [i, defect] of defects.entries()) assert.ok(lines[i].includes(defect.message), lines[i]);
  const frame = await viewer(page);
  await frame.locator("#tab-defects button[data-entry]").nth(5).click();
  assert.equal(await frame.evaluate(() => window.holdfastPage.state.entry), 5);
  // By the keyboard: a click just after the page was scrolled to the frame may still go to the frame.
  await page.getByRole("button", { name: /^Repair/ }).press("Enter");
  await told(page, /^Repaired/);
  ok("repair", "crossing.off", "-o", "crossing-repaired.off", "-q");
  await same(page, "crossing-repaired.off");
  await page.getByRole("button", { name: /^Mesh/ }).click();
  await told(page, /tetrahedra/);
  ok("mesh", "crossing.off", "-o", "crossing.vtu", "-q", "--repair");
  await same(page, "crossing.vtu");
  nothingWrong(wrong);
  await close();
});

test("cancel, a memory limit, and what cannot be read", async () => {
  writeFileSync(at("large.off"), off(sphere(60)));
  writeFileSync(at("torn.off"), "OFF\n3 1 0\n0 0 0\n1 0 zero\n");
  const { page, wrong, close } = await show(browser, html);
  await drop(page, "large.off");
  await told(page, /is valid/);
  await page.fill("[name=size]", "0.01");
  await page.click("[name=mesh]");
  await page.waitForFunction(() => document.getElementById("bar").value > 0);
  assert.match(await page.locator("#stage").innerText(), /\w+ \d+ %, \d+ s/);
  await page.click("[name=cancel]");
  await told(page, /cancelled/, 10);
  assert.ok(await page.locator("[name=download]").isDisabled());
  await page.fill("[name=memory]", "70");
  await page.click("[name=mesh]");
  await told(page, /memory.*allow more/);
  await page.fill("[name=memory]", "3500");
  await page.fill("[name=size]", "");
  await drop(page, "torn.off");
  await told(page, /torn\.off: line 4/);
  await drop(page, "large.off");
  await page.click("[name=mesh]");
  await told(page, /tetrahedra/, 120);
  nothingWrong(wrong);
  await close();
});

test("hostile names run no script", async () => {
  const name = "<img src=x onerror=alert(1)>.stl", evil = "</script><script>alert(2)</script><img src=x onerror=alert(3)>";
  const { page, wrong, close } = await show(browser, html);
  await drop(page, name, stl(cubes([[0, 0, 0, 1]]), evil));
  await told(page, /is valid/);
  await page.click("[name=mesh]");
  await told(page, /tetrahedra/);
  const frame = await viewer(page);
  await frame.selectOption("[name=colour]", "marker");
  assert.ok((await frame.locator("#legend").innerText()).includes("<script>alert(2)"));
  assert.ok((await page.locator("#chosen").innerText()).includes("<img"));
  await drop(page, `${name}.off`, `OFF\n3 1 0\n0 0 0\n1 0 ${evil}\n`);
  await told(page, /line 4/);
  assert.equal((await page.locator("img").count()) + (await frame.locator("img").count().catch(() => 0)), 0);
  nothingWrong(wrong);
  // Nor would a script that was let in.
  await page.evaluate(() => {
    const script = document.createElement("script");
    script.textContent = "window.ran = true";
    document.body.append(script);
  });
  assert.equal(await page.evaluate(() => window.ran), undefined);
  assert.match(await page.evaluate(() => document.querySelector("meta[http-equiv]").content), /^default-src 'none'; script-src 'sha256-[^;]*'wasm-unsafe-eval';/);
  await close();
});

test("from a host, the same; the package in a module Worker", async () => {
  const types = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm" };
  const server = createServer((request, response) => {
    const path = new URL(request.url, "http://x").pathname;
    if (path === "/favicon.ico") return void response.writeHead(404).end();
    if (path === "/blank.html") return void response.writeHead(200, { "content-type": "text/html" }).end("<!DOCTYPE html><title>blank</title>");
    response.writeHead(200, { "content-type": types[path.slice(path.lastIndexOf("."))] ?? "application/octet-stream" });
    response.end(readFileSync(join(html, "..", path)));
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  const host = `http://127.0.0.1:${server.address().port}`, context = await browser.newContext(), page = await context.newPage(), asked = [];
  page.on("request", (request) => asked.push(request.url()));
  await page.goto(`${host}/index.html`);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "yes");
  writeFileSync(at("cube.stl"), stl(cubes([[0, 0, 0, 1]])));
  await drop(page, "cube.stl");
  await page.click("[name=mesh]");
  await told(page, /tetrahedra/);
  ok("mesh", "cube.stl", "-o", "cube.vtu", "-q");
  await same(page, "cube.vtu");
  assert.deepEqual(asked.filter((url) => !url.startsWith("blob:") && !url.endsWith("/favicon.ico")), [`${host}/index.html`]);
  await page.goto(`${host}/blank.html`);
  const bytes = await page.evaluate(async (text) => {
    const { startWorker, load } = await import("/npm/index.js");
    const cube = { name: "cube.stl", bytes: new TextEncoder().encode(text) };
    const worker = startWorker(), inWorker = await worker.mesh(cube, { format: ".vtu" }), here = (await load()).mesh(cube, { format: ".vtu" });
    worker.close();
    return [inWorker, here].map(({ files }) => [...files[0].bytes]);
  }, readFileSync(at("cube.stl"), "utf8"));
  for (const of of bytes) assert.ok(Buffer.from(of).equals(readFileSync(at("cube.vtu"))));
  await context.close();
  server.close();
});
