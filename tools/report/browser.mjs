// Chromium without a window, for the tests of the page and for its pictures.
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { chromium } from "playwright-core";

const flags = [
  "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];

/** Calls `use(context)` with a browser of an empty profile of its own, and closes it. */
export async function withBrowser(options, use) {
  const profile = await mkdtemp(join(tmpdir(), "drillstrand-browser-"));
  const context = await chromium.launchPersistentContext(profile, {
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    headless: true,
    args: flags,
    ...options,
  });
  try {
    return await use(context);
  } finally {
    await context.close();
    await rm(profile, { recursive: true, force: true });
  }
}

/** Opens a page and waits until its script has run. */
export async function openPage(context, url) {
  const page = await context.newPage();
  await page.goto(url);
  await page.waitForSelector("html[data-ready]");
  return page;
}

/** Scrolls to a section, over its pictures so that each is drawn, and back to its start. */
export async function showSection(page, id) {
  for (const picture of await page.locator(`#${id} .plot, #${id} canvas`).elementHandles()) {
    await picture.evaluate((one) => one.scrollIntoView());
    await page.waitForFunction((one) => one.dataset.stale === "false", picture);
  }
  await page.locator(`#${id}`).evaluate((section) => section.scrollIntoView());
}
