// Quantities along the string at the times of the profiles, and the time that is shown.

const hasProfiles = () => has("profiles/time") && array("profiles/time").length > 0;
const hasYield = () => has("string/yield_strength");
const hasSpin = () => has("profiles/spin");

/** Colours end where all but a hundredth of the values lie: single impacts would drown the rest. */
const rangeShare = 0.99;

/** Whether so much whirls that the colours of a map tell of it. */
function whirls() {
  const rates = array("profiles/whirl");
  return rates.reduce((count, rate) => count + (rate !== 0), 0) > 2 * (1 - rangeShare) * rates.length;
}

/** A stress in Pa from axial force, bending moment and torque, segment by segment. */
function stresses(frame, combine) {
  const [axial, bending, torque] = ["axial", "bending", "torque"].map((name) => row(array(`profiles/${name}`), frame));
  const [tension, moment, twist] = ["yield_tension", "yield_bending", "yield_torque"].map((name) => array(`string/${name}`));
  const strength = array("string/yield_strength");
  return Float32Array.from(axial, (_, k) =>
    strength[k] * combine(axial[k] / tension[k], bending[k] / moment[k], torque[k] / twist[k]));
}

/** What can be drawn along the string; `values(frame)` are in SI. */
function availableFields() {
  const stored = (name) => (frame) => row(array(`profiles/${name}`), frame);
  const fields = {
    axial: { title: "Axial force", quantity: "force", on: "segments", signed: true, values: stored("axial") },
    torque: { title: "Torque", quantity: "moment", on: "segments", signed: true, values: stored("torque") },
  };
  if (hasYield()) {
    fields.bending = { title: "Bending stress", quantity: "stress", on: "segments",
      values: (frame) => stresses(frame, (_, bending) => bending) };
    fields.mises = { title: "Von Mises stress", quantity: "stress", on: "segments",
      values: (frame) => stresses(frame, (axial, bending, torque) => Math.hypot(Math.abs(axial) + bending, torque)) };
  } else {
    fields.bending = { title: "Bending moment", quantity: "moment", on: "segments", values: stored("bending") };
  }
  if (metadata.well) {
    fields.side = { title: "Side force", quantity: "sideForce", on: "nodes", values: stored("side") };
    if (whirls())
      fields.whirl = { title: "Whirl rate", quantity: "rotation", on: "nodes", signed: true, values: stored("whirl") };
  }
  if (hasSpin())
    fields.spin = { title: "Spin", quantity: "rotation", on: "nodes", values: stored("spin") };
  return fields;
}

const depths = (field) => array(field.on === "nodes" ? "mesh/node_s" : "mesh/segment_s");
const frameCount = () => array("profiles/time").length;

const rangeOfField = new Map();

/** Least and greatest value of a field that has a colour of its own. */
function fieldRange(field) {
  if (!rangeOfField.has(field.title)) {
    const sample = [];
    const every = Math.max(1, Math.floor(frameCount() / 60));
    for (let frame = 0; frame < frameCount(); frame += every) sample.push(...field.values(frame));
    let [least, most] = [quantile(sample, 1 - rangeShare), quantile(sample, rangeShare)];
    if (!field.signed) least = Math.min(0, least);
    if (field.signed && least < 0 && most > 0) least = -(most = Math.max(-least, most));
    if (Math.abs(least) < 1e-3 * most) least = 0;
    if (least === most) most = least + (Math.abs(least) || 1) * 1e-3;
    rangeOfField.set(field.title, [least, most]);
  }
  return rangeOfField.get(field.title);
}

const isDiverging = (field) => {
  const [least, most] = fieldRange(field);
  return least === -most;
};

// The time shown is the same in all pictures.
const frameListeners = [];
const onFrame = (listener) => frameListeners.push(listener);

function setFrame(frame) {
  state.frame = Math.max(0, Math.min(frameCount() - 1, frame));
  for (const listener of frameListeners) listener();
}

const timeText = () => `${digits(array("profiles/time")[state.frame], 6)} s`;

/** A slider over the times of the profiles, with a button that plays them. */
function timeBar() {
  const slider = element("input", { type: "range", class: "time-slider", min: 0, max: frameCount() - 1, step: 1,
    "aria-label": "Time", oninput: () => setFrame(slider.valueAsNumber) });
  slider.value = state.frame;
  const output = element("output", { class: "time-text" }, timeText());
  const play = element("button", { type: "button", class: "play", onclick: togglePlay }, "Play");
  onFrame(() => {
    slider.value = state.frame;
    output.textContent = timeText();
    play.textContent = state.playing ? "Pause" : "Play";
  });
  return element("div", { class: "bar" }, play, element("label", { class: "wide" }, "Time", slider, output));
}

const framesPerSecond = 20;

function togglePlay() {
  state.playing = !state.playing;
  if (state.playing && state.frame === frameCount() - 1) state.frame = 0;
  setFrame(state.frame);
  let last = performance.now();
  const advance = (now) => {
    if (!state.playing) return;
    const frames = Math.floor(((now - last) / 1000) * framesPerSecond);
    if (frames > 0) {
      last = now;
      if (state.frame + frames >= frameCount() - 1) state.playing = false;
      setFrame(state.frame + frames);
    }
    requestAnimationFrame(advance);
  };
  requestAnimationFrame(advance);
}
