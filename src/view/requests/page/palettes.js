// Pictures of palettes. Their colors come as linear light: red, green, blue, red, ...
const displayed = (light, gamma) => Math.round(255 * light ** (1 / gamma));

// `share` from 0, the first color, to 1, the last.
export function colorAt({colors, gamma}, share) {
  const last = colors.length / 3 - 1;
  const place = Math.min(1, Math.max(0, share)) * last;
  const knot = Math.min(last - 1, Math.floor(place));
  const channel = (c) => {
    const a = colors[3 * knot + c], b = colors[3 * knot + 3 + c];
    return displayed(a + (b - a) * (place - knot), gamma);
  };
  return `rgb(${channel(0)} ${channel(1)} ${channel(2)})`;
}

export function drawStrip(canvas, palette) {
  const context = canvas.getContext('2d');
  for (let x = 0; x < canvas.width; ++x) {
    context.fillStyle = colorAt(palette, x / (canvas.width - 1));
    context.fillRect(x, 0, 1, canvas.height);
  }
}
