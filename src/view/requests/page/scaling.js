// The scalings of fields, as the program has them, and numbers as people read them.
export function scaled(value, scaling) {
  if (scaling === 'log') return Math.log10(value);
  return scaling === 'asinh' ? Math.asinh(value) : value;
}

export function unscaled(value, scaling) {
  if (scaling === 'log') return 10 ** value;
  return scaling === 'asinh' ? Math.sinh(value) : value;
}

// Four digits are enough for what a slider sets.
export const rounded = (value) => Number(value.toPrecision(4));

// Large and small numbers with their exponent: 1.25e7.
export function readable(value) {
  if (value === null) return '';
  const size = Math.abs(value);
  const isPlain = size === 0 || (size >= 1e-3 && size < 1e6);
  return isPlain ? String(Number(value.toPrecision(6))) : value.toExponential(4).replace(/\.?0*e\+?/, 'e');
}
