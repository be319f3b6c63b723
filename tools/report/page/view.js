// The well and the string in three dimensions, on a plain canvas: no need of WebGL.

const viridis = ["#440154", "#482878", "#3e4989", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6ece58", "#b5de2b", "#fde725"];

const rgb = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));

/** 64 colours between the stops. */
function ramp(stops) {
  return Array.from({ length: 64 }, (_, k) => {
    const at = (k / 63) * (stops.length - 1);
    const i = Math.min(stops.length - 2, Math.floor(at));
    const [from, to] = [rgb(stops[i]), rgb(stops[i + 1])];
    return `rgb(${from.map((value, c) => Math.round(value + (at - i) * (to[c] - value))).join(",")})`;
  });
}

const fieldRamp = (field) =>
  ramp(isDiverging(field) ? ["low", "middle", "high"].map(colour) : viridis);

/** 1, 2 or 5 times a power of ten, near `value`. */
function roundNumber(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return [1, 2, 5, 10].map((k) => k * power).reduce((best, next) =>
    Math.abs(Math.log(next / value)) < Math.abs(Math.log(best / value)) ? next : best);
}

/** Positions of the nodes at a frame, motion across the well magnified (m: north, east, down). */
function magnified(frame, factor) {
  const base = array("view/base");
  const axes = array("view/axes");
  const offset = row(array("profiles/offset"), frame);
  const count = base.shape[0];
  const components = axes.shape[1];
  const points = new Float64Array(3 * count);
  for (let k = 0; k < count; ++k)
    for (let c = 0; c < 3; ++c) {
      let value = base[3 * k + c];
      for (let i = 0; i < components; ++i)
        value += factor * offset[components * k + i] * axes[3 * (components * k + i) + c];
      points[3 * k + c] = value;
    }
  return points;
}

/** The box around the well's axis, with room for what is magnified by the standard factor. */
function boundingBox(standardFactor) {
  const least = [Infinity, Infinity, Infinity];
  const most = [-Infinity, -Infinity, -Infinity];
  const include = (points) => {
    for (let k = 0; k < points.length; ++k) {
      least[k % 3] = Math.min(least[k % 3], points[k]);
      most[k % 3] = Math.max(most[k % 3], points[k]);
    }
  };
  include(array("view/base"));
  for (const share of [0, 0.25, 0.5, 0.75, 1])
    include(magnified(Math.round(share * (frameCount() - 1)), standardFactor));
  const size = Math.max(...most.map((value, c) => value - least[c]), 1e-6);
  for (let c = 0; c < 3; ++c) {
    const missing = 0.12 * size - (most[c] - least[c]);
    if (missing > 0) {
      least[c] -= missing / 2;
      most[c] += missing / 2;
    }
  }
  return { least, most, size };
}

class View {
  constructor(canvas, field) {
    this.canvas = canvas;
    this.field = field;
    this.clearance = has("view/clearance") ? array("view/clearance") : null;
    const typical = this.clearance ? quantile(this.clearance, 0.5) : 0;
    const [least, most] = [0, 1, 2].map((c) => {
      const values = array("view/base").filter((_, k) => k % 3 === c);
      return extremes(values);
    }).reduce(([a, b], [low, high]) => [Math.min(a, 0), Math.max(b, high - low)], [0, 0]);
    this.standardFactor = typical > 0 ? roundNumber((0.035 * (most - least)) / typical) : 1;
    this.factor = this.standardFactor;
    this.box = boundingBox(this.standardFactor);
    this.reset();
    this.listen();
  }

  reset() {
    this.yaw = this.broadside();
    this.pitch = 0.32;
    this.zoom = 1;
    this.shift = [0, 0];
  }

  /** The turn that shows the well from its side, a little from above its way. */
  broadside() {
    const base = array("view/base");
    const [north, east] = [0, 1].map((c) => base[base.length - 3 + c] - base[c]);
    return Math.hypot(north, east) > 0.1 * this.box.size ? Math.atan2(-north, east) + 0.35 : -0.6;
  }

  listen() {
    const { canvas } = this;
    const held = new Map();
    canvas.addEventListener("pointerdown", (event) => {
      held.set(event.pointerId, event);
      canvas.setPointerCapture(event.pointerId);
    });
    for (const name of ["pointerup", "pointercancel"])
      canvas.addEventListener(name, (event) => held.delete(event.pointerId));
    canvas.addEventListener("pointermove", (event) => {
      const last = held.get(event.pointerId);
      if (!last) return;
      const [dx, dy] = [event.clientX - last.clientX, event.clientY - last.clientY];
      if (event.shiftKey || held.size > 1) {
        this.shift = [this.shift[0] + dx, this.shift[1] + dy];
      } else {
        this.yaw += dx * 0.008;
        if (event.pointerType === "mouse") this.pitch = Math.max(-1.5, Math.min(1.5, this.pitch + dy * 0.008));
      }
      held.set(event.pointerId, event);
      this.draw();
    });
    canvas.addEventListener("wheel", (event) => {
      if (!event.ctrlKey) return;
      event.preventDefault();
      this.zoomBy(Math.exp(-event.deltaY * 0.002));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const turn = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
      if (!turn) return;
      event.preventDefault();
      this.yaw += turn[0];
      this.pitch = Math.max(-1.5, Math.min(1.5, this.pitch + turn[1]));
      this.draw();
    });
  }

  zoomBy(ratio) {
    const next = Math.max(0.5, Math.min(200, this.zoom * ratio));
    this.shift = this.shift.map((value) => (value * next) / this.zoom);
    this.zoom = next;
    this.draw();
  }

  /** Sets canvas size and the map from (north, east, down) to the screen. */
  prepare() {
    const ratio = window.devicePixelRatio || 1;
    const { canvas } = this;
    this.width = canvas.clientWidth;
    this.height = canvas.clientHeight;
    canvas.width = Math.round(this.width * ratio);
    canvas.height = Math.round(this.height * ratio);
    this.context = canvas.getContext("2d");
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const [cy, sy, cp, sp] = [Math.cos(this.yaw), Math.sin(this.yaw), Math.cos(this.pitch), Math.sin(this.pitch)];
    const middle = this.box.least.map((value, c) => (value + this.box.most[c]) / 2);
    const turned = (x, y, z) => {
      const [north, east, up] = [x - middle[0], y - middle[1], middle[2] - z];
      return [cy * east - sy * north, -cp * up + sp * (sy * east + cy * north)];
    };
    let [w, h] = [0, 0];
    for (const corner of this.corners()) {
      const [x, y] = turned(...corner);
      w = Math.max(w, Math.abs(x));
      h = Math.max(h, Math.abs(y));
    }
    const room = 64;
    const scale = this.zoom * Math.min((this.width / 2 - room) / w, (this.height / 2 - 40) / h);
    this.project = (x, y, z) => {
      const [right, downward] = turned(x, y, z);
      return [this.width / 2 + this.shift[0] + scale * right, this.height / 2 + this.shift[1] + scale * downward];
    };
    this.scale = scale;
  }

  corners() {
    const { least, most } = this.box;
    return [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [k & 1, k & 2, k & 4].map((bit, c) => (bit ? most[c] : least[c])));
  }

  draw() {
    this.prepare();
    this.drawBox();
    if (this.clearance) this.drawWell();
    this.drawString();
  }

  path(points) {
    const { context } = this;
    context.beginPath();
    points.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
    context.stroke();
  }

  drawBox() {
    const { context } = this;
    const corners = this.corners();
    const screen = corners.map((corner) => this.project(...corner));
    context.lineWidth = 1;
    context.strokeStyle = colour("grid");
    for (let k = 0; k < 8; ++k)
      for (const bit of [1, 2, 4]) if (!(k & bit)) this.path([screen[k], screen[k | bit]]);
    context.font = `11px ${getComputedStyle(document.body).fontFamily}`;
    context.fillStyle = colour("soft");
    this.drawAxis(0, "North", corners, screen);
    this.drawAxis(1, "East", corners, screen);
    this.drawAxis(2, "Depth", corners, screen);
  }

  /** Ticks along the box's edge in direction `c`: the left one for depth, the lower front ones else. */
  drawAxis(c, name, corners, screen) {
    const bit = 1 << c;
    const edges = [0, 1, 2, 3, 4, 5, 6, 7].filter((k) => !(k & bit));
    const key = (k) => (c === 2 ? screen[k][0] : -(screen[k][1] + screen[k | bit][1]));
    const from = edges.reduce((best, k) => (key(k) < key(best) ? k : best));
    const [start, end] = [screen[from], screen[from | bit]];
    const length = Math.hypot(end[0] - start[0], end[1] - start[1]);
    const { context } = this;
    const factor = factorOf("length");
    const [low, high] = [this.box.least[c] * factor, this.box.most[c] * factor];
    const centre = [(start[0] + end[0]) / 2, (start[1] + end[1]) / 2];
    const title = titled(name, "length");
    if (c === 2) {
      context.save();
      context.translate(start[0] - 46, centre[1]);
      context.rotate(-Math.PI / 2);
      context.textAlign = "center";
      context.fillText(title, 0, 0);
      context.restore();
    } else if (length > 20) {
      context.textAlign = centre[0] < this.width / 2 ? "right" : "left";
      context.fillText(title, centre[0] + (centre[0] < this.width / 2 ? -14 : 14), centre[1] + 24);
    }
    if (length < 60) return;
    const every = roundNumber(((high - low) * (c === 2 ? 48 : 70)) / length);
    context.textAlign = c === 2 ? "right" : centre[0] < this.width / 2 ? "right" : "left";
    for (let value = Math.ceil(low / every) * every; value <= high; value += every) {
      const share = (value - low) / (high - low);
      const [x, y] = [start[0] + share * (end[0] - start[0]), start[1] + share * (end[1] - start[1])];
      const [dx, dy] = c === 2 ? [-6, 4] : [context.textAlign === "right" ? -4 : 4, 13];
      context.fillText(digits(Math.abs(value) < every / 1e6 ? 0 : value, 6), x + dx, y + dy);
    }
  }

  /** Circles in which the pipe's axis has room, magnified as the motion is, and lines along them. */
  drawWell() {
    const base = array("view/base");
    const axes = array("view/axes");
    const count = base.shape[0];
    const sides = 24;
    const ring = (k) => Array.from({ length: sides + 1 }, (_, i) => {
      const angle = (2 * Math.PI * i) / sides;
      const radius = this.factor * this.clearance[k];
      const [a, b] = [radius * Math.cos(angle), radius * Math.sin(angle)];
      return this.project(...[0, 1, 2].map((c) => base[3 * k + c] + a * axes[6 * k + c] + b * axes[6 * k + 3 + c]));
    });
    const rings = Array.from({ length: count }, (_, k) => ring(k));
    const { context } = this;
    context.strokeStyle = colour("wall");
    context.globalAlpha = 0.45;
    context.lineWidth = 0.8;
    for (let i = 0; i < sides; i += 6) this.path(rings.map((points) => points[i]));
    const every = Math.max(1, Math.round(count / (60 * Math.sqrt(this.zoom))));
    for (let k = 0; k < count; k += every) this.path(rings[k]);
    context.globalAlpha = 1;
  }

  drawString() {
    const points = magnified(state.frame, this.factor);
    const screen = Array.from({ length: points.length / 3 }, (_, k) => this.project(...points.subarray(3 * k, 3 * k + 3)));
    const values = this.field.values(state.frame);
    const [least, most] = fieldRange(this.field);
    const colours = fieldRamp(this.field);
    const { context } = this;
    context.lineCap = "round";
    context.lineJoin = "round";
    context.strokeStyle = colour("ink");
    context.lineWidth = 4;
    this.path(screen);
    context.lineWidth = 2.6;
    const last = screen.length - 1;
    for (let k = 0; k < last; ++k) {
      const value = this.field.on === "nodes" ? (values[k] + values[k + 1]) / 2 : values[Math.min(k, values.length - 1)];
      const share = Math.max(0, Math.min(1, (value - least) / (most - least)));
      context.strokeStyle = colours[Math.round(share * 63)];
      this.path([screen[k], screen[k + 1]]);
    }
    context.fillStyle = colour("ink");
    context.beginPath();
    context.arc(...screen[last], 4, 0, 2 * Math.PI);
    context.fill();
    this.canvas.dataset.points = screen.length;
    this.canvas.dataset.frame = state.frame;
  }
}

function addView() {
  if (!hasProfiles()) return;
  const section = addSection("view", "Well and string",
    (metadata.well
      ? "The well to scale, the position of the pipe across it magnified. The tube is the room that the pipe's axis has between the walls. "
      : "Motion since the first profile, magnified. ") +
    "Drag to turn, shift and drag to move, control and wheel to zoom.", "3-D");
  const fields = availableFields();
  const canvas = element("canvas", { id: "plot-view", tabindex: 0, role: "img", "aria-label": "Well and string in three dimensions" });
  const rampBar = element("div", { class: "ramp" });
  const [leastText, mostText, name] = [element("span"), element("span"), element("span")];
  const panel = element("div", { class: "panel" }, canvas,
    element("div", { class: "scale" }, name, leastText, rampBar, mostText));
  const view = new View(canvas, fields.axial);

  const refresh = () => {
    const [least, most] = fieldRange(view.field);
    name.textContent = titled(view.field.title, view.field.quantity);
    leastText.textContent = digits(least * factorOf(view.field.quantity), 3);
    mostText.textContent = digits(most * factorOf(view.field.quantity), 3);
    rampBar.style.background = `linear-gradient(to right, ${fieldRamp(view.field).join(",")})`;
    view.draw();
  };
  const choose = element("select", { id: "view-field", onchange: () => { view.field = fields[choose.value]; update(); } },
    ...Object.entries(fields).map(([key, field]) => element("option", { value: key }, field.title)));
  const decades = 2;
  const factorText = element("output", { id: "view-factor" });
  const slider = element("input", { type: "range", id: "view-magnify", min: -decades, max: decades, step: 0.05,
    oninput: () => { view.factor = view.standardFactor * 10 ** slider.valueAsNumber; showFactor(); update(); } });
  slider.value = 0;
  const showFactor = () => { factorText.textContent = `× ${digits(view.factor, 3)}`; };
  showFactor();
  const button = (text, label, onclick) => element("button", { type: "button", title: label, "aria-label": label, onclick }, text);
  section.append(
    timeBar(),
    element("div", { class: "bar" },
      element("label", {}, "Coloured by", choose),
      element("label", { class: "wide" }, "Magnified", slider, factorText),
      element("span", {}, button("+", "Nearer", () => view.zoomBy(1.5)), " ", button("−", "Farther", () => view.zoomBy(1 / 1.5)), " ",
        button("Reset", "First view", () => { view.reset(); update(); }))),
    panel);
  const update = addPicture(canvas, refresh);
  onFrame(update);
}
