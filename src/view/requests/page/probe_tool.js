// Tells what lies under the pointer: where it is, how far, and for each component the column along
// the line of sight and the mean of its field.
import {element} from './elements.js';
import {readable} from './scaling.js';

const restMilliseconds = 120;

const short = (value) => readable(Number(value.toPrecision(4)));

export class ProbeTool {
  // `ask` resolves to what the program says of a place of the picture.
  constructor(button, box, view, picture, store, ask) {
    this.button = button;
    this.box = box;
    this.picture = picture;
    this.store = store;
    this.ask = ask;
    this.isOn = false;
    button.onclick = () => this.toggle();
    view.addEventListener('pointermove', (event) => this.move(event));
    view.addEventListener('pointerleave', () => this.wait(null));
  }

  // From the keyboard the middle is probed.
  toggle() {
    this.isOn = !this.isOn;
    this.button.setAttribute('aria-pressed', String(this.isOn));
    this.box.hidden = true;
    if (this.isOn) this.wait({clientX: innerWidth / 2, clientY: innerHeight / 2});
  }

  move(event) {
    if (this.isOn) this.wait(event.buttons === 0 ? event : null);
  }

  wait(event) {
    clearTimeout(this.timer);
    if (event === null) this.box.hidden = true;
    else this.timer = setTimeout(() => this.tell(event), restMilliseconds);
  }

  async tell(event) {
    const place = this.picture.placeOf(event);
    if (!place || !this.isOn) return;
    try {
      this.show(event, await this.ask(place));
    } catch (error) {
      this.box.textContent = error.message;
    }
  }

  show({clientX, clientY}, {position, distance, components}) {
    const unit = this.store.opened.length_unit;
    const lines = position
      ? [`${position.map(short).join(', ')} ${unit}`, `${short(distance)} ${unit} away`]
      : ['Nothing is here'];
    for (const {name, mean, column} of components) {
      const index = this.store.components.findIndex((component) => component.name === name);
      const field = this.store.settings[`component.${index}.color.field`];
      const fieldUnit = this.store.components[index]?.units?.[field] ?? '';
      if (mean !== undefined) lines.push(`${name}: mean ${field} ${short(mean)} ${fieldUnit}`);
      if (column > 0) lines.push(`${name}: column ${short(column)}`);
    }
    this.box.replaceChildren(...lines.map((line) => element('span', {}, line)));
    this.box.hidden = !this.isOn;
    const {width, height} = this.box.getBoundingClientRect();
    this.box.style.left = `${Math.min(clientX + 16, innerWidth - width - 8)}px`;
    this.box.style.top = `${Math.min(clientY + 16, innerHeight - height - 8)}px`;
  }
}
