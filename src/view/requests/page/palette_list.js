// All palettes with their pictures, to choose from. Made when it is opened for the first time.
import {element} from './elements.js';
import {drawStrip} from './palettes.js';

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
