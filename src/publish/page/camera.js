// A camera about the point that it looks at: axes and lengths as splotchcl has them, right, down and
// forward, relative to the point that the scene looks at.
const sum = (a, b, times) => a.map((x, i) => x + times * b[i]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const unit = (a) => a.map((x) => x / Math.hypot(...a));

function turned(v, axis, angle) {
  const c = Math.cos(angle), s = Math.sin(angle), along = dot(axis, v) * (1 - c);
  const cross = [axis[1] * v[2] - axis[2] * v[1], axis[2] * v[0] - axis[0] * v[2],
                 axis[0] * v[1] - axis[1] * v[0]];
  return v.map((x, i) => x * c + cross[i] * s + axis[i] * along);
}

class Camera {
  constructor(settings) {
    this.settings = settings;
    this.reset();
  }

  reset() {
    const {right, down, forward, distance} = this.settings;
    this.axes = {right, down, forward};
    this.distance = distance;
    this.point = [0, 0, 0];
  }

  // About the picture's upward and sideward axes.
  turn(about_down, about_right) {
    let {right, down, forward} = this.axes;
    const turn = (v) => turned(turned(v, down, about_down), right, about_right);
    forward = unit(turn(forward));
    right = turn(right);
    right = unit(sum(right, forward, -dot(right, forward)));
    down = unit(sum(sum(turn(down), forward, -dot(turn(down), forward)), right,
                    -dot(turn(down), right)));
    this.axes = {right, down, forward};
  }

  approach(times) { this.distance *= times; }

  // By pixels of the picture.
  move(x, y, focal) {
    const length = this.distance / focal;
    this.point = sum(sum(this.point, this.axes.right, -x * length), this.axes.down, -y * length);
  }

  position() { return sum(this.point, this.axes.forward, -this.distance); }

  // Pixels per tangent, so that the scene's picture fits into one of this size.
  focal(width, height) {
    const s = this.settings;
    return s.focal * Math.min(width / s.width, height / s.height);
  }
}
