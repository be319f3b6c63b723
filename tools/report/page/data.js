// The data of the run: metadata as JSON, numbers as one block of little-endian arrays in base64.

const metadata = JSON.parse(document.getElementById("metadata").textContent);

function decodeBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let k = 0; k < bytes.length; ++k) bytes[k] = binary.charCodeAt(k);
  return bytes;
}

const block = decodeBase64(document.getElementById("data").textContent.trim()).buffer;

const has = (name) => name in metadata.arrays;

/** The array of that name, with its shape: a view, not a copy. */
function array(name) {
  const { type, shape, offset } = metadata.arrays[name];
  const length = shape.reduce((product, extent) => product * extent, 1);
  const values = new (type === "f64" ? Float64Array : Float32Array)(block, offset, length);
  values.shape = shape;
  return values;
}

/** Row `k` of an array of two or more dimensions. */
function row(values, k) {
  const length = values.length / values.shape[0];
  return values.subarray(k * length, (k + 1) * length);
}

/** The series of that name at the series times; `component` of those with several. */
const series = (name, component = 0) => {
  const values = array(`series/${name}`);
  return values.shape.length === 1 ? values : row(values, component);
};

function extremes(values) {
  let least = Infinity;
  let most = -Infinity;
  for (const value of values) {
    if (value < least) least = value;
    if (value > most) most = value;
  }
  return least <= most ? [least, most] : [0, 0];
}

/** The value below which that share of the values lies. */
function quantile(values, share) {
  const sorted = Float32Array.from(values).sort();
  return sorted.length ? sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))] : 0;
}
