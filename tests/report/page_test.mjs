// The page of drillstrand report in Chromium: node page_test.mjs PROGRAM
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";

const here = fileURLToPath(new URL(".", import.meta.url));
const root = join(here, "../..");
const program = process.argv[2];
assert.ok(program, "usage: node page_test.mjs PROGRAM");
for (const [path, what] of [[process.env.CHROMIUM ?? "/usr/bin/chromium", "Chromium"],
  [join(root, "tools/report/node_modules/playwright-core"), "playwright-core"]])
  assert.ok(existsSync(path), `${what} is missing (${path}); tools/setup installs it`);
const { startBrowser, withWindow, openPage, showSection } = await import("../../tools/report/browser.mjs");

const desk = mkdtempSync(join(tmpdir(), "drillstrand-report-"));
after(async () => {
  await browser?.close();
  rmSync(desk, { recursive: true, force: true });
});
const at = (name) => join(desk, name);
const python = (script, ...options) => execFileSync("/usr/bin/python3", [join(here, script), ...options],
  { encoding: "utf8", maxBuffer: 1e9 });
const drillstrand = (...options) => execFileSync(program, options, { cwd: desk, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
const run = (name, output, ...settings) => drillstrand("run", join(root, "cases", name), "--quiet", "--threads", "1", "-o", output,
  ...settings.flatMap((setting) => ["--set", setting]));

const klbf = 4448.2216152605;
const rpm = Math.PI / 30;

/** Equal to the digits that a page prints, which are fewer than those of single precision. */
function assertClose(found, expected, what) {
  assert.equal(found.length, expected.length, `${what}: number of values`);
  const scale = Math.max(...expected.map(Math.abs), 1e-300);
  found.forEach((value, k) =>
    assert.ok(Math.abs(value - expected[k]) <= 2e-7 * scale, `${what}, value ${k}: ${value}, expected ${expected[k]}`));
}

/** What a plot shows: arrays of its traces, and its axis titles. */
const plotted = (page, name) => page.locator(`#plot-${name}`).evaluate((plot) => ({
  traces: plot.data.map(({ x, y, z, name: title }) => ({
    title, x: Array.from(x), y: Array.from(y), z: z && Array.from(z, (values) => Array.from(values)) })),
  titles: Object.entries(plot.layout).filter(([key]) => /^[xy]axis/.test(key)).map(([, axis]) => axis.title.text),
}));

/** A click that does not scroll. */
const press = (button) => button.evaluate((one) => one.click());

const sectionsOf = (page) => page.locator("section").evaluateAll((all) => all.map((section) => section.id));

async function showAll(page) {
  for (const id of await sectionsOf(page)) await showSection(page, id);
}

/**
 * Opens a page and fails if it says anything on the console or asks anything of the network. The page's
 * clock stands unless the test turns it: what plays or loads itself anew does so when the test means it to,
 * however slow the machine is.
 */
async function withPage(name, options, use) {
  await withWindow(browser, options, async (context) => {
    await context.clock.install({ time: 0 });
    await context.clock.pauseAt(1000);
    const said = [];
    const asked = [];
    context.on("request", (request) => asked.push(request.url()));
    context.on("console", (message) => said.push(`${message.type()}: ${message.text()}`));
    context.on("weberror", (error) => said.push(String(error.error())));
    const url = pathToFileURL(at(name)).href;
    await use(await openPage(context, url));
    assert.deepEqual(said, [], "console");
    assert.deepEqual(asked.filter((one) => one !== url && !/^(data|blob):/.test(one)), [], "requests");
  });
}

const wide = { viewport: { width: 1280, height: 900 } };
let browser;
let well;  // of a run in a well, read by h5py
let frame;  // a profile in its middle

before(async () => {
  browser = await startBrowser();
  run("well2_drilling.toml", "well.h5", "run.duration=12", "output.profile_interval=0.1", "output.interval=0.05",
    'head.rotation=[[0, 0], [2, "2 Hz"]]', 'bit.weight=[[2, 0], [4, "50 kN"]]',
    "output.cycles={}", 'output.sensor=[{name = "mwd", depth = "20 m", measured_from = "bit"}, {name = "top", depth = 3, interval = 1}]');
  frame = 57;
  well = JSON.parse(python("result_numbers.py", at("well.h5"), String(frame)));
  drillstrand("report", "well.h5");
});

test("every section of a run in a well is there, with the numbers of the result file", async () => {
  await withPage("well.html", wide, async (page) => {
    assert.deepEqual(await sectionsOf(page), ["summary", "traces", "head", "view", "maps", "profiles", "orbit", "sensors", "stickslip",
      "spectrum", "contact", "steps", "energy", "case"]);
    await showAll(page);
    const times = well["series/time"];
    const head = (k) => well["series/head_stress"].map((stress) => stress[k]);
    const bit = (k) => well["series/bit_stress"].map((stress) => stress[k]);
    const scaled = (values, factor) => values.map((value) => value * factor);

    const traces = (await plotted(page, "traces")).traces;
    assertClose(traces[0].x, times, "times");
    assertClose(traces[0].y, scaled(well["series/hook_load"], 1e-3), "hook load");
    assertClose(traces[1].y, scaled(well["series/weight_on_bit"], 1e-3), "weight on bit");
    assertClose(traces[2].y, scaled(well["series/surface_torque"], 1e-3), "surface torque");
    assertClose(traces[3].y, scaled(well["series/bit_torque"], 1e-3), "torque at the bit");
    assertClose(traces[4].y, scaled(well["series/bit_rotation_rate"], 1 / rpm), "rotation of the bit");
    assertClose(traces[5].y, scaled(well["series/head_rotation_rate"], 1 / rpm), "rotation of the top");

    const stresses = (await plotted(page, "head")).traces;
    assert.equal(stresses.length, 6);
    stresses.forEach(({ y }, k) => assertClose(y, scaled(head(k), 1e-3), `head stress ${k}`));

    const contact = (await plotted(page, "contact")).traces;
    assertClose(contact[0].y, scaled(well["series/max_penetration"], 1e3), "penetration");
    assertClose(contact[1].y, scaled(well["series/helix_penetration"], 1e3), "penetration of a helix");
    assertClose(contact[2].y, well["series/contact_nodes"], "nodes in contact");
    assertClose(contact[6].y, scaled(well["series/whirl_backward"], 100), "backward whirl");
    assertClose(contact[7].y, scaled(well["series/whirl_forward"], 100), "forward whirl");
    assertClose(contact[8].y, scaled(well["series/whirl_rate"], 1 / rpm), "rate of whirl");
    assertClose(contact[9].y, scaled(well["series/rolling_rate"], 1 / rpm), "rolling rate");
    assertClose(contact[10].y, scaled(well["series/wall_drag"], 1e-3), "friction along the well");
    assertClose((await plotted(page, "steps")).traces[0].y, scaled(well["series/step_size"], 1e3), "steps");
    const energy = (await plotted(page, "energy")).traces;
    assertClose(energy[0].y, scaled(well["series/kinetic_energy"], 1e-3), "kinetic energy");
    assertClose(energy[3].y, scaled(well["series/rotation_energy"], 1e-3), "energy of spin");
    assertClose(energy[4].y, scaled(well["series/work"], 1e-3), "work");
    assert.equal(energy.length, 7);

    const mwd = (await plotted(page, "sensors")).traces;
    assert.equal(mwd.length, 8);
    assertClose(mwd[0].x, well["sensors/mwd/time"], "times of the sensor");
    assertClose(mwd[0].y, well["sensors/mwd/acceleration"].map(([axial]) => axial), "axial acceleration");
    assertClose(mwd[2].y, well["sensors/mwd/acceleration"].map(([, , across]) => across), "acceleration along d2");
    assertClose(mwd[3].y, scaled(well["sensors/mwd/rotation_rate"], 1 / rpm), "rotation of the sensor");
    assertClose(mwd[6].y, scaled(well["sensors/mwd/torque"], 1e-3), "torque at the sensor");
    await page.locator("#sensor").selectOption({ label: "top, 3 m from the head" });
    await showSection(page, "sensors");
    assertClose((await plotted(page, "sensors")).traces[7].y, scaled(well["sensors/top/tension"], 1e-3), "tension at the top");

    const spin = (await plotted(page, "map-spin")).traces[0];
    assertClose(spin.x, well["profiles/time"], "times of the map");
    assertClose(spin.y, well["mesh/node_s"], "depths of the map");
    assertClose(spin.z[frame], scaled(well.profiles[frame].spin, 1 / rpm), "spin");
    const side = (await plotted(page, "map-side")).traces[0];
    assertClose(side.z[frame], scaled(well.profiles[frame].side, 1e-3), "side force");
    const bending = (await plotted(page, "map-bending")).traces[0];
    assert.deepEqual([bending.z.length, bending.z[0].length], [well.profile_count, well["mesh/segment_s"].length]);

    assert.equal(await page.locator("#plot-view").getAttribute("data-points"), String(well["mesh/node_s"].length));
    const orbit = (await plotted(page, "orbit")).traces;
    assert.equal(orbit[1].x.length, well.profile_count);
    const node = await page.locator("#orbit-node").evaluate((slider) => slider.valueAsNumber);
    const distance = Math.hypot(orbit[1].x[frame], orbit[1].y[frame]);
    // The file finds the nearest section from where the node was, the page from the well's survey.
    assert.ok(Math.abs(distance - 1e3 * well.profiles[frame].eccentricity[node]) < 1e-3, "eccentricity (mm)");
    const spectrum = (await plotted(page, "spectrum")).traces[0];
    assert.deepEqual([spectrum.z.length, spectrum.z[0].length], [spectrum.y.length, spectrum.x.length]);
    assert.ok((await plotted(page, "stickslip")).traces[0].y.length > 100);
    assert.ok(!traces.some(({ title }) => title === "of the motor"), "a head without a drive has no motor");

    const printed = (value, unit) => `${Number((value).toPrecision(4))} ${unit}`;
    const last = times.length - 1;
    assert.equal(await page.locator("#value-hook-load").textContent(), printed(well["series/hook_load"][last] / 1e3, "kN"));
    assert.equal(await page.locator("#value-torque").textContent(), printed(well["series/surface_torque"][last] / 1e3, "kN m"));
    assert.equal(await page.locator("#value-bit-rotation").textContent(), printed(well["series/bit_rotation_rate"][last] / rpm, "rpm"));
    const subjects = well.findings.map((finding) => finding.split(": ")[0]);
    assert.deepEqual([...new Set(subjects)], ["stick-slip", "bounce", "whirl", "walls", "penetration", "cycles"]);
    for (const [k, finding] of well.findings.entries()) {
      const [subject, ...what] = finding.split(": ");
      const before = k - subjects.indexOf(subject);
      const id = `#value-finding-${subject}${before ? `-${before + 1}` : ""}`;
      assert.equal(await page.locator(id).textContent(), what.join(": "));
    }
    assert.equal(await page.locator("h1").textContent(), well.attributes.title);
    assert.equal(await page.locator(".status").textContent(), "complete");
  });
});

test("a click changes SI to the field's units everywhere, and back", async () => {
  await withPage("well.html", wide, async (page) => {
    await page.locator('[data-units="field"]').click();
    await showSection(page, "traces");
    const { traces, titles } = await plotted(page, "traces");
    assertClose(traces[0].y, well["series/hook_load"].map((load) => load / klbf), "hook load");
    assert.deepEqual(titles.sort(), ["Time (s)", "in", "kft lbf", "klbf", "klbf", "rpm"]);
    await showSection(page, "maps");
    const map = await plotted(page, "map-spin");
    assertClose(map.traces[0].y, well["mesh/node_s"].map((s) => s / 0.3048), "depths in feet");
    assert.ok(map.titles.includes("Depth along the string (ft)"));
    const last = well["series/hook_load"].at(-1);
    assert.equal(await page.locator("#value-hook-load").textContent(), `${Number((last / klbf).toPrecision(4))} klbf`);
    await page.locator('[data-units="si"]').click();
    await showSection(page, "traces");
    assertClose((await plotted(page, "traces")).traces[0].y, well["series/hook_load"].map((load) => load / 1e3), "hook load");
  });
});

test("sliders, lists and the play button change what is shown", async () => {
  await withPage("well.html", wide, async (page) => {
    const setSlider = (selector, value) => page.locator(selector).first().evaluate((slider, to) => {
      slider.value = to;
      slider.dispatchEvent(new Event("input"));
    }, value);
    // pictures above that are drawn meanwhile move it out of sight, where it is not drawn
    const drawn = () => page.waitForFunction(() => {
      const canvas = document.querySelector("#plot-view");
      if (canvas.dataset.stale === "true") canvas.scrollIntoView();
      return canvas.dataset.stale === "false";
    });
    const drawing = async () => {
      await drawn();
      return page.locator("#plot-view").evaluate((canvas) => canvas.toDataURL());
    };
    await showSection(page, "view");
    await setSlider("#view .time-slider", frame);
    await drawn();
    assert.equal(await page.locator("#plot-view").getAttribute("data-frame"), String(frame));
    assert.equal(await page.locator("#view .time-text").textContent(), `${Number(well["profiles/time"][frame].toPrecision(6))} s`);
    let before = await drawing();
    const changes = async (what, action) => {
      await action();
      const now = await drawing();
      assert.notEqual(now, before, what);
      before = now;
    };
    const factor = await page.locator("#view-factor").textContent();
    await changes("magnified", () => setSlider("#view-magnify", 0.5));
    assert.notEqual(await page.locator("#view-factor").textContent(), factor);
    for (const field of ["torque", "bending", "mises", "side", "spin", "axial"])
      await changes(field, () => page.locator("#view-field").selectOption(field));
    await changes("zoom", () => page.locator('#view button[title="Nearer"]').click());
    await changes("turned", async () => {
      const box = await page.locator("#plot-view").boundingBox();
      await page.mouse.move(box.x + 200, box.y + 200);
      await page.mouse.down();
      await page.mouse.move(box.x + 300, box.y + 220);
      await page.mouse.up();
    });

    await showSection(page, "profiles");
    const lines = (await plotted(page, "profiles")).traces.filter(({ title }) => title);
    assert.equal(lines.length, 7);
    const now = well.profiles[frame];
    assertClose(lines[0].x, now.axial.map((value) => value / 1e3), "axial force");
    assertClose(lines[0].y, well["mesh/segment_s"], "depths");
    assertClose(lines[1].x, now.torque.map((value) => value / 1e3), "torque");
    assertClose(lines[4].x, now.side.map((value) => value / 1e3), "side force");
    assertClose(lines[5].x, now.whirl.map((value) => value / rpm), "rate of whirl");
    assertClose(lines[6].x, now.spin.map((value) => value / rpm), "spin");

    await showSection(page, "orbit");
    const before_orbit = (await plotted(page, "orbit")).traces[1].x;
    await setSlider("#orbit-node", 100);
    assert.notDeepEqual((await plotted(page, "orbit")).traces[1].x, before_orbit);

    await showSection(page, "spectrum");
    const surface = (await plotted(page, "spectrum")).traces[0].z;
    await page.locator("#spectrum-channel").selectOption("bit_torque");
    assert.notDeepEqual((await plotted(page, "spectrum")).traces[0].z, surface);

    await showSection(page, "view");
    await setSlider("#view .time-slider", 0);
    await page.locator("#view .play").click();
    await page.clock.runFor(500);
    assert.ok(Number(await page.locator("#plot-view").getAttribute("data-frame")) > 3);
    assert.equal(await page.locator("#view .play").textContent(), "Pause");
    await page.locator("#view .play").click();
    assert.equal(await page.locator("#view .play").textContent(), "Play");
  });
});

test("the page is light or dark as the system is, and as the button says", async () => {
  const ground = (page) => page.evaluate(() => {
    const [r, g, b] = getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number);
    return (r + g + b) / 3 > 128 ? "light" : "dark";
  });
  const axisColour = (page) => page.locator("#plot-traces").evaluate((plot) => plot.layout.xaxis.tickfont.color);
  for (const theme of ["light", "dark"])
    await withPage("well.html", { ...wide, colorScheme: theme }, async (page) => {
      assert.equal(await ground(page), theme);
      await showSection(page, "traces");
      const axis = await axisColour(page);
      await page.locator("#theme").click();
      assert.notEqual(await ground(page), theme);
      assert.notEqual(await axisColour(page), axis);
      await page.reload();
      await page.waitForSelector("html[data-ready]");
      assert.notEqual(await ground(page), theme, "the choice is kept");
    });
});

test("all axes have titles and nothing sticks out of the page, on a desk or on a telephone", async () => {
  for (const width of [1280, 390])
    await withPage("well.html", { viewport: { width, height: 844 } }, async (page) => {
      await showAll(page);
      const bare = await page.locator(".plot").evaluateAll((plots) => plots.flatMap((plot) =>
        Object.entries(plot.layout).filter(([key, axis]) => /^[xy]axis/.test(key) && axis.showticklabels !== false && !axis.title.text)
          .map(([key]) => `${plot.id} ${key}`)));
      assert.deepEqual(bare, []);
      assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= width, `${width} pixels`);
      const out = await page.locator("section *").evaluateAll((all) => all.filter((one) =>
        !one.closest(".compare, pre, svg, .bar") && one.getBoundingClientRect().right > window.innerWidth + 1).map((one) => one.outerHTML.slice(0, 80)));
      assert.deepEqual(out, []);
    });
});

test("a bit that sticks has the index of the findings, and its drive the torque of the motor", async () => {
  run("stick_slip.toml", "stuck.h5", "run.duration=60", "output.interval=0.05");
  drillstrand("report", "stuck.h5");
  const stuck = JSON.parse(python("result_numbers.py", at("stuck.h5")));
  await withPage("stuck.html", wide, async (page) => {
    await showAll(page);
    const torques = (await plotted(page, "traces")).traces;
    const drive = torques.find(({ title }) => title === "of the motor");
    assertClose(drive.y, stuck["series/drive_torque"].map((torque) => torque / 1e3), "torque of the motor");
    const [index, rate] = (await plotted(page, "stickslip")).traces;
    assert.equal(rate.x.length, stuck["series/time"].length);
    // windows of 10 s, each of which holds a whole cycle of sticking and slipping
    const last = index.y.filter((_, k) => index.x[k] > 45);
    const found = stuck.attributes.stick_slip_index;
    assert.ok(found > 1 && last.length > 50, `${found}, ${last.length}`);
    const middle = index.x.length - 20;
    const within = stuck["series/time"].flatMap((time, k) =>
      Math.abs(time - index.x[middle]) < 5 ? [stuck["series/bit_rotation_rate"][k]] : []);
    const mean = within.reduce((sum, one) => sum + one, 0) / within.length;
    const expected = (Math.max(...within) - Math.min(...within)) / (2 * mean);
    assert.ok(Math.abs(index.y[middle] - expected) < 0.01 * expected, `${index.y[middle]}, by hand ${expected}`);
    const average = last.reduce((sum, one) => sum + one, 0) / last.length;
    assert.ok(Math.abs(average - found) < 0.1 * found, `${average}, findings ${found}`);
  });
});

test("a string without a well has a page without wall, contact and whirl", async () => {
  run("cantilever.toml", "cantilever.h5", "run.duration=5", "output.profile_interval=0.1");
  drillstrand("report", "cantilever.h5", "-o", "free.html");
  await withPage("free.html", wide, async (page) => {
    await showAll(page);
    assert.deepEqual(await sectionsOf(page), ["summary", "traces", "head", "view", "maps", "profiles", "spectrum", "steps", "energy", "case"]);
  });
});

test("a page can be made of a run that has hardly begun, or not at all", async () => {
  for (const [records, profiles, sections] of [
    [1, 1, ["summary", "traces", "head", "view", "profiles", "orbit", "sensors", "contact", "steps", "energy", "case"]],
    [0, 0, ["summary", "case"]]]) {
    const name = `short${records}`;
    python("shortened_result.py", at("well.h5"), at(`${name}.h5`), String(records), String(profiles));
    drillstrand("report", `${name}.h5`);
    await withPage(`${name}.html`, wide, async (page) => {
      await showAll(page);
      assert.deepEqual(await sectionsOf(page), sections);
      assert.equal(await page.locator(".status").textContent(), "running, or killed before its end");
      assert.equal(await page.locator(".alerts li").count(), 1);
    });
  }
});

test("a long run keeps its page small and says what it left out", async () => {
  run("well2.toml", "long.h5", "run.duration=4", "output.profile_interval=0.002", "output.interval=0.0002", "mesh.segments=120");
  drillstrand("report", "long.h5");
  assert.ok(statSync(at("long.html")).size < 15e6, `${statSync(at("long.html")).size} bytes`);
  await withPage("long.html", wide, async (page) => {
    const notes = (await page.locator("#summary > .hint").allTextContents()).join(" ");
    assert.match(notes, /\d+ of 2001 profiles are drawn/);
    assert.match(notes, /10001 of 20001 records are drawn/);
    await showAll(page);
    const { x, z } = (await plotted(page, "map-spin")).traces[0];
    assert.equal(z.length, x.length);
    assert.ok(x.length >= 400 && x.at(-1) === 4);
  });
});

test("files of other commands are refused in one line", () => {
  drillstrand("buckling", join(root, "cases/buckling_weightless.toml"), "-o", "modes.h5");
  assert.throws(() => drillstrand("report", "modes.h5"), ({ status, stderr }) =>
    status === 2 && /^drillstrand: error: modes.h5: holds buckling modes, not a run over time; .*\n$/.test(stderr));
});

test("measured channels lie beside the simulated ones", async () => {
  const times = well["series/time"].filter((_, k) => k % 3 === 0);
  const hook = well["series/hook_load"].filter((_, k) => k % 3 === 0);
  // The rig's clock is a minute late, and its sensor reads 10 klbf too much.
  const rows = times.map((time, k) => `${(time + 60) / 60},${hook[k] / klbf + 10},3`);
  writeFileSync(at("rig.csv"), `time[min],hook_load[klbf],torque[kN m]\n${rows.join("\n")}\n`);
  const out = drillstrand("report", "well.h5", "-o", "rig.html", "--compare", "rig.csv", "--offset", "-60 s");
  const mean = hook.reduce((sum, value) => sum + value, 0) / hook.length;
  assert.match(out, /Hook load \(kN\), \d+ points/);
  assert.match(out, /correlation  1\.0000/);
  assert.match(out, /correlation  none/);
  const [measured, simulated] = [...out.matchAll(/mean ([-\d.]+),/g)].map((match) => Number(match[1]));
  assert.ok(Math.abs(measured - simulated - 10 * klbf / 1e3) < 0.1, `${measured}, ${simulated}`);
  assert.ok(Math.abs(simulated - mean / 1e3) < 0.01 * mean / 1e3);
  await withPage("rig.html", wide, async (page) => {
    await showAll(page);
    const lines = (await plotted(page, "traces")).traces.filter(({ title }) => title === "measured");
    assert.equal(lines.length, 2);
    assertClose(lines[0].x, times, "measured times");
    assertClose(lines[0].y, hook.map((value) => (value + 10 * klbf) / 1e3), "measured hook load");
    assert.equal(await page.locator(".compare tbody tr").count(), 4);
    assert.match(await page.locator(".compare").textContent(), /1\.0000/);
  });
});

test("--follow writes the page again until the run ends", async (context) => {
  const child = spawn(program, ["run", join(root, "cases/cantilever.toml"), "--quiet", "-o", "live.h5", "--set", "run.duration=100000"],
    { cwd: desk, stdio: "ignore" });
  const ended = new Promise((resolve) => child.on("exit", resolve));
  context.after(() => child.kill("SIGKILL"));
  const until = async (condition) => {
    while (!condition()) await new Promise((resolve) => setTimeout(resolve, 100));
  };
  const holdsRecords = () => {
    try {
      return JSON.parse(python("result_numbers.py", at("live.h5")))["series/time"].length > 2;
    } catch {
      return false;  // not there yet, or in the middle of a flush
    }
  };
  await until(holdsRecords);
  const follower = spawn(program, ["report", "live.h5", "--follow"], { cwd: desk, stdio: "ignore" });
  context.after(() => follower.kill("SIGKILL"));
  const followed = new Promise((resolve) => follower.on("exit", resolve));
  await until(() => existsSync(at("live.html")));
  await withPage("live.html", wide, async (page) => {
    const live = page.locator("#live");
    await press(live);
    assert.equal(await live.getAttribute("aria-pressed"), "false");
    await page.evaluate(() => { document.body.dataset.opened = "once"; });
    await page.clock.runFor(20000);
    await showAll(page);
    assert.equal(await page.locator('[data-opened="once"]').count(), 1, "the page stays while it is not live");
    await press(live);
    const records = async () => (await plotted(page, "traces")).traces[0].x.length;
    const before = await records();
    await showSection(page, "profiles");
    const topOfSection = () => page.locator("#profiles").evaluate((section) => section.getBoundingClientRect().top);
    const top = await topOfSection();
    const loadsItselfAnew = async () => {
      const loaded = page.waitForEvent("load");
      await page.clock.runFor(5000);
      await loaded;
      await page.waitForSelector("html[data-ready]");
    };
    await loadsItselfAnew();
    const moved = (await topOfSection()) - top;
    assert.ok(Math.abs(moved) < 2, `the page moved by ${moved} pixels`);
    // As often as it takes the follower to write the page again.
    await showSection(page, "traces");
    while ((await records()) <= before) {
      await loadsItselfAnew();
      await showSection(page, "traces");
    }
  });
  child.kill("SIGINT");
  assert.equal(await ended, 130);
  assert.equal(await followed, 0);
  assert.match(readFileSync(at("live.html"), "utf8"), /"follow":null/);
  await withPage("live.html", wide, async (page) => {
    await showAll(page);
    assert.ok(!(await page.locator("#live").isVisible()));
    assert.equal(await page.locator(".status").textContent(), "interrupted");
  });
});
