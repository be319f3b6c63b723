// Along the string at the chosen time, within the least and greatest values of the run.

/** Least and greatest value of a field at each place over all frames. */
function bandOf(field) {
  if (!field.band) {
    const least = Float32Array.from(field.values(0));
    const most = Float32Array.from(least);
    for (let frame = 1; frame < frameCount(); ++frame) {
      const values = field.values(frame);
      for (let k = 0; k < values.length; ++k) {
        if (values[k] < least[k]) least[k] = values[k];
        if (values[k] > most[k]) most[k] = values[k];
      }
    }
    field.band = { least, most };
  }
  return field.band;
}

function addProfiles() {
  if (!hasProfiles()) return;
  const section = addSection("profiles", "Profiles",
    "Along the string at the chosen time. The shaded band spans what each place went through over all profiles; single impacts leave the " +
    "frame of the side force.");
  const fields = Object.entries(availableFields());
  section.append(timeBar());
  const plotId = "profiles";
  addPlot(section, plotId, () => profilePlot(fields));
  const plot = document.getElementById(`plot-${plotId}`);
  onFrame(() => {
    if (!pictures.get(plot).inSight || !plot.data) return renew(pictures.get(plot));
    const x = fields.map(([, field]) => converted(field.values(state.frame), field.quantity));
    Plotly.restyle(plot, { x }, fields.map((_, k) => 2 * k + 1));
  });
}

function profilePlot(fields) {
  const columns = isNarrow() ? 2 : fields.length;
  const rows = Math.ceil(fields.length / columns);
  const layout = layoutStyle(rows * (isNarrow() ? 300 : 460) + 40);
  layout.showlegend = false;
  layout.hovermode = "closest";
  layout.margin = { l: 60, r: 12, t: 16, b: 60 };
  const gap = isNarrow() ? 0.12 : 0.025;
  const width = (1 - gap * (columns - 1)) / columns;
  const traces = [];
  fields.forEach(([name, field], k) => {
    const [line, column] = [Math.floor(k / columns), k % columns];
    const suffix = k === 0 ? "" : `${k + 1}`;
    const y = converted(depths(field), "length");
    const { least, most } = bandOf(field);
    const band = [...converted(least, field.quantity), ...converted(most, field.quantity).reverse()];
    const top = 1 - line / rows;
    layout[`xaxis${suffix}`] = {
      ...axisStyle(titled(field.title, field.quantity)),
      domain: [column * (width + gap), column * (width + gap) + width],
      anchor: `y${suffix}`, nticks: 5,
      ...(name === "side" ? { range: [0, 1.5 * fieldRange(field)[1] * factorOf(field.quantity)] } : {}),
    };
    layout[`yaxis${suffix}`] = {
      ...axisStyle(column === 0 ? titled("Depth along the string", "length") : ""),
      domain: [top - 1 / rows + (line < rows - 1 ? 0.07 : 0), top],
      anchor: `x${suffix}`, autorange: "reversed", showticklabels: column === 0,
      ...(k > 0 ? { matches: "y" } : {}),
    };
    traces.push(
      { type: "scatter", mode: "lines", x: band, y: [...y, ...Array.from(y).reverse()], fill: "toself", line: { width: 0 },
        fillcolor: colour("grid"), hoverinfo: "skip", xaxis: `x${suffix}`, yaxis: `y${suffix}` },
      { type: "scatter", mode: "lines", name: field.title, x: converted(field.values(state.frame), field.quantity), y,
        line: { width: 1.6, color: lineColour(k) }, xaxis: `x${suffix}`, yaxis: `y${suffix}`,
        hovertemplate: `%{y:.5~g} ${unitOf("length")}: %{x:.4~g} ${unitOf(field.quantity)}<extra></extra>` });
  });
  return { traces, layout };
}
