// What the pointer and the keys do over the picture.
import {cameraOf, dolly, dollyTowards, fly, lookAround, orbit, pan, recenter} from './camera.js';

const keyOrbit = Math.PI / 24;  // radians
const keyPan = 0.05;            // of the picture's width
const keyDolly = 1.15;
const turnPerWidth = Math.PI;   // a drag across the picture
const wheelPerDolly = 600;      // pixels of the wheel for a factor of e
const wheelRestMilliseconds = 250;
const recenterMilliseconds = 280;
const flySpeed = 0.6;           // distances to matter, or else to the look-at point, in a second
const lookMilliseconds = 300;   // from one look for matter to the next
const slowest = 0.02, fastest = 10;  // distances to the look-at point
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
    this.pointers = new Map();
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
    if (point) this.glide(this.camera, recenter(this.camera, point));
  }

  // From where the camera is to where it shall be, as one step.
  glide(from, to) {
    if (matchMedia('(prefers-reduced-motion: reduce)').matches) return this.store.change(to);
    const gesture = `glide ${++this.drags}`, start = performance.now(), drags = this.drags;
    const tick = (now) => {
      if (drags !== this.drags) return;  // something else moves the camera
      const part = Math.min(1, (now - start) / recenterMilliseconds);
      if (part === 1) {
        this.store.change(to, {gesture, isMoving: true});
        return this.store.rest();
      }
      const eased = part * part * (3 - 2 * part);
      const between = (a, b) => a.map((x, i) => x + (b[i] - x) * eased);
      this.store.change({'camera.position': between(from.position, to['camera.position']),
                         'camera.look_at': between(from.lookAt, to['camera.look_at'])},
                        {gesture, isMoving: true});
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
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
    this.pointers.set(event.pointerId, event);
    if (this.pointers.size > 1) return;  // a second finger joins
    const gesture = `drag ${++this.drags}`;
    const isPan = event.button !== 0 || event.shiftKey;
    const move = (now) => {
      if (!this.pointers.has(now.pointerId)) return;
      const before = this.fingers();
      this.pointers.set(now.pointerId, now);
      const after = this.fingers(), width = this.picture.shownWidth;
      const right = (after.x - before.x) / width, down = (after.y - before.y) / width;
      if (this.pointers.size > 1) {
        const camera = {...this.camera, ...placed(pan(this.camera, right, -down))};
        this.store.change({...pan(this.camera, right, -down), ...dolly(camera, before.apart / after.apart)},
                          {gesture, isMoving: true});
      } else if (right !== 0 || down !== 0) {
        this.store.change(this.dragged(isPan, right, down), {gesture, isMoving: true});
      }
    };
    const end = (now) => {
      this.pointers.delete(now.pointerId);
      if (this.pointers.size > 0) return;
      this.view.removeEventListener('pointermove', move);
      this.view.removeEventListener('lostpointercapture', end);
      this.store.rest();
    };
    this.view.addEventListener('pointermove', move);
    this.view.addEventListener('lostpointercapture', end);
  }

  // The middle of those that are down, and how far the first two are apart.
  fingers() {
    const all = [...this.pointers.values()];
    const mean = (of) => all.reduce((sum, finger) => sum + of(finger), 0) / all.length;
    const [a, b = a] = all;
    return {x: mean((f) => f.clientX), y: mean((f) => f.clientY),
            apart: Math.max(1, Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY))};
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
    const place = this.picture.placeOf(event) ?? {x: 0.5, y: 0.5};
    const {width, height} = this.picture.canvas;
    this.store.change(dollyTowards(this.camera, Math.exp(pixels / wheelPerDolly), place, height / width),
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
    this.lookForMatter();
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

  // How far what is in the middle is, in distances to the look-at point.
  async lookForMatter() {
    this.matter = 1;
    while (this.isFlying) {
      const point = this.held.size === 0 ? undefined : await this.pick({x: 0.5, y: 0.5});
      const {position, lookAt} = this.camera;
      const far = (to) => Math.hypot(...to.map((x, i) => x - position[i]));
      if (point) this.matter = Math.min(fastest, Math.max(slowest, far(point) / far(lookAt)));
      await new Promise((resolve) => { setTimeout(resolve, lookMilliseconds); });
    }
  }

  flyOn(seconds, gesture) {
    if (this.held.size === 0) return this.store.rest();
    const way = seconds * flySpeed * this.matter * (this.isFast ? fastFlight : 1);
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

function placed(settings) {
  return {position: settings['camera.position'], lookAt: settings['camera.look_at']};
}
