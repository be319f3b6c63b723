// What all plots share: colours, axes, and drawing only what is in sight.

/** What the reader chose. */
const state = { units: "si", frame: 0, playing: false };

const colour = (name) =>
  getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
const lineColour = (k) => colour(`line-${(k % 5) + 1}`);
const isNarrow = () => window.innerWidth < 720;

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name === "class") made.className = value;
    else if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== false) made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== null));
  return made;
}

/** A section of the page, with its link in the contents, which may be shorter than its title. */
function addSection(id, title, hint, short = title) {
  const section = element("section", { id });
  if (id !== "summary") section.append(element("h2", {}, title));
  if (hint) section.append(element("p", { class: "hint" }, hint));
  document.getElementById("main").append(section);
  document.getElementById("contents").append(element("a", { href: `#${id}` }, short));
  return section;
}

// Pictures are drawn when they come into sight, and again when units, theme or width changed.
const pictures = new Map();

const watcher = new IntersectionObserver(
  (entries) => {
    for (const { target, isIntersecting } of entries) {
      const picture = pictures.get(target);
      picture.inSight = isIntersecting;
      if (isIntersecting && picture.stale) redraw(picture);
    }
  },
  { rootMargin: "100px" },
);

function redraw(picture) {
  picture.draw();
  setStale(picture, false);
}

function setStale(picture, stale) {
  picture.stale = stale;
  picture.target.dataset.stale = stale;
}

/** Draws a picture into `target` by `draw()` whenever it is in sight and out of date. */
function addPicture(target, draw) {
  const picture = { target, draw, stale: true, inSight: false };
  pictures.set(target, picture);
  watcher.observe(target);
  return () => renew(picture);
}

/** Words with numbers in them: there from the start, and again in other units. */
function addWords(target, write) {
  addPicture(target, write);
  redraw(pictures.get(target));
}

function renew(picture) {
  setStale(picture, true);
  if (picture.inSight) redraw(picture);
}

function redrawAll() {
  for (const picture of pictures.values()) renew(picture);
}

const settings = () => ({
  displaylogo: false,
  responsive: false,
  displayModeBar: isNarrow() ? false : "hover",
  modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d", "toggleSpikelines"],
  doubleClick: "reset",
});

const axisStyle = (title) => ({
  title: { text: title, standoff: 8, font: { size: 12, color: colour("soft") } },
  tickfont: { size: 11, color: colour("soft") },
  gridcolor: colour("grid"),
  zerolinecolor: colour("line"),
  linecolor: colour("line"),
  automargin: "left+width",
});

function layoutStyle(height) {
  return {
    height,
    margin: { l: 58, r: 16, t: 26, b: 44 },
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    font: { family: getComputedStyle(document.body).fontFamily, size: 12, color: colour("ink") },
    hoverlabel: { bgcolor: colour("panel"), bordercolor: colour("line"), font: { color: colour("ink") } },
    legend: { orientation: "h", x: 0, y: 1.02, yanchor: "bottom", font: { size: 12 } },
    dragmode: isNarrow() ? false : "zoom",
    hovermode: "x unified",
  };
}

/** A plot by Plotly in a panel of its own; `describe()` gives its traces and layout. */
function addPlot(parent, name, describe, look = "") {
  const plot = element("div", { class: "plot", id: `plot-${name}` });
  parent.append(element("div", { class: `panel ${look}` }, plot));
  plot.style.minHeight = "200px";
  return addPicture(plot, () => {
    const { traces, layout } = describe();
    plot.style.minHeight = `${layout.height}px`;
    Plotly.react(plot, traces, layout, settings());
  });
}

const sequential = "Viridis";

/** For signed values: blue below, orange above, the middle as pale or dark as the page. */
const diverging = () => [
  [0, colour("low")],
  [0.5, colour("middle")],
  [1, colour("high")],
];

const hover = (name, quantity) =>
  `%{y:.5~g} ${unitOf(quantity)}<extra>${name}</extra>`;

/**
 * Least and greatest value of each of `buckets` stretches of a line, in the order of time: what a
 * screen can show of a line of many points. Short lines stay as they are.
 */
function envelope(time, values, buckets = 1500) {
  if (values.length <= 2 * buckets) return { x: time, y: values };
  const x = [];
  const y = [];
  for (let k = 0; k < buckets; ++k) {
    const from = Math.floor((k * values.length) / buckets);
    const to = Math.floor(((k + 1) * values.length) / buckets);
    let least = from;
    let most = from;
    for (let i = from; i < to; ++i) {
      if (values[i] < values[least]) least = i;
      if (values[i] > values[most]) most = i;
    }
    for (const i of least < most ? [least, most] : [most, least]) {
      x.push(time[i]);
      y.push(values[i]);
    }
  }
  return { x, y };
}

/** A line over time of values in SI. */
function timeLine(name, values, quantity, look = {}) {
  const points = envelope(look.time ?? array("series/time"), values);
  return {
    type: "scatter",
    mode: points.x.length > 1 && !look.points ? "lines" : "markers",
    name,
    x: points.x,
    y: converted(points.y, quantity),
    line: { width: 1.4, color: lineColour(look.colour ?? 0), dash: look.dash ?? "solid" },
    marker: { size: look.points ? 3 : 6, color: lineColour(look.colour ?? 0) },
    hovertemplate: hover(name, quantity),
    yaxis: look.axis ?? "y",
    showlegend: look.legend ?? true,
  };
}

/**
 * Strips over one time axis, one under the other. Each has a title, a quantity and lines
 * { name, values, colour, dash, points, time }; a strip of one line needs no name beside its title.
 */
function stripPlot(strips, stripHeight = 150) {
  const gap = 34;
  const height = strips.length * (stripHeight + gap) + 60;
  const layout = layoutStyle(height);
  layout.margin = { l: 64, r: 16, t: 34, b: 46 };
  layout.legend = undefined;
  layout.showlegend = false;
  layout.annotations = [];
  const inner = height - layout.margin.t - layout.margin.b;
  const step = (inner + gap) / strips.length;
  const traces = [];
  strips.forEach((strip, k) => {
    const suffix = k === 0 ? "" : `${k + 1}`;
    const top = 1 - (k * step) / inner;
    const bottom = Math.max(0, 1 - (k * step + step - gap) / inner);
    layout[`yaxis${suffix}`] = {
      ...axisStyle(unitOf(strip.quantity) || strip.unit || "number"),
      domain: [bottom, top],
      ...(strip.type ? { type: strip.type, exponentformat: "power" } : {}),
      ...(strip.range ? { range: strip.range } : {}),
    };
    const names = strip.lines
      .filter((line) => line.name)
      .map((line) => `<span style="color:${lineColour(line.colour ?? 0)}">${line.name}</span>`);
    layout.annotations.push({
      text: `<b>${strip.title}</b>${isNarrow() && names.length > 2 ? "<br>" : "   "}${names.join("   ")}`,
      align: "left",
      xref: "paper", yref: "paper", x: 0, y: top, xanchor: "left", yanchor: "bottom",
      showarrow: false, font: { size: 12.5 },
    });
    for (const line of strip.lines)
      traces.push(timeLine(line.name || strip.title, line.values, strip.quantity,
        { colour: line.colour, dash: line.dash, points: line.points, time: line.time, axis: `y${suffix}` }));
  });
  layout.xaxis = { ...axisStyle("Time (s)"), anchor: `y${strips.length > 1 ? strips.length : ""}` };
  return { traces, layout };
}
