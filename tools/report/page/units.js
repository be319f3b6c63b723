// Quantities in SI and in the field's units; all data are in SI.

const quantities = {
  time: { si: ["s", 1], field: ["s", 1] },
  force: { si: ["kN", 1e-3], field: ["klbf", 1 / 4448.2216152605] },
  moment: { si: ["kN m", 1e-3], field: ["kft lbf", 1 / 1355.8179483314] },
  length: { si: ["m", 1], field: ["ft", 1 / 0.3048] },
  small: { si: ["mm", 1e3], field: ["in", 1 / 0.0254] },
  rotation: { si: ["rpm", 30 / Math.PI], field: ["rpm", 30 / Math.PI] },
  sideForce: { si: ["kN/m", 1e-3], field: ["lbf/ft", 1 / 14.593902937206] },
  stress: { si: ["MPa", 1e-6], field: ["ksi", 1 / 6894757.2931684] },
  share: { si: ["%", 100], field: ["%", 100] },
  energy: { si: ["kJ", 1e-3], field: ["kft lbf", 1 / 1355.8179483314] },
  frequency: { si: ["Hz", 1], field: ["Hz", 1] },
  step: { si: ["ms", 1e3], field: ["ms", 1e3] },
  count: { si: ["", 1], field: ["", 1] },
};

const unitOf = (quantity) => quantities[quantity][state.units][0];
const factorOf = (quantity) => quantities[quantity][state.units][1];

/** "Hook load (kN)" */
const titled = (text, quantity) => (unitOf(quantity) ? `${text} (${unitOf(quantity)})` : text);

function converted(values, quantity) {
  const factor = factorOf(quantity);
  return Float64Array.from(values, (value) => value * factor);
}

/** A number to `digits` significant digits, without an exponent where it is of everyday size. */
function digits(value, count = 4) {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-4) return value.toExponential(count - 1);
  return Number(value.toPrecision(count)).toString();
}

const withUnit = (value, quantity, count = 4) =>
  `${digits(value * factorOf(quantity), count)} ${unitOf(quantity)}`.trim();
