// The state of the page: a value for each key of the scene that the page may set, and which
// components are off. null: left to the data. Keeps what undo needs.
const mostSteps = 200;
const sameGestureMilliseconds = 700;

const copyOf = ({settings, hidden, keyframes}) => ({settings: {...settings}, hidden, keyframes});
const isEqual = (a, b) => JSON.stringify(a) === JSON.stringify(b);

export class Store extends EventTarget {
  constructor(opened, kept) {
    super();
    this.opened = opened;
    this.state = {
      settings: {...opened.settings, ...kept?.settings},
      hidden: kept?.hidden ?? [],
      keyframes: kept?.keyframes ?? opened.keyframes,
    };
    // What pictures have in place of settings that suit them no more: shown, but not sent.
    this.instead = {};
    this.past = [];
    this.future = [];
    this.gesture = null;
    this.gestureTime = 0;
    this.isMoving = false;
  }

  get settings() { return {...this.state.settings, ...this.instead}; }

  // One step of undo takes back all changes of a gesture: of a drag, or of one control within a
  // short time.
  change(settings, {gesture = null, isMoving = false} = {}) {
    this.remember(gesture);
    this.state.settings = {...this.state.settings, ...settings};
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
    this.state.keyframes = keyframes;
    this.tell();
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
    const {settings, hidden, keyframes} = this.state;
    const changed = Object.entries(settings).filter(([k, v]) => !isEqual(v, this.opened.settings[k]));
    const result = {settings: Object.fromEntries(changed), hidden};
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
    this.gesture = null;
    this.isMoving = false;
    this.tell();
  }

  tell() { this.dispatchEvent(new Event('changed')); }
}
