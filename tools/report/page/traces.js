// Pictures over time.

const negative = (values) => values.map((value) => -value);

/** A channel of --compare: its own times, in the strip of what it measures. */
function measuredLines(channel) {
  return (metadata.measured ?? [])
    .filter((measured) => measured.channel === channel)
    .map((measured) => ({
      name: "measured", values: array(`measured/${channel}`), time: array("measured/time"), colour: 4, points: true,
    }));
}

/** The torque of the motor, where a drive stands between it and the string. */
const driveLines = () =>
  has("series/drive_torque") ? [{ name: "of the motor", values: series("drive_torque"), colour: 2 }] : [];

function addTraces() {
  if (!has("series/time")) return;
  const section = addSection("traces", "Traces",
    "What the driller sees at the top, and what goes on at the bit. The hook load is what holds the head; a torque is " +
    "positive where the drive turns the string, or the rock holds the bit, against positive rotation, clockwise seen from above." +
    (has("series/drive_torque") ? " The drive's motor turns the drive's own inertia, too." : ""));
  addPlot(section, "traces", () => {
    const plot = stripPlot([
      { title: "Hook load", quantity: "force",
        lines: [{ name: metadata.measured ? "simulated" : "", values: series("hook_load") }, ...measuredLines("hook_load")] },
      { title: "Weight on bit", quantity: "force", lines: [{ name: "", values: series("weight_on_bit"), colour: 1 }] },
      { title: "Torque", quantity: "moment",
        lines: [{ name: "at the surface", values: series("surface_torque") },
          { name: "at the bit", values: series("bit_torque"), colour: 1 }, ...driveLines(), ...measuredLines("torque")] },
      { title: "Rotation", quantity: "rotation",
        lines: [{ name: "of the bit", values: series("bit_rate"), colour: 1 },
          { name: "of the top", values: series("head_rate") }] },
      { title: "Travel of the bit", quantity: "small", lines: [{ name: "", values: series("bit_travel"), colour: 1 }] },
    ]);
    // A rig's record may be much longer than the run.
    if (metadata.measured) plot.layout.xaxis.range = extremes(array("series/time"));
    return plot;
  });
}

function addComparison() {
  const section = addSection("compare", "Measured",
    "Measured channels beside the simulated ones (drawn in the traces above), over the time that both have; the simulation is " +
    "interpolated at the measured times.");
  const table = element("div", { class: "compare" });
  section.append(table);
  addWords(table, () => {
    const head = ["", "mean", "least", "greatest", "difference of means", "correlation", "points"];
    const rows = metadata.measured.flatMap((channel) => {
      const text = (value) => withUnit(value, channel.quantity, 5);
      const cells = (source) => [text(source.mean), text(source.least), text(source.greatest)];
      return [
        [`${channel.title}, measured`, ...cells(channel.measured), text(channel.difference),
          channel.correlation === null ? "none" : channel.correlation.toFixed(4), `${channel.points}`],
        [`${channel.title}, simulated`, ...cells(channel.simulated), "", "", ""],
      ];
    });
    table.replaceChildren(element("table", {},
      element("thead", {}, element("tr", {}, ...head.map((text) => element("th", {}, text)))),
      element("tbody", {}, ...rows.map((cells) =>
        element("tr", {}, ...cells.map((text) => element("td", {}, text)))))));
  });
}

function addHeadStress() {
  if (!has("series/head_stress")) return;
  const section = addSection("head", "Head stress",
    "The six components of the stress in the first segment, in the frame of the pipe as the result file holds them: d3 along the string, " +
    "toward the bit; d1 and d2 turn with the pipe.");
  addPlot(section, "head", () => {
    const names = ["Twist moment", "Bending moment about d1", "Bending moment about d2",
      "Axial force", "Shear force along d1", "Shear force along d2"];
    return stripPlot(names.map((title, k) => ({
      title, quantity: k < 3 ? "moment" : "force",
      lines: [{ name: "", values: series("head_stress", k), colour: k % 3 }],
    })), 120);
  });
}

function addContact() {
  if (!metadata.well || !has("series/time")) return;
  const section = addSection("contact", "Contact",
    "How deep the pipe presses into the wall, and a helix of its compression would; how many nodes touch it, and what happened since the " +
    "start: nodes that came into contact (impacts), came into or left it (changes), and began to slide (slips). How much of the string " +
    "whirls with its rotation or against it, how fast it goes around the well (negative: against the rotation) beside the rate at which " +
    "it would roll without slip; and the friction of the wall along the well, positive down it.");
  addPlot(section, "contact", () => stripPlot([
    { title: "Largest penetration", quantity: "small", lines: [
      { name: "of the string", values: series("max_penetration") },
      { name: "of a helix", values: series("helix_penetration"), colour: 1 }] },
    { title: "Nodes in contact", quantity: "count", lines: [{ name: "", values: series("contact_nodes"), colour: 2 }] },
    { title: "Events", quantity: "count", lines: [
      { name: "impacts", values: series("impacts") },
      { name: "changes", values: series("contact_changes"), colour: 1 },
      { name: "slips", values: series("slips"), colour: 2 }] },
    { title: "In whirl", quantity: "share", lines: [
      { name: "backward", values: series("whirl_backward") },
      { name: "forward", values: series("whirl_forward"), colour: 1 }] },
    { title: "Rate around the well", quantity: "rotation", lines: [
      { name: "of what whirls", values: series("whirl_rate") },
      { name: "rolling", values: series("rolling_rate"), colour: 1 }] },
    { title: "Friction along the well", quantity: "force", lines: [{ name: "", values: series("wall_drag") }] },
  ]));
}

function addSteps() {
  if (!has("series/time")) return;
  const section = addSection("steps", "Time steps",
    "The step of the integrator at each record (the last step before a record may be cut short)" +
    (metadata.has_time_error ? ", and how much 16 steps differ from exact ones." : "."));
  addPlot(section, "steps", () => stripPlot([
    { title: "Step", quantity: "step", lines: [{ name: "", values: series("step_size") }] },
    ...(metadata.has_time_error ? [{ title: "Time error of 16 steps", quantity: "share",
      lines: [{ name: "", values: series("time_error"), colour: 1 }] }] : []),
  ]));
}

function addEnergy() {
  if (!has("series/time")) return;
  const section = addSection("energy", "Energy",
    "What is stored must change by the work done less what is dissipated. The residual is what appeared from nowhere, divided by the energy " +
    "that moved until then.");
  addPlot(section, "energy", () => {
    const part = (component, name, k) => ({ name, values: series("energy", component), colour: k });
    return stripPlot([
      { title: "Stored", quantity: "energy", lines: [part(0, "kinetic", 0), part(1, "elastic", 1), part(2, "potential", 2),
        part(5, "of spin", 3)] },
      { title: "Since the start", quantity: "energy", lines: [part(3, "work done", 3), part(4, "dissipated", 4)] },
      { title: "Residual", quantity: "share", lines: [{ name: "", values: series("energy_residual") }] },
    ]);
  });
}
