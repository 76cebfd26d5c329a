// Natural cubic splines through points in time, as films go through keyframes (docs/movies.md).

// Second derivatives at the knots, which are 0 at both ends.
function bends(times, values) {
  const n = times.length;
  const bend = new Array(n).fill(0), factor = new Array(n).fill(0);
  for (let i = 1; i < n - 1; ++i) {
    const before = times[i] - times[i - 1], after = times[i + 1] - times[i];
    const share = before / (before + after);
    const pivot = share * factor[i - 1] + 2;
    const kink = (values[i + 1] - values[i]) / after - (values[i] - values[i - 1]) / before;
    factor[i] = (share - 1) / pivot;
    bend[i] = (6 * kink / (before + after) - share * bend[i - 1]) / pivot;
  }
  for (let i = n - 2; i > 0; --i) bend[i] += factor[i] * bend[i + 1];
  return bend;
}

// The curve as a function of time, which stays before its first knot and behind its last.
export function curveThrough(times, points) {
  const parts = points[0].map((_, axis) => {
    const values = points.map((point) => point[axis]);
    return {values, bend: bends(times, values)};
  });
  return (time) => {
    const last = times.length - 1;
    if (last === 0 || time <= times[0]) return [...points[0]];
    if (time >= times[last]) return [...points[last]];
    let i = 0;
    while (times[i + 1] < time) ++i;
    const width = times[i + 1] - times[i];
    const b = (time - times[i]) / width, a = 1 - b;
    return parts.map(({values, bend}) => a * values[i] + b * values[i + 1] +
        ((a ** 3 - a) * bend[i] + (b ** 3 - b) * bend[i + 1]) * width ** 2 / 6);
  };
}

// Which of many samples are enough for the curve through them to pass the others within a tolerance
// of `distance(a, b)`. The first and the last are among them.
export function fewKnots(times, points, distance, tolerance, most) {
  const chosen = [0, times.length - 1];
  while (chosen.length < Math.min(most, times.length)) {
    const curve = curveThrough(chosen.map((i) => times[i]), chosen.map((i) => points[i]));
    let worst = 0, at = -1;
    times.forEach((time, i) => {
      const away = distance(points[i], curve(time));
      if (away > worst && !chosen.includes(i)) [worst, at] = [away, i];
    });
    if (at < 0 || worst <= tolerance) break;
    chosen.push(at);
    chosen.sort((a, b) => a - b);
  }
  return chosen;
}
