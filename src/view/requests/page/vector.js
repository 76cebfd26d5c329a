// Vectors of three numbers.
export const add = (a, b) => a.map((x, i) => x + b[i]);
export const subtract = (a, b) => a.map((x, i) => x - b[i]);
export const scale = (a, factor) => a.map((x) => x * factor);
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const length = (a) => Math.hypot(...a);
export const normalize = (a) => scale(a, 1 / length(a));
export const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0],
];

// Right-handed about a unit vector, by radians (Rodrigues' formula).
export function rotate(a, axis, angle) {
  const cosine = Math.cos(angle), sine = Math.sin(angle);
  return add(add(scale(a, cosine), scale(cross(axis, a), sine)),
             scale(axis, dot(axis, a) * (1 - cosine)));
}
