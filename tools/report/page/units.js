// Quantities in SI and in the field's units; all data are in SI. Names and factors come from the
// engine's table of units (report_units.hpp); here is what has no unit there.

const inBoth = (name, factor) => ({ si: [name, factor], field: [name, factor] });

const quantities = {
  ...metadata.units,
  share: inBoth("%", 0.01),
  frequency: inBoth("Hz", 1),
  count: inBoth("", 1),
  acceleration: { si: ["m/s²", 1], field: ["g", 9.80665] },
};

const unitOf = (quantity) => quantities[quantity][state.units][0];
/** What turns a number in SI into one of the unit. */
const factorOf = (quantity) => 1 / quantities[quantity][state.units][1];

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
