// Torque over time and frequency, and how much the bit sticks and slips.

/** In-place radix-2 transform of a signal of 2^n samples: Cooley and Tukey, 1965. */
function fourier(real, imaginary) {
  const count = real.length;
  for (let i = 1, j = 0; i < count; ++i) {
    let bit = count >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) {
      [real[i], real[j]] = [real[j], real[i]];
      [imaginary[i], imaginary[j]] = [imaginary[j], imaginary[i]];
    }
  }
  for (let size = 2; size <= count; size *= 2) {
    const step = (-2 * Math.PI) / size;
    for (let start = 0; start < count; start += size)
      for (let k = 0; k < size / 2; ++k) {
        const [c, s] = [Math.cos(step * k), Math.sin(step * k)];
        const [a, b] = [start + k, start + k + size / 2];
        const x = real[b] * c - imaginary[b] * s;
        const y = real[b] * s + imaginary[b] * c;
        real[b] = real[a] - x;
        imaginary[b] = imaginary[a] - y;
        real[a] += x;
        imaginary[a] += y;
      }
  }
}

/** Amplitudes over windows of `size` samples (Hann, mean and slope removed), half overlapping. */
function spectrogram(values, interval, size) {
  const hop = Math.max(1, Math.floor(Math.max(size / 8, (values.length - size) / 400)));
  const window = Float64Array.from({ length: size }, (_, k) => 0.5 - 0.5 * Math.cos((2 * Math.PI * k) / size));
  const result = { time: [], frequency: [], amplitude: [] };
  for (let k = 1; k < size / 2; ++k) result.frequency.push(k / (size * interval));
  for (let start = 0; start + size <= values.length; start += hop) {
    const part = values.subarray(start, start + size);
    const line = straightLine(part);
    const real = Float64Array.from(part, (value, k) => window[k] * (value - line.start - line.slope * k));
    const imaginary = new Float64Array(size);
    fourier(real, imaginary);
    result.time.push(metadata.dense_start + (start + size / 2) * interval);
    // A Hann window halves the amplitude of a sine; half of it is at the negative frequency.
    result.amplitude.push(result.frequency.map((_, k) => (4 / size) * Math.hypot(real[k + 1], imaginary[k + 1])));
  }
  return result;
}

/** Least squares line through samples 0, 1, 2, ... */
function straightLine(values) {
  const count = values.length;
  const middle = (count - 1) / 2;
  let [sum, moment] = [0, 0];
  values.forEach((value, k) => {
    sum += value;
    moment += value * (k - middle);
  });
  const slope = (12 * moment) / (count * (count * count - 1));
  return { start: sum / count - slope * middle, slope };
}

/** Largest power of two up to a sixth of the record, 32 to 1024 samples. */
const windowSize = (count) => Math.max(32, Math.min(1024, 2 ** Math.floor(Math.log2(Math.max(1, count / 6)))));

function addSpectrum() {
  if (!has("dense/head_torque")) return;
  const count = array("dense/head_torque").length;
  const interval = metadata.dense_interval;
  const size = windowSize(count);
  if (count < 2 * size) return;
  const section = addSection("spectrum", "Torque over frequency",
    `Amplitude of the torque in windows of ${digits(size * interval, 3)} s (Hann). The line is the rate of rotation of the top.`, "Spectrum");
  const choose = element("select", { id: "spectrum-channel", onchange: () => update() },
    element("option", { value: "head_torque" }, "Torque at the surface"),
    element("option", { value: "bit_torque" }, "Torque at the bit"));
  section.append(element("div", { class: "bar" }, element("label", {}, "Channel", choose)));
  const update = addPlot(section, "spectrum", () => spectrumPlot(choose.value, interval, size));
}

const spectra = new Map();

function spectrumPlot(channel, interval, size) {
  if (!spectra.has(channel)) spectra.set(channel, spectrogram(array(`dense/${channel}`), interval, size));
  const { time, frequency, amplitude } = spectra.get(channel);
  const factor = factorOf("moment");
  const all = amplitude.flat();
  const most = Math.log10(Math.max(1e-12, quantile(all, 0.9995) * factor));
  const layout = layoutStyle(isNarrow() ? 320 : 380);
  layout.showlegend = false;
  layout.hovermode = "closest";
  layout.margin.t = 12;
  layout.xaxis = { ...axisStyle("Time (s)"), showgrid: false };
  layout.yaxis = { ...axisStyle("Frequency (Hz)"), showgrid: false, range: [0, frequency[frequency.length - 1]] };
  const amplitudes = frequency.map((_, k) => amplitude.map((values) => values[k] * factor));
  const z = amplitudes.map((values) => values.map((value) => Math.log10(Math.max(value, 1e-12))));
  const powers = [0, -1, -2, -3].map((k) => Math.floor(most) + k);
  const heat = {
    type: "heatmap", x: time, y: frequency, z, customdata: amplitudes, colorscale: sequential, zmin: most - 3.5, zmax: most,
    colorbar: { title: { text: titled("Amplitude", "moment"), side: isNarrow() ? "top" : "right", font: { size: 12, color: colour("soft") } },
      tickvals: powers, ticktext: powers.map((k) => digits(10 ** k, 3)), tickfont: { size: 11, color: colour("soft") }, thickness: 12, outlinewidth: 0,
      ...(isNarrow() ? { orientation: "h", y: 1.02, yanchor: "bottom", len: 1 } : {}) },
    hovertemplate: `%{x:.5~g} s, %{y:.3~g} Hz: %{customdata:.3~g} ${unitOf("moment")}<extra></extra>`,
  };
  const rate = array("dense/head_rate");
  const turns = time.map((value) => Math.abs(rate[Math.min(rate.length - 1, Math.round((value - metadata.dense_start) / interval))]) / (2 * Math.PI));
  const line = { type: "scatter", mode: "lines", x: time, y: turns, line: { color: "#ffffff", width: 1.2, dash: "dot" },
    hovertemplate: "top turns at %{y:.3~g} Hz<extra></extra>" };
  return { traces: [heat, line], layout };
}

const leastRotation = 0.1;  // rad/s: what is slower does not rotate

/**
 * (greatest - least rate of the bit) / (2 mean rate of the bit), positive with the top, in a window around
 * each time: as the findings have it. None where the bit hardly turns.
 */
function stickSlipIndex(time, bit, head, window) {
  const mean = (rates, from, to) => rates.subarray(from, to).reduce((sum, rate) => sum + rate, 0) / (to - from);
  const result = { time: [], index: [] };
  const count = Math.min(600, time.length);
  for (let k = 0; k < count; ++k) {
    const middle = time[0] + ((time[time.length - 1] - time[0]) * (k + 0.5)) / count;
    const [from, half, to] = [-0.5, 0, 0.5].map((part) => lowerBound(time, middle + part * window));
    if (time[to - 1] - time[from] < 0.8 * window) continue;
    // Where the top hardly turns, or goes over to another rate, the ratio says nothing.
    const top = mean(head, from, to);
    const change = Math.abs(mean(head, half, to) - mean(head, from, half));
    if (Math.abs(top) < leastRotation || change > 0.2 * Math.abs(top)) continue;
    const [least, most] = extremes(bit.subarray(from, to));
    const forward = Math.sign(top) * mean(bit, from, to);
    result.time.push(middle);
    result.index.push(forward < leastRotation ? NaN : (most - least) / (2 * forward));
  }
  return result;
}

function lowerBound(values, limit) {
  let [low, high] = [0, values.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (values[middle] < limit) low = middle + 1;
    else high = middle;
  }
  return low;
}

function addStickSlip() {
  if (!has("dense/bit_rate")) return;
  const time = Float64Array.from(array("dense/bit_rate"), (_, k) => metadata.dense_start + k * metadata.dense_interval);
  const length = time[time.length - 1] - time[0];
  const window = Math.min(10, length / 5);
  const { time: middle, index } = stickSlipIndex(time, array("dense/bit_rate"), array("dense/head_rate"), window);
  if (index.length < 2) return;
  const section = addSection("stickslip", "Stick-slip",
    `Stick-slip index: half the range of the bit's rate of rotation over its mean, as in the findings, in a sliding window of ${digits(window, 3)} s ` +
    "in which the top keeps its rate. From 1 on (the dotted line) the bit stands still for moments.");
  addPlot(section, "stickslip", () => {
    const plot = stripPlot([
      { title: "Stick-slip index", quantity: "count", lines: [{ name: "", values: Float64Array.from(index), time: middle, colour: 1 }] },
      { title: "Rotation of the bit", quantity: "rotation", lines: [{ name: "", values: array("dense/bit_rate"), time: time }] }], 170);
    plot.layout.yaxis.rangemode = "tozero";
    plot.layout.shapes = [{ type: "line", xref: "paper", x0: 0, x1: 1, yref: "y", y0: 1, y1: 1, line: { color: colour("soft"), width: 1, dash: "dot" } }];
    return plot;
  });
}
