// The controls of camera, light and picture.
import {button, checkbox, element, fillSelect, group, more, row, select, textInput, wide} from './elements.js';
import {numberInput} from './number_input.js';
import {readable} from './scaling.js';

const exposureStops = 12;

class Controls {
  constructor(name, store) {
    this.store = store;
    this.element = group(name);
    this.shows = [];
  }

  show() { for (const show of this.shows) show(this.store.settings); }

  // `place`: where they go, in place of the group.
  addNumber(word, key, limits, place = this.element) {
    if (this.store.settings[key] === undefined) return;
    const input = numberInput(word, (value, isMoving) => this.store.change({[key]: value}, {gesture: key, isMoving}), limits);
    input.dataset.key = key;
    place.append(row(word, wide(input)));
    this.shows.push((settings) => {
      if (document.activeElement !== input) input.value = readable(settings[key] ?? null);
    });
  }

  // `without`: what stands for a key that is left out.
  addChoice(word, key, choices, {without = null, place = this.element} = {}) {
    const all = without === null ? choices : [without, ...choices];
    const input = select(word, all, (value) => this.store.change({[key]: value === without ? null : value}));
    place.append(row(word, wide(input)));
    this.shows.push((settings) => { input.value = settings[key] ?? without; });
  }

  addText(word, key) {
    const input = textInput(word, (value) => this.store.change({[key]: value === '' ? null : value}));
    input.dataset.key = key;
    this.element.append(row(word, wide(input)));
    this.shows.push((settings) => {
      if (document.activeElement !== input) input.value = settings[key] ?? '';
    });
  }

  // Linear light, shown as a display with the picture's gamma does.
  addColor(word, key) {
    const input = element('input', {type: 'color', 'aria-label': word});
    const gamma = () => this.store.settings['image.gamma'];
    input.oninput = () => {
      const channels = [1, 3, 5].map((i) => parseInt(input.value.slice(i, i + 2), 16) / 255);
      this.store.change({[key]: channels.map((c) => Number((c ** gamma()).toPrecision(4)))}, {gesture: key, isMoving: true});
    };
    input.onchange = () => this.store.rest();
    this.element.append(row(word, wide(input)));
    this.shows.push((settings) => {
      const hex = (c) => Math.round(255 * Math.min(1, c) ** (1 / gamma())).toString(16).padStart(2, '0');
      input.value = `#${settings[key].map(hex).join('')}`;
    });
  }

  addFlag(word, key) {
    const {box, label} = checkbox(word, word, (value) => this.store.change({[key]: value}));
    this.element.append(element('div', {}, label));
    this.shows.push((settings) => { box.checked = settings[key] === true; });
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
  controls.addNumber('Field of view', 'camera.field_of_view', {min: 0.001, max: 360, step: 1});
  controls.addChoice('Projection', 'camera.projection',
                     ['perspective', 'orthographic', 'fisheye', 'equirectangular', 'cube']);
  controls.addChoice('Stereo', 'stereo.layout',
                     [['anaglyph', 'red and cyan glasses'], ['anaglyph_half_color', 'the same, half color'],
                      ['side_by_side', 'side by side'], ['top_bottom', 'top and bottom']], {without: 'none'});
  return controls;
}

// Of a scene with several snapshots: which moment is shown.
export function timeControls(store, [first, last]) {
  const controls = new Controls('Time', store);
  const key = 'time.index';
  const slider = element('input', {type: 'range', min: first, max: last, step: 'any', 'aria-label': 'Time slider'});
  slider.oninput = () => store.change({[key]: Number(Number(slider.value).toFixed(3))}, {gesture: key, isMoving: true});
  slider.onchange = () => store.rest();
  const number = numberInput('Time index', (value, isMoving) => store.change({[key]: value}, {gesture: key, isMoving}),
                             {min: first, max: last, step: 0.1});
  number.dataset.key = key;
  controls.element.append(row('Snapshot', slider, number));
  controls.shows.push((settings) => {
    slider.value = settings[key];
    slider.setAttribute('aria-valuetext', readable(settings[key]));
    if (document.activeElement !== number) number.value = readable(settings[key]);
  });
  return controls;
}

// `takeLook` has the program suggest what a look sets.
export function lightControls(store, takeLook) {
  const controls = new Controls('Light', store);
  const look = select('Look', [['', 'choose a look'], 'press', 'classic', 'paper'], (name) => name && takeLook(name));
  controls.element.append(row('Look', wide(look)));
  controls.shows.push(() => { look.value = ''; });
  const key = 'finish.exposure';
  const slider = element('input', {type: 'range', min: -exposureStops, max: exposureStops, step: 0.05,
                                   'aria-label': 'Exposure slider'});
  slider.oninput = () => store.change({[key]: Number(slider.value)}, {gesture: key, isMoving: true});
  slider.onchange = () => store.rest();
  const number = numberInput('Exposure', (value, isMoving) => store.change({[key]: value}, {gesture: key, isMoving}),
                             {min: -100, max: 100, step: 0.1});
  number.dataset.key = key;
  controls.element.append(row('Exposure', slider, number));
  controls.shows.push((settings) => {
    slider.value = settings[key] ?? 0;
    slider.setAttribute('aria-valuetext', `${readable(settings[key] ?? 0)} stops`);
    if (document.activeElement !== number) number.value = readable(settings[key]);
  });
  controls.element.append(row('', wide(button('Find exposure and white', 'Find exposure and white',
      () => store.change({'finish.exposure': null, 'finish.white': null})))));
  controls.addNumber('White', 'finish.white', {min: 1e-30, max: 1e30});
  controls.addChoice('Tone', 'finish.tone', ['linear', 'asinh', 'filmic']);
  controls.addNumber('Bloom', 'finish.bloom', {min: 0, max: 1, step: 0.02});
  const rest = more('More of light');
  controls.element.append(rest);
  controls.addNumber('Saturation', 'finish.saturation', {min: 0, max: 100}, rest);
  controls.addNumber('Contrast', 'finish.contrast', {min: 0, max: 100}, rest);
  controls.addNumber('Gamma', 'image.gamma', {min: 0.01, max: 100}, rest);
  controls.addNumber('White balance', 'finish.white_balance', {min: 1667, max: 25000, step: 100}, rest);
  controls.addNumber('Highlights', 'finish.highlights', {min: 0, max: 1, step: 0.02}, rest);
  return controls;
}

const sizes = [[1280, 720], [1920, 1080], [3840, 2160], [1080, 1080], [1080, 1920], [160, 120]];

export function pictureControls(store, fit) {
  const controls = new Controls('Picture to save', store);
  const {box, label} = checkbox('Fill the window', 'Fill the window', (value) => fit.set(value));
  controls.element.append(element('div', {}, label));
  controls.shows.push(() => { box.checked = fit.isOn; });
  const usual = element('select', {'aria-label': 'Usual sizes'});
  fillSelect(usual, ['other', ...sizes.map((size) => [size.join(), size.join(' × ')])]);
  usual.onchange = () => usual.value !== 'other' && fit.setSize(usual.value.split(',').map(Number));
  controls.element.append(row('Size', wide(usual)));
  controls.shows.push((settings) => {
    const size = settings['image.size'].join();
    usual.value = [...usual.options].some(({value}) => value === size) ? size : 'other';
  });
  const inputs = ['Width', 'Height'].map((word, i) => numberInput(`${word} in pixels`, (value, isMoving) => {
    if (isMoving) return;
    fit.setSize(store.settings['image.size'].map((side, k) => (k === i ? value : side)));
  }, {min: 1, max: 65536, step: 4, isWhole: true}));
  inputs.forEach((input, i) => {
    input.dataset.key = 'image.size';
    controls.shows.push((settings) => {
      if (document.activeElement !== input) input.value = settings['image.size'][i];
    });
  });
  controls.element.append(row('Pixels', wide(element('div', {className: 'ends'}, inputs[0], '×', inputs[1]))));
  controls.addColor('Background', 'image.background');
  controls.addText('Title', 'finish.title.text');
  controls.addText('Caption', 'finish.caption.text');
  controls.addFlag('Color bars', 'finish.color_bar.show');
  controls.addFlag('Scale bar', 'finish.scale_bar.show');
  const rest = more('More of the picture');
  controls.element.append(rest);
  controls.addNumber('Footprint', 'kernel.footprint', {min: 0, max: 1000, step: 0.1}, rest);
  controls.addNumber('Tolerance', 'tolerance', {min: 0, max: 1}, rest);
  return controls;
}

// Components for kinds of particles: those of the snapshot, as often as one likes.
export function componentAdder(store, add) {
  const {particles} = store.opened;
  const choice = element('select', {'aria-label': 'Add a component'});
  fillSelect(choice, [['', 'Add a component'], ...particles.map(({type, count}) =>
    [type, `${type === 'halo' ? 'dark matter (halo)' : type}: ${count} particles`])]);
  choice.onchange = () => {
    if (choice.value !== '') add(choice.value);
    choice.value = '';
  };
  return element('div', {className: 'adder'}, choice);
}
