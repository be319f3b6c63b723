// The way of one node's axis in the plane across the well.

/** Whether the profiles follow a node that goes round with the top: eight or more in a turn. */
function isOrbitResolved() {
  const time = array("profiles/time");
  if (time.length < 2 || !has("series/time")) return true;
  const [slowest, fastest] = extremes(series("head_rate"));
  return (Math.max(fastest, -slowest) * (time[1] - time[0])) / (2 * Math.PI) <= 1 / 8;
}

function addOrbit() {
  if (!metadata.well || !hasProfiles() || !has("view/clearance")) return;
  const section = addSection("orbit", "Whirl",
    "The way of the pipe's axis across the well at one place, seen down the hole, within the circle that the wall leaves it (dashed; outside it the pipe presses into the wall). " + (isOrbitResolved() ? "" :
      "The profiles drawn here are too far apart in time to follow a node that goes round with the string: points without a line. " +
      "A short run with output.profile_interval = 0.02 shows its way."));
  const node = { index: Math.max(0, array("mesh/node_s").length - 2) };
  const output = element("output", { id: "orbit-depth" });
  const slider = element("input", { type: "range", id: "orbit-node", min: 0, max: array("mesh/node_s").length - 1, step: 1,
    "aria-label": "Depth of the node", oninput: () => { node.index = slider.valueAsNumber; update(); } });
  slider.value = node.index;
  section.append(element("div", { class: "bar" }, element("label", { class: "wide" }, "Depth", slider, output)), timeBar());
  const redrawPlot = addPlot(section, "orbit", () => orbitPlot(node.index), "square");
  const update = () => {
    output.textContent = withUnit(array("mesh/node_s")[node.index], "length", 5);
    redrawPlot();
  };
  addPicture(slider, update);
  onFrame(() => {
    const plot = document.getElementById("plot-orbit");
    if (!pictures.get(plot).inSight || !plot.data) return redrawPlot();
    const [x, y] = orbitPoint(node.index, state.frame);
    Plotly.restyle(plot, { x: [[x]], y: [[y]] }, [2]);
  });
}

/** Right of and above the well's axis, in the small unit of length. */
function orbitPoint(index, frame) {
  const offset = row(array("profiles/offset"), frame);
  return [offset[2 * index + 1] * factorOf("small"), offset[2 * index] * factorOf("small")];
}

function orbitPlot(index) {
  const points = Array.from({ length: frameCount() }, (_, frame) => orbitPoint(index, frame));
  const radius = array("view/clearance")[index] * factorOf("small");
  const circle = Array.from({ length: 181 }, (_, k) => (k * Math.PI) / 90);
  const [now] = [orbitPoint(index, state.frame)];
  const reach = 1.12 * Math.max(radius, ...points.flat().map(Math.abs));
  const size = Math.min(560, document.getElementById("plot-orbit").clientWidth);
  const layout = layoutStyle(size);
  layout.showlegend = false;
  layout.hovermode = "closest";
  const vertical = array("view/vertical")[index];
  layout.xaxis = { ...axisStyle(titled(vertical ? "East" : "Right of the high side", "small")), range: [-reach, reach], constrain: "domain" };
  layout.yaxis = { ...axisStyle(titled(vertical ? "North" : "Toward the high side", "small")), range: [-reach, reach], scaleanchor: "x", constrain: "domain" };
  const time = Array.from(array("profiles/time"));
  const traces = [
    { type: "scatter", mode: "lines", name: "clearance", x: circle.map((angle) => radius * Math.cos(angle)),
      y: circle.map((angle) => radius * Math.sin(angle)), line: { width: 1.5, color: colour("ink"), dash: "dash" }, hoverinfo: "skip" },
    { type: "scatter", mode: isOrbitResolved() ? "lines+markers" : "markers", name: "axis of the pipe",
      x: points.map((point) => point[0]), y: points.map((point) => point[1]), customdata: time,
      line: { width: 0.6, color: colour("wall") },
      marker: { size: 3.5, color: time, colorscale: "Cividis", showscale: true,
        colorbar: { title: { text: "Time (s)", font: { size: 12, color: colour("soft") } }, thickness: 12, outlinewidth: 0, tickfont: { size: 11, color: colour("soft") } } },
      hovertemplate: `%{customdata:.6~g} s<extra></extra>` },
    { type: "scatter", mode: "markers", name: "now", x: [now[0]], y: [now[1]],
      marker: { size: 13, color: "rgba(0,0,0,0)", line: { width: 2.5, color: lineColour(1) } }, hoverinfo: "skip" },
  ];
  return { traces, layout };
}
