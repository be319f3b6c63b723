// Pictures of every section of a report: node take_pictures.mjs REPORT.html FOLDER [WIDTH THEME]...
// Widths and themes default to 1280 and 390, light and dark.
import { mkdir } from "node:fs/promises";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { openPage, showSection, startBrowser, withWindow } from "./browser.mjs";

const [report, folder, ...looks] = process.argv.slice(2);
if (!folder) {
  console.error("usage: node take_pictures.mjs REPORT.html FOLDER [WIDTH THEME]...");
  process.exit(2);
}
if (!looks.length) looks.push("1280", "light", "1280", "dark", "390", "light", "390", "dark");
await mkdir(folder, { recursive: true });

const browser = await startBrowser();
for (let k = 0; k < looks.length; k += 2) {
  const [width, theme] = [Number(looks[k]), looks[k + 1]];
  const viewport = { width, height: width < 720 ? 844 : 900 };
  await withWindow(browser, { viewport, colorScheme: theme }, async (context) => {
    const page = await openPage(context, pathToFileURL(resolve(report)).href);
    const sections = await page.locator("section").evaluateAll((all) => all.map((section) => section.id));
    for (const id of sections) {
      await showSection(page, id);
      await page.locator(`#${id}`).screenshot({ path: `${folder}/${id}-${width}-${theme}.png` });
    }
  });
}
await browser.close();
