// The spheres that clip components, over the picture: the middle and the rim are dragged. For readers
// and keys the numbers of the component do the same.
import {cameraOf} from './camera.js';
import {add, cross, dot, length, normalize, scale, subtract} from './vector.js';

const space = 'http://www.w3.org/2000/svg';

function shape(tag, attributes) {
  const made = document.createElementNS(space, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

export class ClipHandles {
  constructor(drawing, picture, store) {
    this.drawing = drawing;
    this.picture = picture;
    this.store = store;
    this.drags = 0;
    this.shown = [];
  }

  get spheres() {
    const {settings} = this.store;
    return this.store.components.map((_, i) => `component.${i}.select.sphere`)
        .map((key) => ({key, center: settings[`${key}.center`], radius: settings[`${key}.radius`]}))
        .filter(({center, radius}) => center && radius);
  }

  // Where a point is on the screen, and how long a length is there; null: not to be shown.
  project(point) {
    const {settings} = this.store;
    const camera = cameraOf(settings);
    const isFlat = settings['camera.projection'] === 'orthographic';
    if (!isFlat && settings['camera.projection'] !== 'perspective') return null;
    const forward = normalize(subtract(camera.lookAt, camera.position));
    const right = normalize(cross(forward, camera.sky));
    const up = cross(right, forward);
    const offset = subtract(point, camera.position);
    const depth = isFlat ? length(subtract(camera.lookAt, camera.position)) : dot(offset, forward);
    if (!(depth > 0)) return null;
    const pixels = this.picture.shownWidth / (2 * depth * Math.tan(camera.fieldOfView / 2));
    return {x: innerWidth / 2 + dot(offset, right) * pixels, y: innerHeight / 2 - dot(offset, up) * pixels, pixels, right, up};
  }

  show() {
    const keys = this.spheres.map(({key}) => key);
    if (keys.join() !== this.shown.map(({key}) => key).join()) this.make(keys);
    this.place();
  }

  make(keys) {
    this.drawing.replaceChildren();
    this.shown = keys.map((key) => {
      const rim = shape('circle', {class: 'rim'});
      const middle = shape('circle', {class: 'grip', r: 6});
      const grip = shape('circle', {class: 'grip', r: 6});
      this.listen(grip, key, (event, sphere, at) => {
        const away = Math.hypot(event.clientX - at.x, event.clientY - at.y);
        return {[`${key}.radius`]: Number(Math.max(1e-30, away / at.pixels).toPrecision(4))};
      });
      this.listen(middle, key, (event, sphere, at) => {
        const across = scale(at.right, (event.clientX - at.x) / at.pixels);
        return {[`${key}.center`]: add(sphere.center, add(across, scale(at.up, (at.y - event.clientY) / at.pixels)))};
      });
      this.drawing.append(rim, middle, grip);
      return {key, rim, middle, grip};
    });
  }

  place() {
    const spheres = new Map(this.spheres.map((sphere) => [sphere.key, sphere]));
    for (const {key, rim, middle, grip} of this.shown) {
      const sphere = spheres.get(key);
      const at = sphere && this.project(sphere.center);
      for (const part of [rim, middle, grip]) part.style.display = at ? '' : 'none';
      if (!at) continue;
      const radius = sphere.radius * at.pixels;
      set(rim, {cx: at.x, cy: at.y, r: radius});
      set(middle, {cx: at.x, cy: at.y});
      set(grip, {cx: at.x - radius, cy: at.y});
    }
  }

  listen(grip, key, changeAt) {
    grip.addEventListener('pointerdown', (event) => {
      event.stopPropagation();
      grip.setPointerCapture(event.pointerId);
      const gesture = `clip ${++this.drags}`;
      grip.onpointermove = (now) => {
        const sphere = this.spheres.find((one) => one.key === key);
        const at = sphere && this.project(sphere.center);
        if (at) this.store.change(changeAt(now, sphere, at), {gesture, isMoving: true});
      };
      grip.onlostpointercapture = () => {
        grip.onpointermove = null;
        this.store.rest();
      };
    });
  }
}

function set(part, attributes) {
  for (const [name, value] of Object.entries(attributes)) part.setAttribute(name, value);
}
