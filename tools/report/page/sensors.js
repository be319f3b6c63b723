// What tools in the string recorded.

function addSensors() {
  const shown = metadata.sensors.map((sensor, k) => ({ ...sensor, k })).filter(({ k }) => array(`sensors/${k}/time`).length > 0);
  if (!shown.length) return;
  const section = addSection("sensors", "Sensors",
    "What tools in the string feel, in axes that turn with them: d3 along the string toward the bit, d1 and d2 across. Accelerations are " +
    "those of accelerometers, less gravity's: at rest, one that points down shows -9.81 m/s². A torque is positive where what is above " +
    "drives what is below in positive rotation.");
  let chosen = shown[0].k;
  const name = ({ name: text, depth }) => `${text}, ${withUnit(depth, "length")} from the head`;
  const choice = element("select", { id: "sensor", onchange: () => {
    chosen = Number(choice.value);
    redrawPlot();
  } });
  section.append(element("div", { class: "bar" }, element("label", {}, "Sensor", choice)));
  addWords(choice, () => choice.replaceChildren(...shown.map((sensor) => {
    const option = element("option", { value: sensor.k }, name(sensor));
    option.selected = sensor.k === chosen;
    return option;
  })));
  const redrawPlot = addPlot(section, "sensors", () => {
    const line = (channel, text = "", colour = 0) =>
      ({ name: text, values: array(`sensors/${chosen}/${channel}`), time: array(`sensors/${chosen}/time`), colour });
    return stripPlot([
      { title: "Acceleration along d3", quantity: "acceleration", lines: [line("axial")] },
      { title: "Acceleration across", quantity: "acceleration",
        lines: [line("along_d1", "along d1"), line("along_d2", "along d2", 1)] },
      { title: "Rotation", quantity: "rotation", lines: [line("rotation", "", 1)] },
      { title: "Bending moment", quantity: "moment",
        lines: [line("bending_1", "about d1"), line("bending_2", "about d2", 1)] },
      { title: "Torque", quantity: "moment", lines: [line("torque", "", 2)] },
      { title: "Axial force", quantity: "force", lines: [line("tension")] },
    ]);
  });
}
