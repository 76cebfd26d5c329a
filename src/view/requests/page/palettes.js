import {element} from './elements.js';

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

// All palettes with their pictures, to choose from. Made when it is opened for the first time.
export class PaletteList {
  // `palettes`: colors by name. `current` returns the name of the one that is shown, `gamma` that of
  // the picture.
  constructor(name, palettes, {current, gamma, choose}) {
    this.name = name;
    this.palettes = palettes;
    this.current = current;
    this.gamma = gamma;
    this.choose = choose;
    this.choices = new Map();
    this.group = element('div', {className: 'palettes'});
    this.element = element('details', {className: 'wide'}, element('summary', {}, 'All palettes'), this.group);
    this.element.addEventListener('toggle', () => this.show());
  }

  make() {
    this.group.setAttribute('role', 'radiogroup');
    this.group.setAttribute('aria-label', `Palettes of ${this.name}`);
    for (const palette of this.palettes.keys()) {
      const radio = element('input', {type: 'radio', name: `palettes of ${this.name}`,
                                      'aria-label': `${palette} for ${this.name}`});
      radio.onchange = () => this.choose(palette);
      const strip = element('canvas', {className: 'strip', width: 96, height: 14, 'aria-hidden': true});
      this.choices.set(palette, {radio, strip});
      this.group.append(element('label', {}, radio, strip, element('span', {}, palette)));
    }
  }

  show() {
    if (!this.element.open) return;
    if (this.choices.size === 0) this.make();
    this.choices.get(this.current()).radio.checked = true;
    if (this.drawnGamma === this.gamma()) return;
    this.drawnGamma = this.gamma();
    for (const [palette, {strip}] of this.choices) {
      drawStrip(strip, {colors: this.palettes.get(palette), gamma: this.drawnGamma});
    }
  }
}
