// What the pointer and the keys do over the picture.
import {cameraOf, dolly, fly, lookAround, orbit, pan, recenter} from './camera.js';

const keyOrbit = Math.PI / 24;  // radians
const keyPan = 0.05;            // of the picture's width
const keyDolly = 1.15;
const turnPerWidth = Math.PI;   // a drag across the picture
const wheelPerDolly = 600;      // pixels of the wheel for a factor of e
const wheelRestMilliseconds = 250;
const flySpeed = 0.6;           // distances to the look-at point in a second
const fastFlight = 4;
const flightKeys = {KeyW: [0, 0, 1], KeyS: [0, 0, -1], KeyD: [1, 0, 0], KeyA: [-1, 0, 0],
                    KeyE: [0, 1, 0], KeyQ: [0, -1, 0]};

export class Gestures {
  // `pick` resolves to the point of the data at a place of the picture, or to undefined.
  constructor(view, picture, store, pick) {
    this.view = view;
    this.picture = picture;
    this.store = store;
    this.pick = pick;
    this.drags = 0;
    this.isFlying = false;
    this.held = new Set();
    this.listen();
  }

  get camera() { return cameraOf(this.store.settings); }

  // A step by a button or a key. x and y: to the right and upwards.
  move(kind, x, y) {
    if (kind === 'orbit') this.step(orbit(this.camera, -x * keyOrbit, y * keyOrbit), kind);
    if (kind === 'pan') this.step(pan(this.camera, -x * keyPan, -y * keyPan), kind);
    if (kind === 'dolly') this.step(dolly(this.camera, keyDolly ** x), kind);
    if (kind === 'fly') this.setFlying(!this.isFlying);
    if (kind === 'home') this.goHome();
  }

  step(change, gesture) { this.store.change(change, {gesture}); }

  goHome() {
    const {settings} = this.store.opened;
    const keys = Object.keys(settings).filter((key) => key.startsWith('camera.'));
    this.store.change(Object.fromEntries(keys.map((key) => [key, settings[key]])));
  }

  async recenterAt(place) {
    const point = await this.pick(place);
    if (point) this.store.change(recenter(this.camera, point));
  }

  listen() {
    const {view} = this;
    view.addEventListener('contextmenu', (event) => event.preventDefault());
    view.addEventListener('pointerdown', (event) => this.startDrag(event));
    view.addEventListener('wheel', (event) => this.turnWheel(event), {passive: false});
    view.addEventListener('dblclick', (event) => {
      const place = this.picture.placeOf(event);
      if (place) this.recenterAt(place);
    });
    view.addEventListener('keydown', (event) => this.pressKey(event));
    view.addEventListener('keyup', (event) => this.held.delete(event.code));
    view.addEventListener('blur', () => this.setFlying(false));
  }

  startDrag(event) {
    if (event.button > 2) return;
    this.view.focus();
    this.view.setPointerCapture(event.pointerId);
    const gesture = `drag ${++this.drags}`;
    const isPan = event.button !== 0 || event.shiftKey;
    let last = event;
    const move = (now) => {
      const width = this.picture.shownWidth;
      const right = (now.clientX - last.clientX) / width, down = (now.clientY - last.clientY) / width;
      last = now;
      if (right !== 0 || down !== 0) {
        this.store.change(this.dragged(isPan, right, down), {gesture, isMoving: true});
      }
    };
    const end = () => {
      this.view.removeEventListener('pointermove', move);
      this.store.rest();
    };
    this.view.addEventListener('pointermove', move);
    this.view.addEventListener('lostpointercapture', end, {once: true});
  }

  dragged(isPan, right, down) {
    if (isPan) return pan(this.camera, right, -down);
    const turn = this.isFlying ? lookAround : orbit;
    const upward = this.isFlying ? -down : down;
    return turn(this.camera, right * turnPerWidth, upward * turnPerWidth);
  }

  turnWheel(event) {
    event.preventDefault();
    const pixels = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? event.deltaY : 30 * event.deltaY;
    this.store.change(dolly(this.camera, Math.exp(pixels / wheelPerDolly)),
                      {gesture: 'wheel', isMoving: true});
    clearTimeout(this.wheelRest);
    this.wheelRest = setTimeout(() => this.store.rest(), wheelRestMilliseconds);
  }

  pressKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (this.isFlying && flightKeys[event.code]) {
      this.held.add(event.code);
      this.isFast = event.shiftKey;
      event.preventDefault();
      event.stopPropagation();
      return;
    }
    const kind = event.shiftKey ? 'pan' : 'orbit';
    const actions = {
      ArrowLeft: [kind, -1, 0], ArrowRight: [kind, 1, 0], ArrowUp: [kind, 0, 1],
      ArrowDown: [kind, 0, -1], '+': ['dolly', -1, 0], '=': ['dolly', -1, 0], '-': ['dolly', 1, 0],
      f: ['fly', 0, 0], h: ['home', 0, 0],
    };
    if (event.key === 'Escape' && this.isFlying) this.setFlying(false);
    if (event.key === 'c') this.recenterAt({x: 0.5, y: 0.5});
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    this.move(...action);
  }

  setFlying(isFlying) {
    if (isFlying === this.isFlying) return;
    this.isFlying = isFlying;
    document.getElementById('flying').hidden = !isFlying;
    this.held.clear();
    if (!isFlying) return this.store.rest();
    this.view.focus();
    const gesture = `flight ${++this.drags}`;
    let last = performance.now();
    const tick = (now) => {
      if (!this.isFlying) return;
      this.flyOn(Math.min(0.1, (now - last) / 1000), gesture);
      last = now;
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  flyOn(seconds, gesture) {
    if (this.held.size === 0) return this.store.rest();
    const way = seconds * flySpeed * (this.isFast ? fastFlight : 1);
    let [right, up, forward] = [0, 0, 0];
    for (const code of this.held) {
      const [x, y, z] = flightKeys[code];
      right += x * way;
      up += y * way;
      forward += z * way;
    }
    this.store.change(fly(this.camera, right, up, forward), {gesture, isMoving: true});
  }
}
