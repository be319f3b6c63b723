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

/** Scrolls to a section and waits until its pictures are drawn. */
export async function showSection(page, id) {
  await page.locator(`#${id}`).evaluate((section) => section.scrollIntoView());
  await page.waitForFunction((name) =>
    [...document.querySelectorAll(`#${name} .plot`)].every((plot) => plot.data) &&
    [...document.querySelectorAll(`#${name} canvas`)].every((canvas) => canvas.dataset.points), id);
  // Drawing changes the height of what is above; the section may have moved on.
  await page.waitForTimeout(200);
  await page.locator(`#${id}`).evaluate((section) => section.scrollIntoView());
  await page.waitForTimeout(100);
}
