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

export const readable = (value) => (value === null ? '' : String(Number(value.toPrecision(6))));
