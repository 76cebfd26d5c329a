// What the page that shows this one in a frame is told, and what it may change: a notebook's
// widget. The policy of frames lets in none but that page.
export class FrameLink {
  constructor(link, onProblem) {
    this.link = link;
    this.onProblem = onProblem;
    this.store = null;
    this.origin = null;  // of the page around this one, once it has spoken
    if (window.parent !== window) window.addEventListener('message', (event) => this.take(event));
  }

  open(store) {
    this.store = store;
    this.tellKeys();
  }

  take({source, origin, data}) {
    if (source !== window.parent) return;
    if (data.splotchcl === 'hello') {
      this.origin = origin;
      this.tellKeys();
    } else if (data.splotchcl === 'set' && this.store) {
      this.set(data.settings);
    }
  }

  tellKeys() {
    if (this.store) this.tell('opened', {keys: Object.keys(this.store.settings)});
  }

  // Components are numbered as in the scene's text, which leaves out those that are off.
  set(settings) {
    const {components, state} = this.store;
    const shown = components.map((_, i) => i).filter((i) => !state.hidden.includes(i));
    const own = (key) => key.replace(/^component\.(\d+)\./, (_, number) => `component.${shown[number]}.`);
    const changes = Object.fromEntries(Object.entries(settings).map(([key, value]) => [own(key), value]));
    const unknown = Object.keys(changes).find((key) => !(key in this.store.settings));
    if (unknown) {
      this.onProblem(`key ${unknown}: this page cannot change it`);
    } else {
      this.store.change(changes);
    }
  }

  async tellScene() {
    if (this.origin === null) return;
    const {now} = await this.link.ask({type: 'scene_text'});
    this.tell('scene', {toml: now});
  }

  tell(what, content) {
    if (this.origin !== null) window.parent.postMessage({splotchcl: what, ...content}, this.origin);
  }
}
