// The string against time: depth downward, time to the right.

function addMaps() {
  if (!hasProfiles() || frameCount() < 2) return;
  const section = addSection("maps", "Along the string, over time",
    "Depth is measured along the string from its head. In the map of spin, stick-slip shows as stripes: dark where the string stands. Whirl against the rotation is negative. Colours end where 99 % of the values lie.", "Maps");
  const fields = availableFields();
  for (const [name, title] of [["side", "Side force"], ["bending", fields.bending.title], ["spin", "Spin"],
    ["whirl", "Whirl rate"]]) {
    const field = fields[name];
    if (!field) continue;
    section.append(element("h3", {}, title));
    addPlot(section, `map-${name}`, () => mapOf(field, name));
  }
}

function mapOf(field, name) {
  const time = array("profiles/time");
  const [least, most] = fieldRange(field);
  const factor = factorOf(field.quantity);
  const layout = layoutStyle(isNarrow() ? 320 : 380);
  layout.hovermode = "closest";
  layout.margin.t = 12;
  layout.xaxis = { ...axisStyle("Time (s)"), showgrid: false };
  layout.yaxis = { ...axisStyle(titled("Depth along the string", "length")), autorange: "reversed", showgrid: false };
  const trace = {
    type: "heatmap",
    x: time,
    y: converted(depths(field), "length"),
    z: Array.from({ length: time.length }, (_, frame) => field.values(frame).map((value) => value * factor)),
    transpose: true,
    colorscale: isDiverging(field) ? diverging() : name === "bending" ? "Cividis" : sequential,
    zmin: least * factor,
    zmax: most * factor,
    colorbar: {
      title: { text: titled(field.title, field.quantity), side: isNarrow() ? "top" : "right", font: { size: 12, color: colour("soft") } },
      tickfont: { size: 11, color: colour("soft") },
      thickness: 12, outlinewidth: 0,
      ...(isNarrow() ? { orientation: "h", y: 1.02, yanchor: "bottom", len: 1 } : {}),
    },
    hovertemplate: `%{x:.6~g} s, %{y:.5~g} ${unitOf("length")}: %{z:.4~g} ${unitOf(field.quantity)}<extra></extra>`,
  };
  return { traces: [trace], layout };
}
