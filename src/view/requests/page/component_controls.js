// The controls of one component.
import {ClipControls} from './clip_controls.js';
import {button, checkbox, element, group, more, row, select, textInput, wide} from './elements.js';
import {numberInput} from './number_input.js';
import {PaletteList, drawStrip} from './palettes.js';
import {RangeControl} from './range_control.js';
import {readable} from './scaling.js';

const brightnessStops = 8;
const formula = 'a formula';
const none = 'none';

export class ComponentControls {
  // `described`: its name and fields. `palettes`: colors by name.
  constructor(number, described, palettes, store, link) {
    this.number = number;
    this.store = store;
    this.palettes = palettes;
    const {name, fields, units, has_own_colors: hasOwnColors} = described;
    this.name = name;
    this.fields = fields;
    this.units = units;
    this.shown = checkbox(`Show ${name}`, `Show ${name}`, (isShown) => store.setHidden(number, !isShown));
    this.element = group(name, element('div', {className: 'buttons'}, this.shown.label));
    if (described.isAdded) this.makeRemove();
    if (!hasOwnColors) this.makeField(link);
    if (!hasOwnColors) this.makePalette();
    this.makeBrightness();
    this.more = more(`More of ${name}`);
    this.element.append(this.more);
    this.makeIntensity();
    this.makeAbsorption();
    this.makeSize();
    this.makeSelection();
  }

  makeRemove() {
    this.element.querySelector('.buttons').append(
      button('Remove', `Remove the component ${this.name}`, () => this.store.removeComponent(this.number)));
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

  makeField(link) {
    this.field = select(`Color field of ${this.name}`, [...this.fields, formula], (field) => this.chooseField(field));
    this.formula = textInput(`Formula for the color of ${this.name}`, (text) => text && this.setField(text));
    this.formula.dataset.key = this.key('color.field');
    this.formulaRow = row('Formula', wide(this.formula));
    this.scaling = select(`Scaling of ${this.name}`, ['linear', 'log', 'asinh'],
                          (scaling) => this.setScaling(scaling));
    this.range = new RangeControl(this.number, this.name, this.store, link, () => this.colors);
    this.element.append(row('Color', wide(this.field)), this.formulaRow, row('Scaling', wide(this.scaling)),
                        ...this.range.elements);
  }

  // What formulas are written in is known first: the field that is shown.
  chooseField(field) {
    if (field !== formula) return this.setField(field);
    this.formulaRow.hidden = false;
    this.formula.value = this.value('color.field') ?? '';
    this.formula.focus();
  }

  setField(field) {
    const open = {[this.key('color.min')]: null, [this.key('color.max')]: null};
    const scaling = this.value('color.scaling') ?? 'linear';
    this.store.change({[this.key('color.field')]: field, [this.key('color.scaling')]: scaling, ...open});
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
    this.brightness = numberInput(`Brightness of ${this.name}`, (v, isMoving) => this.setBrightness(v, isMoving),
                                  {min: 0});
    this.brightness.dataset.key = this.key('brightness');
    this.element.append(row('Brightness', this.stops, this.brightness));
  }

  setBrightness(value, isMoving) {
    this.set('brightness', value, {gesture: this.key('brightness'), isMoving});
  }

  makeIntensity() {
    this.intensity = select(`Intensity field of ${this.name}`, [none, ...this.fields], (field) => {
      const isNone = field === none;
      this.store.change({[this.key('intensity.field')]: isNone ? null : field,
                         [this.key('intensity.scaling')]: isNone ? null : 'log',
                         [this.key('intensity.min')]: null, [this.key('intensity.max')]: null});
    });
    this.more.append(row('Intensity', wide(this.intensity)));
  }

  makeAbsorption() {
    if (this.value('absorption') == null) return;
    this.absorption = select(`Absorption of ${this.name}`, ['none', 'emission', 'number'],
                             (word) => this.set('absorption', word === 'number' ? 1 : word));
    this.absorbed = numberInput(`Absorption number of ${this.name}`, (value, isMoving) =>
      this.set('absorption', value, {gesture: this.key('absorption'), isMoving}), {min: 0});
    this.absorbed.dataset.key = this.key('absorption');
    this.more.append(row('Absorption', this.absorption, this.absorbed));
  }

  makeSize() {
    this.size = numberInput(`Size factor of ${this.name}`, (value, isMoving) =>
      this.set('size.factor', value, {gesture: this.key('size.factor'), isMoving}), {min: 1e-6});
    this.size.dataset.key = this.key('size.factor');
    this.more.append(row('Size factor', wide(this.size)));
  }

  makeSelection() {
    this.where = textInput(`Only ${this.name} where`, (text) => this.set('select.where', text === '' ? null : text));
    this.where.placeholder = 'such as temperature > 1e5';
    this.where.dataset.key = this.key('select.where');
    this.clips = new ClipControls(this.number, this.name, this.store);
    this.more.append(row('Only where', wide(this.where)), ...this.clips.elements);
  }

  show() {
    this.shown.box.checked = !this.store.state.hidden.includes(this.number);
    if (this.palette) {
      this.palette.value = this.value('palette');
      drawStrip(this.strip, this.colors);
      this.list.show();
    }
    if (this.field) this.showField();
    const brightness = this.value('brightness');
    this.stops.value = brightness > 0 ? Math.log2(brightness) : -brightnessStops;
    this.stops.setAttribute('aria-valuetext', readable(brightness));
    this.showNumber(this.brightness, brightness);
    this.showNumber(this.size, this.value('size.factor'));
    if (this.absorption) this.showAbsorption();
    this.intensity.value = this.value('intensity.field') ?? none;
    this.showSelection();
  }

  showNumber(field, value) {
    if (document.activeElement !== field) field.value = readable(value ?? null);
  }

  showField() {
    const field = this.value('color.field');
    const isFormula = field !== null && !this.fields.includes(field);
    this.field.value = isFormula ? formula : field;
    this.formulaRow.hidden = !isFormula;
    if (document.activeElement !== this.formula) this.formula.value = isFormula ? field : '';
    this.scaling.value = this.value('color.scaling') ?? 'linear';
    this.range.show(this.units?.[field] ?? '');
  }

  showSelection() {
    const where = this.value('select.where');
    if (document.activeElement !== this.where) this.where.value = Array.isArray(where) ? where.join(' and ') : where ?? '';
    this.clips.show();
  }

  showAbsorption() {
    const value = this.value('absorption');
    const isNumber = typeof value === 'number';
    this.absorption.value = isNumber ? 'number' : value;
    this.absorbed.disabled = !isNumber;
    this.showNumber(this.absorbed, isNumber ? value : null);
  }

  // What the letters of the keyboard do.
  nextPalette(step) {
    if (!this.palette) return;
    const names = [...this.palettes.keys()];
    const next = names.indexOf(this.value('palette')) + step;
    this.set('palette', names[(next + names.length) % names.length], {gesture: 'next palette'});
  }

  toggleLog() {
    if (this.field && this.value('color.field') !== null) this.setScaling(this.value('color.scaling') === 'log' ? 'linear' : 'log');
  }
}
