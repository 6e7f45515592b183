// Headless Chromium for the tests and the pictures: WebGL 2 by SwiftShader, no network.
import { existsSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

export const executable = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(existsSync);

export async function open() {
  return chromium.launch({
    executablePath: executable,
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"],
  });
}

/// A page that is ready, and a list that gets whatever goes wrong or out: requests other than for the page itself,
/// errors, dialogs.
export async function show(browser, file, { hash = "", width = 1200, height = 800, scheme = "light", seconds = 60, ratio = 1 } = {}) {
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: scheme, deviceScaleFactor: ratio, acceptDownloads: true });
  const page = await context.newPage(), wrong = [], own = pathToFileURL(file).href;
  page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith(own) && !url.startsWith("blob:") && !url.startsWith("data:")) wrong.push(`request ${url}`);
  });
  page.on("pageerror", (error) => wrong.push(`error ${error}`));
  page.on("console", (message) => {
    if (message.type() === "error") wrong.push(`console ${message.text()}`);
  });
  page.on("dialog", (dialog) => {
    wrong.push(`dialog ${dialog.message()}`);
    void dialog.dismiss();
  });
  await page.goto(own + hash);
  await page.waitForFunction(() => ["yes", "failed"].includes(document.documentElement.dataset.ready), null, { timeout: seconds * 1000 });
  return { page, wrong, close: () => context.close() };
}

/// What the page counts: triangles that are drawn, tetrahedra that are shown.
export function counts(page) {
  return page.evaluate(() => {
    const { shown, state } = window.holdfastPage;
    return { solid: shown.solid.count, cap: shown.cap.count, dangling: shown.dangling.count, tetrahedra: shown.tetrahedra, state: structuredClone(state) };
  });
}
