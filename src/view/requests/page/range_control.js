// The range of a component's color field: two handles on its histogram, and their numbers.
import {button, element, row, wide} from './elements.js';
import {numberInput} from './number_input.js';
import {colorAt} from './palettes.js';
import {readable, rounded, scaled, unscaled} from './scaling.js';

// Bars of the histogram of a range control, in the colors that their values have in the picture.
function drawHistogram(canvas, range) {
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

const steps = 1000;

export class RangeControl {
  // `colors` returns the colors of the palette that is shown.
  constructor(component, name, store, link, colors) {
    this.component = component;
    this.store = store;
    this.link = link;
    this.colors = colors;
    this.histogram = null;
    this.asked = '';  // for which field and scaling
    this.canvas = element('canvas', {className: 'histogram', width: 296, height: 64, 'aria-hidden': true});
    this.ends = ['min', 'max'].map((end) => this.makeEnd(end, name));
    this.unit = element('span', {className: 'soft unit'});
    const handles = element('div', {className: 'range'}, this.canvas, ...this.ends.map(({slider}) => slider));
    const [from, to] = this.ends.map(({number}) => number);
    this.elements = [
      row('Range', wide(handles)),
      row('', wide(element('div', {className: 'ends'}, from, this.unit, to))),
      row('', wide(button('Adapt range', `Adapt range of ${name} to the data`, () => this.adapt()))),
    ];
  }

  makeEnd(end, name) {
    const word = end === 'min' ? 'minimum' : 'maximum';
    const slider = element('input', {type: 'range', className: 'handle', min: 0, max: steps, step: 1,
                                     'aria-label': `Range ${word} slider of ${name}`});
    slider.oninput = () => this.set(end, rounded(this.valueAt(slider.value / steps)), true);
    slider.onchange = () => this.store.rest();
    const number = numberInput(`Range ${word} of ${name}`, (value, isMoving) => this.set(end, value, isMoving),
                               this.scaling === 'log' ? {min: 0} : {});
    number.dataset.key = this.key(end);
    return {end, slider, number};
  }

  key(end) { return `component.${this.component}.color.${end}`; }
  value(end) { return this.store.settings[this.key(end)]; }
  get scaling() { return this.value('scaling') ?? 'linear'; }

  set(end, value, isMoving) {
    this.store.change({[this.key(end)]: value}, {gesture: this.key(end), isMoving});
  }

  adapt() { this.store.change({[this.key('min')]: null, [this.key('max')]: null}); }
  focus() { this.ends[0].slider.focus(); }

  // What the sliders span, scaled: all data, and the range where that is wider.
  get span() {
    const values = [this.value('min') ?? null, this.value('max') ?? null];
    if (this.histogram) values.push(this.histogram.minimum, this.histogram.maximum);
    const places = values.filter((v) => v !== null).map((v) => scaled(v, this.scaling))
        .filter(Number.isFinite);
    const low = Math.min(...places), high = Math.max(...places);
    return low < high ? {low, high} : {low: low - 1, high: low + 1};
  }

  valueAt(share) {
    const {low, high} = this.span;
    return unscaled(low + share * (high - low), this.scaling);
  }

  placeOf(value) {
    const {low, high} = this.span;
    return (scaled(value, this.scaling) - low) / (high - low);
  }

  show(unit = this.unit.textContent) {
    this.unit.textContent = unit;
    this.askForHistogram();
    for (const {end, slider, number} of this.ends) {
      const value = this.value(end);
      if (document.activeElement !== number) number.value = readable(value ?? null);
      slider.disabled = value == null;
      if (value == null) continue;
      slider.value = Math.round(steps * this.placeOf(value));
      slider.setAttribute('aria-valuetext', readable(value));
    }
    drawHistogram(this.canvas, this);
  }

  askForHistogram() {
    const field = this.value('field');
    const wanted = `${field} ${this.scaling}`;
    if (field == null || wanted === this.asked || !this.link.isOpen) return;
    this.asked = wanted;
    this.link.ask({type: 'histogram', component: this.component}).then((histogram) => {
      this.histogram = histogram.counts.length > 0 ? histogram : null;
      this.show();
    }, () => { this.asked = ''; });
  }
}
