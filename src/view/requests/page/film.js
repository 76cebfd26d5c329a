// The film of a scene: its keyframes in time. What they hold, and what each frame shows, is what
// splotchcl movie draws of the saved scene.
import {changedKeys, movableKeys} from './film_keys.js';

const secondsBetween = 2;
const playsPerSecond = 25;

export class Film extends EventTarget {
  // `showFrame(frame, isPlaying)` has the film's frame drawn; null: the page's own view.
  constructor(store, showFrame) {
    super();
    this.store = store;
    this.showFrame = showFrame;
    this.frame = null;     // that is shown
    this.timer = null;     // while it plays
    this.selected = null;  // a keyframe's number
    this.held = {...store.settings};
  }

  get keyframes() { return this.store.state.keyframes; }
  get perSecond() { return this.store.settings['movie.frames_per_second']; }
  get lastFrame() { return Math.max(0, ...this.keyframes.map(({frame}) => Math.ceil(frame))); }
  get frames() { return this.lastFrame + 1; }
  get isFilm() { return this.keyframes.length > 1; }
  get isPlaying() { return this.timer !== null; }

  set(keyframes) {
    const chosen = this.keyframes[this.selected];
    const sorted = [...keyframes].sort((a, b) => a.frame - b.frame);
    this.store.setKeyframes(sorted);
    const at = sorted.findIndex(({frame}) => frame === chosen?.frame);
    this.selected = at < 0 ? null : at;
    this.tell();
  }

  // What is shown becomes a keyframe: where the film stands, else behind its end. Whatever has been
  // changed since the last one moves from now on.
  add() {
    const {settings} = this.store;
    const changed = this.keyframes.length === 0 ? [] : changedKeys(this.held, settings);
    const keys = movableKeys(this.keyframes, settings, changed);
    const old = (key) => this.held[key];
    const earlier = this.keyframes.map((keyframe) => {
      const missing = changed.filter((key) => keyframe.settings[key] === undefined && old(key) !== null);
      return {...keyframe, settings: {...Object.fromEntries(missing.map((key) => [key, old(key)])), ...keyframe.settings}};
    });
    const frame = this.placeOfNext();
    const before = earlier.find((keyframe) => keyframe.frame === frame);
    const added = {ease: false, dwell: 0, ...before, frame,
                   settings: Object.fromEntries(keys.map((key) => [key, settings[key]]))};
    this.place = null;
    this.set([...earlier.filter((keyframe) => keyframe !== before), added]);
    this.held = {...settings};
    this.select(this.keyframes.findIndex((keyframe) => keyframe.frame === frame));
  }

  placeOfNext() {
    if (this.keyframes.length === 0) return 0;
    return this.place ?? this.lastFrame + Math.round(secondsBetween * this.perSecond);
  }

  replace(keyframes) {
    this.set(keyframes);
    this.held = {...this.store.settings};
    this.select(null);
  }

  change(number, change) {
    this.set(this.keyframes.map((keyframe, i) => (i === number ? {...keyframe, ...change} : keyframe)));
  }

  // Where another one is, it takes its place.
  move(number, frame) {
    const moved = {...this.keyframes[number], frame: Math.max(0, Math.round(frame))};
    const others = this.keyframes.filter((other, i) => i !== number && other.frame !== moved.frame);
    this.set([...others, moved]);
    this.select(this.keyframes.findIndex((keyframe) => keyframe.frame === moved.frame));
  }

  remove(number) {
    this.set(this.keyframes.filter((_, i) => i !== number));
    this.select(null);
  }

  // What is shown, in place of what it held.
  update(number) {
    const {settings} = this.store;
    const keys = Object.keys(this.keyframes[number].settings);
    this.change(number, {settings: Object.fromEntries(keys.map((key) => [key, settings[key]]))});
  }

  select(number) {
    this.selected = number;
    this.tell();
  }

  // The film becomes so long; its keyframes keep their shares.
  setSeconds(seconds, perSecond = this.perSecond) {
    const last = Math.max(1, Math.round(seconds * perSecond) - 1);
    const factor = last / Math.max(1, this.lastFrame);
    this.store.changeFilm(perSecond, this.keyframes.map((keyframe) =>
      ({...keyframe, frame: Math.round(keyframe.frame * factor), dwell: (keyframe.dwell ?? 0) * factor})));
    this.tell();
  }

  setPerSecond(perSecond) { this.setSeconds(this.frames / this.perSecond, perSecond); }

  append(keyframes) {
    const start = this.keyframes.length === 0 ? 0 : this.lastFrame + Math.round(secondsBetween * this.perSecond);
    this.set([...this.keyframes, ...keyframes.map((keyframe) => ({...keyframe, frame: keyframe.frame + start}))]);
    this.held = {...this.store.settings};
  }

  goTo(frame) {
    this.frame = Math.min(frame, this.lastFrame);
    this.place = this.frame;
    this.showFrame(this.frame, this.isPlaying);
    this.tell();
  }

  play() {
    const start = performance.now();
    const first = this.frame === null || this.frame >= this.lastFrame ? 0 : this.frame;
    this.timer = setInterval(() => {
      const frame = first + Math.round((performance.now() - start) / 1000 * this.perSecond);
      if (frame > this.lastFrame) {
        this.frame = this.lastFrame;
        return this.stop();
      }
      this.goTo(frame);
    }, 1000 / playsPerSecond);
    this.tell();
  }

  stop() {
    this.stopTimer();
    if (this.frame !== null) this.goTo(this.frame);
    this.tell();
  }

  togglePlay() { this.isPlaying ? this.stop() : this.play(); }

  // Something was changed: the page's own view is shown again.
  leave() {
    this.stopTimer();
    this.frame = null;
    this.tell();
  }

  stopTimer() {
    clearInterval(this.timer);
    this.timer = null;
  }

  tell() { this.dispatchEvent(new Event('changed')); }
}
