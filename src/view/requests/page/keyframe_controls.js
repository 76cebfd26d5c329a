// Keyframes of the camera: added where one stands, played as splotchcl movie draws them, and saved
// with the scene as its [path].
import {button, element, group, numberInput, row, wide} from './elements.js';

const cameraKeys = ['camera.position', 'camera.look_at', 'camera.sky', 'camera.field_of_view'];
const framesBetween = 50;
const framesPerSecond = 25;

export class KeyframeControls {
  // `showFrame` has the film's frame of that number drawn; null: the page's own camera.
  constructor(store, showFrame) {
    this.store = store;
    this.showFrame = showFrame;
    this.frame = null;
    this.timer = null;
    this.list = element('ol', {className: 'keyframes', 'aria-label': 'Keyframes'});
    this.play = button('Play', 'Play the keyframes', () => this.togglePlay());
    this.slider = element('input', {type: 'range', min: 0, step: 1, value: 0, 'aria-label': 'Frame of the film'});
    this.slider.oninput = () => this.goTo(Number(this.slider.value));
    this.number = element('output', {});
    this.element = group('Keyframes',
      element('div', {className: 'buttons'},
              button('Add keyframe', 'Add keyframe', () => this.add()), this.play),
      row('Frame', this.slider, this.number), this.list);
  }

  get keyframes() { return this.store.state.keyframes; }
  get lastFrame() { return Math.max(0, ...this.keyframes.map(({frame}) => Math.ceil(frame))); }

  set(keyframes) {
    this.store.setKeyframes([...keyframes].sort((a, b) => a.frame - b.frame));
  }

  add() {
    const frame = this.keyframes.length === 0 ? 0 : this.lastFrame + framesBetween;
    const held = cameraKeys.filter((key) => this.store.settings[key] !== undefined)
        .map((key) => [key, this.store.settings[key]]);
    this.set([...this.keyframes, {frame, settings: Object.fromEntries(held)}]);
  }

  move(keyframe, frame) {
    const others = this.keyframes.filter((other) => other !== keyframe && other.frame !== frame);
    this.set([...others, {...keyframe, frame}]);
  }

  remove(keyframe) { this.set(this.keyframes.filter((other) => other !== keyframe)); }

  goTo(frame) {
    this.frame = frame;
    this.showFrame(frame, this.timer !== null);
    this.showPlace();
  }

  togglePlay() {
    if (this.timer !== null) return this.stop();
    const start = performance.now();
    const first = this.frame === null || this.frame >= this.lastFrame ? 0 : this.frame;
    this.timer = setInterval(() => {
      const frame = first + Math.round((performance.now() - start) / 1000 * framesPerSecond);
      if (frame > this.lastFrame) return this.stop();
      this.goTo(frame);
    }, 1000 / framesPerSecond);
    this.showPlace();
  }

  stop() {
    clearInterval(this.timer);
    this.timer = null;
    if (this.frame !== null) this.goTo(Math.min(this.frame, this.lastFrame));
    this.showPlace();
  }

  // The camera was moved: the page's own is shown again.
  leave() {
    clearInterval(this.timer);
    this.timer = null;
    this.frame = null;
  }

  show() {
    this.list.replaceChildren(...this.keyframes.map((keyframe, i) => this.makeItem(keyframe, i + 1)));
    this.showPlace();
  }

  makeItem(keyframe, number) {
    const frame = numberInput(`Frame of keyframe ${number}`, (value) => this.move(keyframe, Math.round(value)),
                              {min: 0, step: 1});
    frame.value = keyframe.frame;
    return element('li', {}, element('div', {className: 'buttons'}, frame,
      button('Go', `Go to keyframe ${number}`, () => this.store.change({...keyframe.settings})),
      button('Remove', `Remove keyframe ${number}`, () => this.remove(keyframe))));
  }

  showPlace() {
    const isFilm = this.keyframes.length > 1;
    this.play.disabled = !isFilm;
    this.play.textContent = this.timer === null ? 'Play' : 'Stop';
    this.slider.disabled = !isFilm;
    this.slider.max = this.lastFrame;
    this.slider.value = this.frame ?? 0;
    this.number.textContent = this.frame === null ? '' : `${this.frame} of ${this.lastFrame}`;
  }
}
