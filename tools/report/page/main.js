// The page: its sections in order, the switches above them, and reloading while a run goes on.

/**
 * What is stored as `key`, or stores `value` there; null takes it away. Storage may be refused, to
 * files above all.
 */
function remembered(store, key, value) {
  try {
    if (value === undefined) return window[store].getItem(`drillstrand-${key}`);
    if (value === null) window[store].removeItem(`drillstrand-${key}`);
    else window[store].setItem(`drillstrand-${key}`, value);
  } catch {
    // The choice then lasts as long as the page.
  }
  return null;
}

function setUnits(units) {
  state.units = units;
  for (const button of document.querySelectorAll("#units button"))
    button.setAttribute("aria-pressed", String(button.dataset.units === units));
  remembered("localStorage", "units", units);
  redrawAll();
}

function setTheme(theme) {
  document.documentElement.dataset.theme = theme;
  redrawAll();
}

const systemTheme = window.matchMedia("(prefers-color-scheme: dark)");
const themeNow = () => remembered("localStorage", "theme") ?? (systemTheme.matches ? "dark" : "light");

function listenToSwitches() {
  document.getElementById("units").addEventListener("click", (event) => {
    const { units } = event.target.dataset;
    if (units) setUnits(units);
  });
  document.getElementById("theme").addEventListener("click", () => {
    const theme = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
    remembered("localStorage", "theme", theme);
    setTheme(theme);
  });
  systemTheme.addEventListener("change", () => setTheme(themeNow()));
  let width = window.innerWidth;
  window.addEventListener("resize", () => {
    if (window.innerWidth === width) return;
    width = window.innerWidth;
    redrawAll();
    for (const plot of document.querySelectorAll(".plot"))
      if (plot.data) Plotly.Plots.resize(plot);
  });
}

/** Marks in the contents the section that is being read. */
function followReading() {
  const links = new Map([...document.querySelectorAll("#contents a")].map((link) => [link.hash.slice(1), link]));
  const mark = () => {
    const current = sectionInSight().id;
    for (const [id, link] of links) {
      if (id !== current) link.removeAttribute("aria-current");
      else if (!link.hasAttribute("aria-current")) {
        link.setAttribute("aria-current", "true");
        const contents = link.parentElement;
        contents.scrollLeft = link.offsetLeft - contents.offsetLeft - 40;
      }
    }
  };
  window.addEventListener("scroll", mark, { passive: true });
  mark();
}

const sectionInSight = () =>
  [...document.querySelectorAll("section")].findLast((section) => section.getBoundingClientRect().top < 160) ??
  document.getElementById("summary");

/** The section that is read, and the heights of pictures, which have them only once they are drawn. */
function rememberPlace() {
  const section = sectionInSight();
  const last = !hasProfiles() || state.frame === frameCount() - 1;
  remembered("sessionStorage", "place", JSON.stringify({
    id: section.id, top: section.getBoundingClientRect().top, time: last ? null : array("profiles/time")[state.frame],
    heights: [...document.querySelectorAll(".plot")].map((plot) => [plot.id, plot.offsetHeight]) }));
}

function restorePlace() {
  const place = JSON.parse(remembered("sessionStorage", "place"));
  if (!place) return;
  remembered("sessionStorage", "place", null);
  history.scrollRestoration = "manual";
  if (place.time !== null && hasProfiles()) setFrame(lowerBound(array("profiles/time"), place.time));
  for (const [id, height] of place.heights)
    document.getElementById(id)?.style.setProperty("min-height", `${height}px`);
  const section = document.getElementById(place.id);
  if (section) window.scrollBy(0, section.getBoundingClientRect().top - place.top);
}

/** While drillstrand report --follow writes, the page loads itself anew and stays where it was. */
function followRun() {
  restorePlace();
  if (!metadata.follow) return;
  const live = document.getElementById("live");
  live.hidden = false;
  const isLive = () => live.getAttribute("aria-pressed") === "true";
  live.addEventListener("click", () => live.setAttribute("aria-pressed", String(!isLive())));
  setInterval(() => {
    if (!isLive() || state.playing || document.hidden) return;
    rememberPlace();
    location.reload();
  }, metadata.follow * 1000);
}

document.documentElement.dataset.theme = themeNow();
if (hasProfiles()) state.frame = frameCount() - 1;
addSummary();
addTraces();
if (metadata.measured) addComparison();
addHeadStress();
addView();
addMaps();
addProfiles();
addOrbit();
addSensors();
addStickSlip();
addSpectrum();
addContact();
addSteps();
addEnergy();
addCase();
listenToSwitches();
setUnits(remembered("localStorage", "units") === "field" ? "field" : "si");
followReading();
followRun();
document.documentElement.dataset.ready = "true";
