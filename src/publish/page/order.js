// Splats that hide each other are drawn from the farthest to the nearest along the view. That order
// is the same from wherever one looks in a direction.
class Order {
  // Columns become rows, which stay whole when they are put in order.
  constructor(columns, {count, lower, upper}) {
    const wide = columns.length / count;
    this.words = Math.ceil(wide / 2);
    const rows = new Uint16Array(2 * this.words * count);
    for (let i = 0; i < count; ++i)
      for (let column = 0; column < wide; ++column)
        rows[2 * this.words * i + column] = columns[column * count + i];
    Object.assign(this, {count, columns, rows: new Uint32Array(rows.buffer), forward: null});
    this.sides = upper.map((end, axis) => end - lower[axis]);
    this.sorted = new Uint32Array(this.rows.length);
    this.keys = new Uint16Array(count);
  }

  // Nothing where the order is still the same.
  rows_along(forward) {
    if (this.forward && this.forward.every((x, axis) => x === forward[axis])) return null;
    this.forward = [...forward];
    const {count, columns, words, rows, sorted, keys} = this;
    // From 0 for the farthest to 65535.
    const along = forward.map((x, axis) => x * this.sides[axis]);
    const whole = along.reduce((all, x) => all + Math.abs(x), 0) || 1;
    const [x, y, z] = along.map((part) => -part / whole);
    const nearest = 65535 * along.reduce((all, part) => all + Math.max(part, 0), 0) / whole;
    const starts = new Uint32Array(65537);
    for (let i = 0; i < count; ++i) {
      const key = nearest + x * columns[i] + y * columns[count + i] + z * columns[2 * count + i];
      keys[i] = Math.max(0, Math.min(65535, key));
      ++starts[keys[i] + 1];
    }
    for (let key = 0; key < 65535; ++key) starts[key + 1] += starts[key];
    for (let i = 0; i < count; ++i) {
      const to = words * starts[keys[i]]++, from = words * i;
      for (let word = 0; word < words; ++word) sorted[to + word] = rows[from + word];
    }
    return sorted;
  }
}
