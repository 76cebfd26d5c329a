// The controls of one component.
import {checkbox, element, group, numberInput, row, select, wide} from './elements.js';
import {PaletteList} from './palette_list.js';
import {drawStrip} from './palettes.js';
import {RangeControl} from './range_control.js';
import {readable} from './scaling.js';

const brightnessStops = 8;

export class ComponentControls {
  constructor(number, opened, store, link) {
    this.number = number;
    this.store = store;
    this.palettes = new Map(opened.palettes.map(({name, colors}) => [name, colors]));
    const {name, fields, has_own_colors: hasOwnColors} = opened.components[number];
    this.name = name;
    this.shown = checkbox(`Show ${name}`, `Show ${name}`,
                          (isShown) => store.setHidden(number, !isShown));
    this.element = group(name, this.shown.label);
    this.makeField(fields, link);
    if (!hasOwnColors) this.makePalette();
    this.makeBrightness();
    this.makeAbsorption();
    this.makeSize();
  }

  key(key) { return `component.${this.number}.${key}`; }
  value(key) { return this.store.settings[this.key(key)]; }
  set(key, value, options) { this.store.change({[this.key(key)]: value}, options); }

  get colors() {
    return {colors: this.palettes.get(this.value('palette')), gamma: this.store.settings['image.gamma']};
  }

  makePalette() {
    this.palette = select(`Palette of ${this.name}`, [...this.palettes.keys()],
                          (name) => this.set('palette', name));
    this.strip = element('canvas', {className: 'strip', width: 308, height: 14, 'aria-hidden': true});
    this.list = new PaletteList(this.name, this.palettes, {
      current: () => this.value('palette'),
      gamma: () => this.store.settings['image.gamma'],
      choose: (name) => this.set('palette', name, {gesture: this.key('palette')}),
    });
    this.element.append(row('Palette', wide(this.palette)), row('', wide(this.strip)),
                        row('', this.list.element));
  }

  makeField(fields, link) {
    if (this.value('color.field') === undefined) return;
    const open = {[this.key('color.min')]: null, [this.key('color.max')]: null};
    this.field = select(`Color field of ${this.name}`, fields,
                        (field) => this.store.change({[this.key('color.field')]: field, ...open}));
    this.scaling = select(`Scaling of ${this.name}`, ['linear', 'log', 'asinh'],
                          (scaling) => this.setScaling(scaling));
    this.range = new RangeControl(this.number, this.name, this.store, link, () => this.colors);
    this.element.append(row('Color', wide(this.field)), row('Scaling', wide(this.scaling)),
                        ...this.range.elements);
  }

  // A range that the new scaling cannot have is found anew.
  setScaling(scaling) {
    const change = {[this.key('color.scaling')]: scaling};
    if (scaling === 'log' && !(this.value('color.min') > 0)) change[this.key('color.min')] = null;
    if (scaling === 'log' && !(this.value('color.max') > 0)) change[this.key('color.max')] = null;
    this.store.change(change);
  }

  makeBrightness() {
    this.stops = element('input', {type: 'range', min: -brightnessStops, max: brightnessStops, step: 0.05,
                                   'aria-label': `Brightness slider of ${this.name}`});
    this.stops.oninput = () =>
      this.setBrightness(Number((2 ** Number(this.stops.value)).toPrecision(4)), true);
    this.stops.onchange = () => this.store.rest();
    this.brightness = numberInput(`Brightness of ${this.name}`, (v) => this.setBrightness(v, false),
                                  {min: 0});
    this.element.append(row('Brightness', this.stops, this.brightness));
  }

  setBrightness(value, isMoving) {
    this.set('brightness', value, {gesture: this.key('brightness'), isMoving});
  }

  makeAbsorption() {
    if (this.value('absorption') === undefined) return;
    this.absorption = select(`Absorption of ${this.name}`, ['none', 'emission', 'number'],
                             (word) => this.set('absorption', word === 'number' ? 1 : word));
    this.absorbed = numberInput(`Absorption number of ${this.name}`,
                                (value) => this.set('absorption', value), {min: 0});
    this.element.append(row('Absorption', this.absorption, this.absorbed));
  }

  makeSize() {
    this.size = numberInput(`Size factor of ${this.name}`, (value) => this.set('size.factor', value),
                            {min: 0});
    this.element.append(row('Size factor', this.size));
  }

  show() {
    this.shown.box.checked = !this.store.state.hidden.includes(this.number);
    if (this.palette) {
      this.palette.value = this.value('palette');
      drawStrip(this.strip, this.colors);
      this.list.show();
    }
    if (this.field) {
      this.field.value = this.value('color.field');
      this.scaling.value = this.value('color.scaling');
      this.range.show();
    }
    const brightness = this.value('brightness');
    this.stops.value = brightness > 0 ? Math.log2(brightness) : -brightnessStops;
    this.stops.setAttribute('aria-valuetext', readable(brightness));
    this.brightness.value = readable(brightness);
    this.size.value = readable(this.value('size.factor'));
    if (this.absorption) this.showAbsorption();
  }

  showAbsorption() {
    const value = this.value('absorption');
    const isNumber = typeof value === 'number';
    this.absorption.value = isNumber ? 'number' : value;
    this.absorbed.disabled = !isNumber;
    this.absorbed.value = isNumber ? readable(value) : '';
  }

  // What the letters of the keyboard do.
  nextPalette(step) {
    if (!this.palette) return;
    const names = [...this.palettes.keys()];
    const next = names.indexOf(this.value('palette')) + step;
    this.set('palette', names[(next + names.length) % names.length], {gesture: 'next palette'});
  }

  toggleLog() {
    if (this.field) this.setScaling(this.value('color.scaling') === 'log' ? 'linear' : 'log');
  }
}
