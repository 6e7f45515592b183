// The page in headless Chromium: each control changes what it should, no request leaves, foreign names stay text.
//   HOLDFAST=build/release/holdfast node --test viewer/test/*.test.mjs
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { counts, open, show } from "./browser.mjs";

const holdfast = resolve(process.env.HOLDFAST ?? "build/release/holdfast");
const examples = resolve(import.meta.dirname ?? ".", "../../examples");
let browser, folder;
const at = (name) => join(folder, name);
const run = (...words) => spawnSync(holdfast, words, { cwd: folder, encoding: "utf8" });

const corners = (x, y, z, s) => [0, 1].flatMap((k) => [0, 1].flatMap((j) => [0, 1].map((i) => [x + s * i, y + s * j, z + s * k])));
const faces = [[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3], [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]];
function off(cubes) {
  const points = cubes.flatMap(([x, y, z, s]) => corners(x, y, z, s));
  const triangles = cubes.flatMap((_, i) => faces.map((f) => f.map((v) => v + 8 * i)));
  return `OFF\n${points.length} ${triangles.length} 0\n${points.map((p) => p.join(" ")).join("\n")}\n${triangles.map((t) => `3 ${t.join(" ")}`).join("\n")}\n`;
}

before(async () => {
  browser = await open();
  folder = mkdtempSync(join(tmpdir(), "holdfast-web-"));
  execFileSync("python3", [join(examples, "make_part.py"), at("part.stl")]);
  run("mesh", "part.stl", "-o", "part.vtu", "--fill", "-q", "--html", "part.html");
  writeFileSync(at("shells.off"), off([[0, 0, 0, 3], [1, 1, 1, 1]]));
  run("mesh", "shells.off", "-o", "shells.vtu", "--keep", "bounded", "--size", "0.4", "-q", "--region", "1.5,1.5,1.5,7", "--name", "region:7=core", "--html", "shells.html");
  const many = Array.from({ length: 13 }, (_, i) => [[3 * i, 0, 0, 1], [3 * i + 0.5, 0.25, 0.125, 1]]).flat();
  writeFileSync(at("crossing.off"), off(many));
  run("diagnose", "crossing.off", "-q", "--html", "crossing.html", "--report", "crossing.json");
});
after(async () => {
  await browser?.close();
  if (folder) rmSync(folder, { recursive: true });
});

// A digest, so that a failure prints no picture.
const pixels = async (page) => createHash("sha256").update(await page.locator("#canvas").screenshot()).digest("hex");
const settle = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/// Does something to a page and gives what it counts and looks like before and after.
async function change(page, action) {
  await settle(page);
  const was = { ...(await counts(page)), pixels: await pixels(page) };
  await action();
  await settle(page);
  return { was, is: { ...(await counts(page)), pixels: await pixels(page) } };
}

test("cut, cap, flip, position and the free plane", async () => {
  const { page, wrong, close } = await show(browser, at("part.html"));
  let { was, is } = await change(page, () => page.check("[name=cut]"));
  assert.ok(is.tetrahedra < was.tetrahedra && is.tetrahedra > 0);
  assert.notEqual(is.pixels, was.pixels);
  const half = is.tetrahedra;
  ({ is } = await change(page, () => page.check("[name=flip]")));
  assert.ok(is.tetrahedra + half > was.tetrahedra, "what the plane cuts belongs to both sides");
  ({ was, is } = await change(page, () => page.selectOption("[name=cap]", "flat")));
  assert.ok(is.cap > 0 && was.cap === 0);
  assert.notEqual(is.pixels, was.pixels);
  await page.selectOption("[name=cap]", "crinkle");
  await page.uncheck("[name=flip]");
  ({ was, is } = await change(page, () => page.locator("[name=position]").fill("0.2")));
  assert.ok(is.tetrahedra < was.tetrahedra);
  for (const axis of ["y", "z"]) {
    ({ was, is } = await change(page, () => page.selectOption("[name=axis]", axis)));
    assert.notEqual(is.pixels, was.pixels);
  }
  await page.selectOption("[name=axis]", "free");
  ({ was, is } = await change(page, async () => {
    await page.fill("[name=nx]", "0");
    await page.fill("[name=ny]", "-1");
    await page.fill("[name=nz]", "0.5");
    await page.keyboard.press("Tab");
  }));
  assert.notEqual(is.tetrahedra, was.tetrahedra);
  ({ was, is } = await change(page, () => page.click("[name=facing]")));
  assert.notDeepEqual([is.state.nx, is.state.ny, is.state.nz], [0, -1, 0.5]);
  assert.deepEqual(wrong, []);
  await close();
});

test("wheel: goes near, drags the plane", async () => {
  const { page, wrong, close } = await show(browser, at("part.html"), { hash: "#cut=true" });
  await page.mouse.move(400, 400);
  let { was, is } = await change(page, () => page.mouse.wheel(0, -300));
  assert.ok(is.state.view[7] < was.state.view[7] && is.state.position === was.state.position);
  await page.selectOption("[name=wheel]", "plane");
  ({ was, is } = await change(page, () => page.mouse.wheel(0, 500)));
  assert.ok(is.state.position > was.state.position && is.state.view[7] === was.state.view[7]);
  assert.notEqual(is.pixels, was.pixels);
  ({ was, is } = await change(page, async () => {
    await page.mouse.down();
    await page.mouse.move(500, 450, { steps: 3 });
    await page.mouse.up();
  }));
  assert.notDeepEqual(is.state.view.slice(0, 4), was.state.view.slice(0, 4));
  assert.deepEqual(wrong, []);
  await close();
});

test("colours, each with a legend", async () => {
  const { page, wrong, close } = await show(browser, at("shells.html"), { hash: "#cut=true" });
  const seen = new Set();
  for (const [colour, word] of [["region", "core"], ["marker", "marker"], ["angle", "°"], ["q", "1.25"], ["size", "–"], ["forced", "facets force"]]) {
    await page.selectOption("[name=colour]", colour);
    await settle(page);
    seen.add(await pixels(page));
    assert.ok((await page.locator("#legend").innerText()).includes(word), colour);
  }
  assert.ok(seen.size >= 5, `${seen.size} different pictures`);
  await page.selectOption("[name=colour]", "region");
  const { was, is } = await change(page, () => page.uncheck("[name=show-r7]"));
  assert.ok(is.tetrahedra < was.tetrahedra);
  assert.deepEqual(wrong, []);
  await close();
});

test("layers", async () => {
  const { page, wrong, close } = await show(browser, at("shells.html"), { hash: "#cut=true" });
  for (const layer of ["surface", "elements", "edges"]) {
    const { was, is } = await change(page, () => page.click(`[name=${layer}]`));
    assert.notEqual(is.state[layer], was.state[layer]);
    assert.notEqual(is.pixels, was.pixels, layer);
    await page.click(`[name=${layer}]`);
  }
  // Points are seen where nothing hides them.
  await page.click("[name=surface]");
  await page.click("[name=elements]");
  const { was, is } = await change(page, () => page.click("[name=added]"));
  assert.notEqual(is.pixels, was.pixels, "added");
  assert.deepEqual(wrong, []);
  await close();
});

test("dangling triangles and segments", async () => {
  writeFileSync(at("inside.poly"), "12 3 0 0\n" + [...corners(0, 0, 0, 1), [0.3, 0.3, 0.5], [0.7, 0.3, 0.5], [0.5, 0.7, 0.5], [0.5, 0.5, 0.8]].map((p, i) => `${i} ${p.join(" ")}\n`).join("")
    + "14 0\n" + [...faces, [8, 9, 10]].map((f) => `1\n3 ${f.join(" ")}\n`).join("") + "1\n2 10 11\n0\n0\n");
  const ended = run("mesh", "inside.poly", "-o", "inside.vtu", "--fill", "-q", "--html", "inside.html");
  assert.equal(ended.status, 0, ended.stderr);
  const { page, wrong, close } = await show(browser, at("inside.html"), { hash: "#elements=false&surface=false" });
  assert.equal((await counts(page)).dangling, 1);
  for (const layer of ["dangling", "segments"]) {
    const { was, is } = await change(page, () => page.click(`[name=${layer}]`));
    assert.notEqual(is.pixels, was.pixels, layer);
    if (layer === "dangling") assert.equal(is.dangling, 0);
  }
  assert.deepEqual(wrong, []);
  await close();
});

test("histogram bars choose elements; the worst are listed and flown to", async () => {
  const { page, wrong, close } = await show(browser, at("shells.html"));
  await page.click("[name=tab-elements]");
  const bars = await page.locator("#bars button .count").allInnerTexts();
  assert.equal(bars.map(Number).reduce((a, b) => a + b), (await counts(page)).tetrahedra);
  const bar = bars.findIndex((count) => Number(count) > 0);
  let { was, is } = await change(page, () => page.click(`[name=bar-${bar}]`));
  assert.equal(is.tetrahedra, Number(bars[bar]));
  assert.notEqual(is.pixels, was.pixels);
  await page.click("[name=clear]");
  assert.equal((await counts(page)).tetrahedra, was.tetrahedra);
  for (const worst of ["angle", "q", "size"]) {
    await page.selectOption("[name=worst]", worst);
    assert.ok((await page.locator("#worst li").count()) === Math.min(100, was.tetrahedra));
  }
  await page.selectOption("[name=worst]", "angle");
  ({ was, is } = await change(page, () => page.click("[name=worst-0]")));
  assert.ok(is.state.element >= 0);
  assert.notDeepEqual(is.state.view.slice(4, 7), was.state.view.slice(4, 7));
  const told = await page.locator("#picked-text").innerText();
  const least = Math.min(...told.match(/dihedral angles ([\d. ]+) degrees/)[1].split(" ").map(Number));
  assert.ok(Math.abs(least - Number((await page.locator("[name=worst-0]").innerText()).match(/: ([\d.]+)°/)[1])) < 0.01 * least + 1e-3);
  for (const quantity of ["q", "size"]) {
    await page.selectOption("[name=histogram]", quantity);
    assert.ok((await page.locator("#bars button").count()) > 5);
  }
  assert.deepEqual(wrong, []);
  await close();
});

test("every defect is found in two clicks", async () => {
  const { page, wrong, close } = await show(browser, at("crossing.html"));
  const report = JSON.parse(readFileSync(at("crossing.json"), "utf8"));
  assert.ok(report.defects.length >= 100);
  const buttons = page.locator("#tab-defects button[data-entry]");
  const texts = await buttons.allInnerTexts();
  for (const defect of report.defects) assert.ok(texts.some((text) => text.includes(defect.message)));
  const seen = new Set(), pictures = new Set();
  // The first click is on the tab, where another one is open; the second on the message.
  await page.click("[name=tab-view]");
  await page.click("[name=tab-defects]");
  for (let i = 0; i < texts.length; ++i) {
    await buttons.nth(i).click();
    const { state } = await counts(page);
    assert.equal(state.entry, Number(await buttons.nth(i).getAttribute("data-entry")));
    seen.add(state.view.slice(4, 7).join());
    if (i % Math.ceil(texts.length / 12) !== 0) continue;
    await settle(page);
    pictures.add(await pixels(page));
  }
  const places = new Set(report.defects.map(({ where }) => where.map(String).sort().join(" ")));
  assert.ok(seen.size >= 0.9 * places.size && pictures.size > 8, `${seen.size} of ${places.size} places, ${pictures.size} pictures`);
  let { was, is } = await change(page, () => page.click("[name=next]"));
  assert.equal(is.state.entry, (was.state.entry + 1) % texts.length);
  ({ was, is } = await change(page, () => page.keyboard.press("g")));
  assert.notEqual(is.pixels, was.pixels);
  ({ is } = await change(page, () => page.click("[name=leave]")));
  assert.equal(is.state.entry, -1);
  assert.deepEqual(wrong, []);
  await close();
});

test("previous, ghost, whole part, help, closing what was picked", async () => {
  const { page, wrong, close } = await show(browser, at("crossing.html"));
  const whole = (await counts(page)).state.view;
  await page.click("[name=tab-defects]");
  await page.locator("#tab-defects button[data-entry]").nth(3).click();
  let { was, is } = await change(page, () => page.click("[name=previous]"));
  assert.deepEqual([was.state.entry, is.state.entry], [3, 2]);
  await page.click("[name=tab-view]");
  ({ was, is } = await change(page, () => page.click("[name=ghost]")));
  assert.notEqual(is.state.ghost, was.state.ghost);
  assert.notEqual(is.pixels, was.pixels);
  ({ is } = await change(page, () => page.click("[name=reset]")));
  assert.deepEqual(is.state.view.slice(4), whole.slice(4));
  await page.click("[name=tab-help]");
  assert.ok(await page.locator("#tab-help").isVisible());
  assert.match(await page.locator("#tab-help").innerText(), /next, previous defect/);
  assert.deepEqual(wrong, []);
  await close();
  const part = await show(browser, at("part.html"));
  const box = await part.page.locator("#canvas").boundingBox();
  await part.page.mouse.click(box.x + box.width / 2, box.y + box.height * 0.62);
  assert.ok(await part.page.locator("#picked").isVisible());
  await part.page.click("[name=unpick]");
  assert.ok(await part.page.locator("#picked").isHidden());
  assert.deepEqual(part.wrong, []);
  await part.close();
});

test("pick tells 17 digits, and copies", async () => {
  const { page, wrong, close } = await show(browser, at("part.html"));
  const box = await page.locator("#canvas").boundingBox();
  await page.mouse.click(box.x + box.width / 2, box.y + box.height * 0.62);
  const told = await page.locator("#picked-text").innerText();
  assert.match(told, /^tetrahedron \d+, region/);
  assert.match(told, /vertex \d+[^:]*: -?[\d.e+-]+ -?[\d.e+-]+ -?[\d.e+-]+/);
  const digits = told.match(/volume ([\d.e+-]+)/)[1].replace(/e.*/, "").replace(/^0\.0*/, "").replace(".", "");
  assert.equal(digits.length, 17);
  assert.match(told, /dihedral angles( [\d.]+){6}|dihedral angles [\d. ]+/);
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]).catch(() => {});
  await page.click("[name=copy]");
  assert.equal(await page.evaluate(() => navigator.clipboard.readText()), told);
  assert.deepEqual(wrong, []);
  await close();
});

test("the address keeps the state", async () => {
  const one = await show(browser, at("part.html"));
  await one.page.check("[name=cut]");
  await one.page.selectOption("[name=axis]", "z");
  await one.page.selectOption("[name=colour]", "angle");
  await one.page.locator("[name=position]").fill("0.3");
  await one.page.mouse.move(400, 400);
  await one.page.mouse.wheel(0, -200);
  await one.page.waitForTimeout(500);
  const hash = new URL(one.page.url()).hash, was = await counts(one.page);
  await one.close();
  const other = await show(browser, at("part.html"), { hash });
  await settle(other.page);
  assert.deepEqual((await counts(other.page)).state, was.state);
  assert.deepEqual(other.wrong, []);
  await other.close();
  const nonsense = await show(browser, at("part.html"), { hash: "#model=99&colour=%3Cb%3E&position=7&view=1,2&bars=x&__proto__=1&hidden=a" });
  assert.equal(await nonsense.page.evaluate(() => document.documentElement.dataset.ready), "yes");
  assert.deepEqual(nonsense.wrong, []);
  await nonsense.close();
});

test("PNG, keyboard, themes, phone", async () => {
  const { page, wrong, close } = await show(browser, at("part.html"));
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("[name=png]")]);
  const png = readFileSync(await download.path());
  assert.equal(png.subarray(1, 4).toString(), "PNG");
  assert.ok(png.length > 3000);
  await page.locator("#canvas").focus();
  for (const [key, test] of [["c", (s) => s.cut], ["y", (s) => s.axis === "y"], ["f", (s) => s.flip], ["k", (s) => s.cap === "flat"], ["4", (s) => s.colour === "angle"], ["]", (s) => s.position > 0.5], ["e", (s) => !s.edges], ["a", (s) => s.added]]) {
    await page.keyboard.press(key);
    assert.ok(test((await counts(page)).state), key);
  }
  const { was, is } = await change(page, () => page.selectOption("[name=theme]", "dark"));
  assert.notEqual(is.pixels, was.pixels);
  assert.deepEqual(wrong, []);
  await close();
  const phone = await show(browser, at("part.html"), { width: 390, height: 780, scheme: "dark" });
  const canvas = await phone.page.locator("#canvas").boundingBox(), panel = await phone.page.locator("#panel").boundingBox();
  assert.ok(canvas.width >= 380 && panel.y >= canvas.height - 2 && panel.width <= 390);
  assert.equal(await phone.page.evaluate(() => document.documentElement.dataset.theme), "dark");
  assert.equal(await phone.page.evaluate(() => document.documentElement.scrollWidth), 390);
  await phone.close();
});

test("tabs: verdict and report; two parts", async () => {
  run("check", "shells.off", "shells.vtu", "-q", "--html", "check.html");
  const { page, wrong, close } = await show(browser, at("check.html"));
  await page.click("[name=tab-verdict]");
  assert.match(await page.locator("#tab-verdict").innerText(), /volumes positive/);
  await page.click("[name=tab-report]");
  assert.match(await page.locator("#tab-report").innerText(), /"holds"/);
  await page.click("[name=tab-view]");
  await page.selectOption("[name=model]", "1");
  await page.waitForFunction(() => document.getElementById("counts").textContent.startsWith("24 triangles"));
  assert.deepEqual(wrong, []);
  await close();
});

test("hostile names run no script", async () => {
  const name = "<img src=x onerror=alert(1)>.off", evil = "</script><script>alert(2)</script><img src=x onerror=alert(3)>";
  writeFileSync(at(name), off([[0, 0, 0, 1]]));
  const ended = run("mesh", name, "-o", "evil.vtu", "--fill", "-q", "--region", "0.5,0.5,0.5,3", "--name", `region:3=${evil}`, "--html", "evil.html");
  assert.equal(ended.status, 0, ended.stderr);
  const { page, wrong, close } = await show(browser, at("evil.html"), { hash: "#colour=region" });
  assert.ok((await page.locator("#legend").innerText()).includes(evil));
  assert.equal(await page.locator("img").count(), 0);
  // Nor would one that was let in: the policy lets no other script run.
  await page.evaluate(() => {
    const script = document.createElement("script");
    script.textContent = "window.ran = true";
    document.body.append(script);
  });
  assert.equal(await page.evaluate(() => window.ran), undefined);
  assert.ok(wrong.every((what) => /Content Security Policy/.test(what)), wrong.join());
  await close();
});

test("a million tetrahedra open within 30 s", async () => {
  let seed = 1;
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
  writeFileSync(at("cloud.xyz"), Array.from({ length: 151000 }, () => `${random()} ${random()} ${random()}\n`).join(""));
  assert.equal(run("delaunay", "cloud.xyz", "-o", "cloud.vtu", "-q").status, 0);
  assert.equal(run("view", "cloud.vtu", "-o", "cloud.html").status, 0);
  const { page, wrong, close } = await show(browser, at("cloud.html"), { seconds: 120 });
  const { tetrahedra } = await counts(page), seconds = await page.evaluate(() => Number(document.documentElement.dataset.seconds));
  console.log(`${tetrahedra} tetrahedra, ${readFileSync(at("cloud.html")).length} bytes, opened in ${seconds} s`);
  assert.ok(tetrahedra >= 1e6 && seconds < 30);
  const { is, was } = await change(page, () => page.check("[name=cut]"));
  assert.ok(is.tetrahedra < was.tetrahedra);
  assert.deepEqual(wrong, []);
  await close();
});
