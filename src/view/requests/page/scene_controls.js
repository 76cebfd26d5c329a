// The controls of camera, light and picture.
import {button, checkbox, element, group, numberInput, row, select, wide} from './elements.js';
import {readable} from './scaling.js';

const exposureStops = 12;

class Controls {
  constructor(name, store) {
    this.store = store;
    this.element = group(name);
    this.shows = [];
  }

  show() { for (const show of this.shows) show(this.store.settings); }

  addNumber(word, key, limits) {
    if (this.store.settings[key] === undefined) return;
    const input = numberInput(word, (value) => this.store.change({[key]: value}, {gesture: key}), limits);
    this.element.append(row(word, wide(input)));
    this.shows.push((settings) => {
      if (document.activeElement !== input) input.value = readable(settings[key]);
    });
  }

  addChoice(word, key, choices) {
    const input = select(word, choices, (value) => this.store.change({[key]: value}));
    this.element.append(row(word, wide(input)));
    this.shows.push((settings) => { input.value = settings[key]; });
  }

  addFlag(word, key) {
    const {box, label} = checkbox(word, word, (value) => this.store.change({[key]: value}));
    this.element.append(element('div', {}, label));
    this.shows.push((settings) => { box.checked = settings[key]; });
  }
}

// `move` carries out what a button of the camera says.
export function cameraControls(store, move) {
  const controls = new Controls('Camera', store);
  const pads = element('div', {className: 'pads'});
  for (const [kind, name] of [['orbit', 'Orbit'], ['pan', 'Pan']]) {
    for (const [arrow, way, x, y] of [['←', 'left', -1, 0], ['→', 'right', 1, 0],
                                      ['↑', 'up', 0, 1], ['↓', 'down', 0, -1]]) {
      pads.append(button(`${name} ${arrow}`, `${name} ${way}`, () => move(kind, x, y)));
    }
  }
  pads.append(button('Closer', 'Move closer', () => move('dolly', -1, 0)),
              button('Away', 'Move away', () => move('dolly', 1, 0)),
              button('Home', 'Camera home', () => move('home', 0, 0)),
              button('Fly', 'Fly through the data', () => move('fly', 0, 0)));
  controls.element.append(pads);
  controls.addNumber('Field of view', 'camera.field_of_view', {min: 0.001, max: 360});
  controls.addChoice('Projection', 'camera.projection',
                     ['perspective', 'orthographic', 'fisheye', 'equirectangular', 'cube']);
  return controls;
}

// Of a scene with several snapshots: which moment is shown.
export function timeControls(store, [first, last]) {
  const controls = new Controls('Time', store);
  const key = 'time.index';
  const slider = element('input', {type: 'range', min: first, max: last, step: 'any', 'aria-label': 'Time slider'});
  slider.oninput = () => store.change({[key]: Number(Number(slider.value).toFixed(3))}, {gesture: key, isMoving: true});
  slider.onchange = () => store.rest();
  const number = numberInput('Time index', (value) => store.change({[key]: value}, {gesture: key}),
                             {min: first, max: last});
  controls.element.append(row('Snapshot', slider, number));
  controls.shows.push((settings) => {
    slider.value = settings[key];
    slider.setAttribute('aria-valuetext', readable(settings[key]));
    if (document.activeElement !== number) number.value = readable(settings[key]);
  });
  return controls;
}

export function lightControls(store) {
  const controls = new Controls('Light', store);
  const key = 'finish.exposure';
  const slider = element('input', {type: 'range', min: -exposureStops, max: exposureStops, step: 0.05,
                                   'aria-label': 'Exposure slider'});
  slider.oninput = () => store.change({[key]: Number(slider.value)}, {gesture: key, isMoving: true});
  slider.onchange = () => store.rest();
  const number = numberInput('Exposure', (value) => store.change({[key]: value}, {gesture: key}));
  controls.element.append(row('Exposure', slider, number));
  controls.shows.push((settings) => {
    slider.value = settings[key] ?? 0;
    slider.setAttribute('aria-valuetext', `${readable(settings[key] ?? 0)} stops`);
    if (document.activeElement !== number) number.value = readable(settings[key]);
  });
  controls.element.append(row('', wide(button('Find exposure and white', 'Find exposure and white',
      () => store.change({'finish.exposure': null, 'finish.white': null})))));
  controls.addNumber('White', 'finish.white', {min: 0});
  controls.addChoice('Tone', 'finish.tone', ['linear', 'asinh', 'filmic']);
  controls.addNumber('Saturation', 'finish.saturation', {min: 0});
  controls.addNumber('Contrast', 'finish.contrast', {min: 0});
  controls.addNumber('Gamma', 'image.gamma', {min: 0.01, max: 100});
  return controls;
}

export function pictureControls(store, fit) {
  const controls = new Controls('Picture to save', store);
  const {box, label} = checkbox('Fill the window', 'Fill the window', (value) => fit.set(value));
  controls.element.append(element('div', {}, label));
  controls.shows.push(() => { box.checked = fit.isOn; });
  ['Width', 'Height'].forEach((word, i) => {
    const set = (value) => {
      const size = [...store.settings['image.size']];
      size[i] = Math.round(value);
      fit.set(false);
      store.change({'image.size': size}, {gesture: 'image.size'});
    };
    const input = numberInput(`${word} in pixels`, set, {min: 1, max: 65536, step: 1});
    controls.element.append(row(word, wide(input)));
    controls.shows.push((settings) => {
      if (document.activeElement !== input) input.value = settings['image.size'][i];
    });
  });
  controls.addFlag('Color bars', 'finish.color_bar.show');
  controls.addFlag('Scale bar', 'finish.scale_bar.show');
  return controls;
}
