// Pictures that fill the window: a scene that was chosen for a snapshot has no shape of its own.
const mostPixels = 4e6;
const restMilliseconds = 200;
const degrees = Math.PI / 180;

export class WindowFit {
  constructor(store) {
    this.store = store;
    this.isOn = store.opened.fills_window;
    window.addEventListener('resize', () => {
      clearTimeout(this.rest);
      this.rest = setTimeout(() => this.fit(), restMilliseconds);
    });
    this.fit();
  }

  set(isOn) {
    this.isOn = isOn;
    this.fit();
  }

  // Of the user's choice.
  setSize(size) {
    this.isOn = false;
    const before = this.store.settings['image.size'];
    this.store.change({'image.size': size, ...fieldOfView(this.store.settings, before, size)}, {gesture: 'image.size'});
  }

  fit() {
    if (!this.isOn) return;
    const size = windowSize();
    const before = this.store.settings['image.size'];
    if (size[0] === before[0] && size[1] === before[1]) return;
    this.store.fit({'image.size': size, ...fieldOfView(this.store.settings, before, size)});
  }
}

function windowSize() {
  const {innerWidth: width, innerHeight: height} = window;
  const scale = Math.min(window.devicePixelRatio, Math.sqrt(mostPixels / (width * height)));
  return [width, height].map((side) => Math.max(16, Math.round(side * scale)));
}

// What the shorter side shows stays.
function fieldOfView(settings, before, size) {
  const key = 'camera.field_of_view', now = settings[key];
  if (now === undefined || !['perspective', 'orthographic'].includes(settings['camera.projection'])) return {};
  const part = ([width, height]) => width / Math.min(width, height);
  const tangent = Math.tan(now * degrees / 2) / part(before) * part(size);
  return {[key]: Number((2 * Math.atan(tangent) / degrees).toFixed(4))};
}
