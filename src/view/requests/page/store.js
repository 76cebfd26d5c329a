import {nameOfKey} from './film_keys.js';

// The state of the page: a value for each key of the scene that the page may set, and which
// components are off. null: left to the data. Keeps what undo needs.
const mostSteps = 200;
const sameGestureMilliseconds = 700;

const copyOf = ({settings, hidden, added, keyframes}) => ({settings: {...settings}, hidden, added, keyframes});
const isEqual = (a, b) => JSON.stringify(a) === JSON.stringify(b);

// What a step of undo is called: by what two states do not have in common.
function changeName(a, b, components) {
  if (!isEqual(a.added, b.added)) return 'components';
  if (!isEqual(a.hidden, b.hidden)) return 'what is shown';
  if (!isEqual(a.keyframes, b.keyframes)) return 'keyframes';
  const keys = Object.keys({...a.settings, ...b.settings}).filter((key) => !isEqual(a.settings[key], b.settings[key]));
  if (keys.length > 0 && keys.every((key) => key.startsWith('camera.'))) return 'camera';
  const names = [...new Set(keys.map((key) => nameOfKey(key, components)))];
  return names.length > 2 ? `${names.length} settings` : names.join(', ');
}

export class Store extends EventTarget {
  constructor(opened, kept) {
    super();
    this.opened = opened;
    this.state = {
      settings: {...opened.settings, ...kept?.settings},
      hidden: kept?.hidden ?? [],
      added: kept?.added ?? [],
      keyframes: kept?.keyframes ?? opened.keyframes,
    };
    // What pictures have in place of settings that suit them no more: shown, but not sent.
    this.instead = {};
    // What the film's frame that is shown has in place of settings. What is changed begins there.
    this.ofFilm = {};
    // Components that were added, by the particles' type, as the program describes them.
    this.known = kept?.known ?? {};
    this.past = [];
    this.future = [];
    this.gesture = null;
    this.gestureTime = 0;
    this.isMoving = false;
  }

  get settings() { return {...this.state.settings, ...this.instead, ...this.ofFilm}; }

  // The opened scene's and those that were added, each with its name and fields.
  get components() {
    const all = [...this.opened.components];
    for (const type of this.state.added) {
      const names = all.map(({name}) => name);
      let name = type;
      for (let i = 2; names.includes(name); ++i) name = `${type} ${i}`;
      all.push({...this.known[type], name, isAdded: true});
    }
    return all;
  }

  // One step of undo takes back all changes of a gesture: of a drag, or of one control within a
  // short time.
  change(settings, {gesture = null, isMoving = false} = {}) {
    this.remember(gesture);
    this.state.settings = {...this.state.settings, ...this.ofFilm, ...settings};
    this.ofFilm = {};
    const isLeft = ([key]) => !('camera.projection' in settings || key in settings);
    this.instead = Object.fromEntries(Object.entries(this.instead).filter(isLeft));
    this.isMoving = isMoving;
    this.tell();
  }

  setHidden(component, isHidden) {
    this.remember(null);
    const others = this.state.hidden.filter((number) => number !== component);
    this.state.hidden = isHidden ? [...others, component].sort((a, b) => a - b) : others;
    this.tell();
  }

  setKeyframes(keyframes) {
    this.remember(null);
    this.keepFilm();
    this.state.keyframes = keyframes;
    this.tell();
  }

  changeFilm(framesPerSecond, keyframes) {
    this.remember(null);
    this.keepFilm();
    this.state.settings = {...this.state.settings, 'movie.frames_per_second': framesPerSecond};
    this.state.keyframes = keyframes;
    this.tell();
  }

  keepFilm() {
    this.state.settings = {...this.state.settings, ...this.ofFilm};
    this.ofFilm = {};
  }

  // What the film's frame that is shown has. No step of its own.
  showFilm(values) {
    if (isEqual(values, this.ofFilm)) return;
    this.ofFilm = values;
    this.dispatchEvent(new Event('decided'));
  }

  // Behind the others. `described`: as the program tells it.
  addComponent(type, described) {
    this.remember(null);
    this.known[type] = described;
    const number = this.opened.components.length + this.state.added.length;
    this.state.added = [...this.state.added, type];
    this.state.settings = {...this.state.settings, ...ofComponent(number, described.settings)};
    this.tell();
  }

  // One that was added. Those behind it take the numbers before theirs.
  removeComponent(number) {
    this.remember(null);
    const place = number - this.opened.components.length;
    this.state.added = this.state.added.filter((_, i) => i !== place);
    this.state.settings = withoutComponent(this.state.settings, number);
    this.state.hidden = this.state.hidden.filter((i) => i !== number).map((i) => (i > number ? i - 1 : i));
    this.state.keyframes = this.state.keyframes.map((keyframe) =>
      ({...keyframe, settings: withoutComponent(keyframe.settings, number)}));
    this.tell();
  }

  // Another state as a whole, in one step.
  take(state) {
    this.remember(null);
    this.state = copyOf(state);
    this.instead = {};
    this.ofFilm = {};
    this.tell();
  }

  copy() { return copyOf(this.state); }

  // What the last step has changed, and what the next would bring back.
  get undoName() { return this.nameOfStep(this.past); }
  get redoName() { return this.nameOfStep(this.future); }

  nameOfStep(steps) {
    const other = steps[steps.length - 1];
    return other ? changeName(other, this.state, this.components) : '';
  }

  // Nothing changes any more: the exact picture may come.
  rest() {
    if (!this.isMoving) return;
    this.isMoving = false;
    this.gesture = null;
    this.tell();
  }

  // Numbers that the program found for keys that were open. No step of their own.
  decide(numbers) {
    const open = Object.entries(numbers).filter(([key]) => this.state.settings[key] === null);
    if (open.length === 0) return;
    this.state.settings = {...this.state.settings, ...Object.fromEntries(open)};
    this.dispatchEvent(new Event('decided'));
  }

  // Values that the picture has in place of those of the scene. No step of their own.
  giveWay(values) {
    if (isEqual(values, this.instead)) return;
    this.instead = values;
    this.dispatchEvent(new Event('decided'));
  }

  // What follows the window. No step of its own, and undo does not go back behind it.
  fit(settings) {
    for (const state of [this.state, ...this.past, ...this.future]) Object.assign(state.settings, settings);
    this.tell();
  }

  undo() { this.step(this.past, this.future); }
  redo() { this.step(this.future, this.past); }

  // What differs from the scene that was opened.
  differences() {
    const {settings, hidden, added, keyframes} = this.state;
    const changed = Object.entries(settings).filter(([k, v]) => !isEqual(v, this.opened.settings[k]));
    const result = {settings: Object.fromEntries(changed), hidden, added};
    if (!isEqual(keyframes, this.opened.keyframes)) result.keyframes = keyframes;
    return result;
  }

  remember(gesture) {
    const now = performance.now();
    const isSame = gesture !== null && gesture === this.gesture &&
        (this.isMoving || now - this.gestureTime < sameGestureMilliseconds);
    this.gesture = gesture;
    this.gestureTime = now;
    if (isSame) return;
    this.past.push(copyOf(this.state));
    if (this.past.length > mostSteps) this.past.shift();
    this.future = [];
  }

  step(from, to) {
    if (from.length === 0) return;
    to.push(copyOf(this.state));
    this.state = from.pop();
    this.instead = {};
    this.ofFilm = {};
    this.gesture = null;
    this.isMoving = false;
    this.tell();
  }

  tell() { this.dispatchEvent(new Event('changed')); }
}

const ofComponent = (number, settings) =>
  Object.fromEntries(Object.entries(settings).map(([key, value]) => [`component.${number}.${key}`, value]));

function withoutComponent(settings, number) {
  const kept = {};
  for (const [key, value] of Object.entries(settings)) {
    const found = key.match(/^component\.(\d+)\.(.*)$/);
    if (!found) {
      kept[key] = value;
    } else if (Number(found[1]) !== number) {
      kept[`component.${Number(found[1]) > number ? found[1] - 1 : found[1]}.${found[2]}`] = value;
    }
  }
  return kept;
}
