// Chromium without a window, for the tests of the page and for its pictures.
import { chromium } from "playwright-core";

const flags = [
  "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync",
];

/** A browser of an empty profile of its own. Nothing here has a time limit: a busy machine is no failure. */
export const startBrowser = () => chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", headless: true, args: flags, timeout: 0 });

/** Calls `use(context)` with a window that shares nothing with the browser's others, and closes it. */
export async function withWindow(browser, options, use) {
  const context = await browser.newContext(options);
  context.setDefaultTimeout(0);
  try {
    return await use(context);
  } finally {
    await context.close();
  }
}

/** Opens a page and waits until its script has run. */
export async function openPage(context, url) {
  const page = await context.newPage();
  await page.goto(url);
  await page.waitForSelector("html[data-ready]");
  return page;
}

/**
 * Scrolls to a section, over its pictures so that each is drawn, and back to its start. Asks from here and moves again
 * until it is: a browser on a busy machine may paint no further frame by itself, and what waits for one waits for ever.
 */
export async function showSection(page, id) {
  for (const picture of await page.locator(`#${id} .plot, #${id} canvas`).elementHandles()) {
    const places = ["start", "center"];
    for (let tries = 0; ; ++tries) {
      await picture.evaluate((one, block) => one.scrollIntoView({ block }), places[tries % places.length]);
      if (await picture.evaluate((one) => one.dataset.stale === "false")) break;
      await new Promise((resolve) => setTimeout(resolve, 20));
    }
  }
  await page.locator(`#${id}`).evaluate((section) => section.scrollIntoView());
}
