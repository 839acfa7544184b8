// Arrays of numbers in the data block: base64 of little-endian values.

function decodeBytes(text) {
  const binary = atob(text || "");
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

// Typed array of `Type` (Float32Array, Uint16Array, ...). All platforms with WebGL are
// little-endian.
function decodeArray(Type, text) {
  return new Type(decodeBytes(text).buffer);
}

// `array` with its values from index `from` on replaced by `more`.
function spliceArray(array, from, more) {
  const joined = new array.constructor(from + more.length);
  joined.set(array.subarray(0, from));
  joined.set(more, from);
  return joined;
}

function clamp(value, low, high) {
  return Math.min(high, Math.max(low, value));
}

// `value` with `decimals`, or a dash if it is not a number.
function formatNumber(value, decimals) {
  return Number.isFinite(value) ? value.toFixed(decimals) : "–";
}

// Index of the last element of the ascending `array` that is at most `value`, at least 0.
function lastNotAbove(array, value) {
  let low = 0, high = array.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (array[middle] <= value) low = middle;
    else high = middle;
  }
  return low;
}
