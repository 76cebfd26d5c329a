// What clips a component: a sphere and a box, about what the camera looks at when they are chosen.
import {button, checkbox, element, row, wide} from './elements.js';
import {numberInput} from './number_input.js';
import {readable} from './scaling.js';

const part = 5;  // of the distance to what is looked at
const axes = ['x', 'y', 'z'];
const rounded = (value) => Number(value.toPrecision(4));

export class ClipControls {
  constructor(number, name, store) {
    this.store = store;
    this.start = `component.${number}.select`;
    this.name = name;
    this.fields = [];
    this.makeSphere();
    this.makeBox();
  }

  key(end) { return `${this.start}.${end}`; }
  value(end) { return this.store.settings[this.key(end)] ?? null; }

  get target() { return this.store.settings['camera.look_at']; }

  get reach() {
    const here = this.store.settings['camera.position'];
    return rounded(Math.hypot(...here.map((x, i) => x - this.target[i])) / part);
  }

  makeSphere() {
    const center = this.key('sphere.center'), radius = this.key('sphere.radius');
    const {box, label} = checkbox('Clip to a sphere', `Clip ${this.name} to a sphere`, (isOn) => this.store.change(
      isOn ? {[center]: this.target, [radius]: this.reach} : {[center]: null, [radius]: null}));
    this.hasSphere = box;
    const input = numberInput(`Radius of the sphere of ${this.name}`, (value, isMoving) =>
      this.store.change({[radius]: value}, {gesture: radius, isMoving}), {min: 1e-30});
    this.addField(input, radius, () => this.value('sphere.radius'));
    this.radius = row('Radius', input, button('Center here', `Center the sphere of ${this.name} here`,
                                              () => this.store.change({[center]: this.target})));
    this.sphere = [label, this.radius];
  }

  makeBox() {
    const ends = ['box.min', 'box.max'].map((end) => this.key(end));
    const {box, label} = checkbox('Clip to a box', `Clip ${this.name} to a box`, (isOn) => {
      const faces = [-1, 1].map((way) => this.target.map((x) => (isOn ? rounded(x + way * this.reach) : null)));
      this.store.change(Object.fromEntries(ends.map((end, i) => [end, isOn ? faces[i] : null])));
    });
    this.hasBox = box;
    this.sides = axes.map((axis, i) => {
      const [from, to] = ends.map((end, k) => this.makeFace(end, axis, i, k));
      return row(axis, wide(element('div', {className: 'ends'}, from, 'to', to)));
    });
    this.box = [label, ...this.sides];
  }

  makeFace(key, axis, i, k) {
    const input = numberInput(`${k === 0 ? 'Lowest' : 'Highest'} ${axis} of the box of ${this.name}`, (value, isMoving) => {
      const corner = [...this.store.settings[key]];
      corner[i] = value;
      this.store.change({[key]: corner}, {gesture: `${key} ${axis}`, isMoving});
    }, {step: this.reach / 10});
    this.addField(input, key, () => (this.store.settings[key] ?? [null, null, null])[i]);
    return input;
  }

  addField(input, key, value) {
    input.dataset.key = key;
    this.fields.push(() => {
      if (document.activeElement !== input) input.value = readable(value());
    });
  }

  get elements() { return [...this.sphere, ...this.box]; }

  show() {
    this.hasSphere.checked = this.value('sphere.radius') !== null;
    this.radius.hidden = !this.hasSphere.checked;
    this.hasBox.checked = this.value('box.min') !== null;
    for (const side of this.sides) side.hidden = !this.hasBox.checked;
    for (const show of this.fields) show();
  }
}
