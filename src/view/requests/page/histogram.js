// Bars of the histogram of a range control, in the colors that their values have in the picture.
import {scaled} from './scaling.js';
import {colorAt} from './palettes.js';

export function drawHistogram(canvas, range) {
  const context = canvas.getContext('2d');
  context.clearRect(0, 0, canvas.width, canvas.height);
  if (!range.histogram) return;
  const {minimum, maximum, counts} = range.histogram;
  // Few particles in a bin are seen beside many.
  const highest = Math.log1p(Math.max(...counts));
  const low = scaled(minimum, range.scaling), high = scaled(maximum, range.scaling);
  const {low: start, high: end} = range.span;
  const from = scaled(range.value('min') ?? minimum, range.scaling);
  const to = scaled(range.value('max') ?? maximum, range.scaling);
  const across = (place) => (place - start) / (end - start) * canvas.width;
  const binWidth = (high - low) / counts.length;
  counts.forEach((count, i) => {
    const place = low + i * binWidth;
    const height = highest > 0 ? Math.log1p(count) / highest * (canvas.height - 2) : 0;
    const share = (place + binWidth / 2 - from) / (to - from);
    context.fillStyle = share < 0 || share > 1 ? '#8888' : colorAt(range.colors(), share);
    context.fillRect(across(place), canvas.height - height,
                     Math.max(1, across(place + binWidth) - across(place) - 0.5), height);
  });
  context.fillStyle = getComputedStyle(canvas).color;
  for (const place of [from, to]) context.fillRect(across(place) - 0.5, 0, 1, canvas.height);
}
