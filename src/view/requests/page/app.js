// Puts the page together: what the controls and the pointer change goes to the program, and what
// it draws is shown.
import {ComponentControls} from './component_controls.js';
import {Gestures} from './gestures.js';
import {KeyframeControls} from './keyframe_controls.js';
import {Link} from './link.js';
import {Picture} from './picture.js';
import {SaveDialog} from './save_dialog.js';
import {cameraControls, lightControls, pictureControls, timeControls} from './scene_controls.js';
import {Store} from './store.js';
import {WindowFit} from './window_fit.js';

const byId = (id) => document.getElementById(id);
const memory = `splotchcl ${location.pathname}`;

function showTheme(theme) {
  document.documentElement.dataset.theme = theme;
  localStorage.setItem('splotchcl theme', theme);
}
showTheme(localStorage.getItem('splotchcl theme') ?? 'dark');

class App {
  constructor() {
    this.picture = new Picture(byId('picture'));
    this.store = null;
    this.link = new Link();
    this.link.addEventListener('opened', ({detail}) => this.open(detail));
    this.link.addEventListener('frame', ({detail}) => this.showFrame(detail));
    this.link.addEventListener('error', ({detail}) => { byId('error').textContent = detail.text; });
    this.link.addEventListener('lost', () => this.say('Not connected: trying again. Does splotchcl view still run?'));
  }

  say(text) { byId('status').textContent = text; }

  // At the first connection, and when a lost one has come back.
  open(opened) {
    this.say('Drawing');
    if (this.store === null) this.build(opened);
    this.sendState();
  }

  build(opened) {
    byId('name').textContent = opened.name;
    document.title = `${opened.name} – splotchcl view`;
    this.store = new Store(opened, JSON.parse(sessionStorage.getItem(memory)));
    this.gestures = new Gestures(byId('view'), this.picture, this.store, (place) => this.pick(place));
    const move = (kind, x, y) => this.gestures.move(kind, x, y);
    this.fit = new WindowFit(this.store);
    this.components = opened.components.map(
        (_, number) => new ComponentControls(number, opened, this.store, this.link));
    this.keyframes = new KeyframeControls(this.store, (frame, isPlaying) => this.showFilm(frame, isPlaying));
    this.controls = [cameraControls(this.store, move), ...this.components, lightControls(this.store),
                     this.keyframes, pictureControls(this.store, this.fit)];
    if (opened.times) this.controls.splice(1, 0, timeControls(this.store, opened.times));
    byId('controls').replaceChildren(...this.controls.map((controls) => controls.element));
    byId('controls').onsubmit = (event) => event.preventDefault();
    this.active = this.components[0];
    for (const component of this.components) {
      component.element.addEventListener('focusin', () => { this.active = component; });
    }
    if (matchMedia('(max-width: 700px)').matches) this.fold();
    this.save = new SaveDialog(this.link, opened, byId('picture'));
    this.listen();
    this.show();
  }

  listen() {
    this.store.addEventListener('changed', () => this.changed());
    this.store.addEventListener('decided', () => this.show());
    byId('undo').onclick = () => this.store.undo();
    byId('redo').onclick = () => this.store.redo();
    byId('save-scene').onclick = () => this.save.open('save_scene');
    byId('save-picture').onclick = () => this.save.open('save_picture');
    byId('fold').onclick = () => this.fold();
    byId('theme').onclick = () => showTheme(document.documentElement.dataset.theme === 'light' ? 'dark' : 'light');
    byId('help').onclick = () => byId('help-dialog').showModal();
    byId('view').addEventListener('keydown', (event) => this.pressLetter(event));
    document.addEventListener('keydown', (event) => this.pressShortcut(event));
  }

  // The controls, away or back.
  fold() {
    const isFolded = document.body.classList.toggle('folded');
    const name = isFolded ? 'Show controls' : 'Hide controls';
    byId('fold').setAttribute('aria-label', name);
    byId('fold').title = name;
  }

  changed() {
    byId('error').textContent = '';
    this.say('Preview');
    this.keyframes.leave();
    this.show();
    this.sendState();
  }

  sendState() {
    const state = this.store.differences();
    sessionStorage.setItem(memory, JSON.stringify(state));
    this.link.sendState({...state, moving: this.store.isMoving});
  }

  showFilm(frame, isPlaying) {
    this.link.sendState({...this.store.differences(), frame, moving: isPlaying});
  }

  show() {
    for (const controls of this.controls) controls.show();
    byId('undo').disabled = this.store.past.length === 0;
    byId('redo').disabled = this.store.future.length === 0;
  }

  async showFrame({header, file}) {
    try {
      await this.picture.show(file);
    } finally {
      this.link.acknowledge(header.frame);
    }
    if (header.state === this.link.lastState) {
      this.store?.decide(header.decided);
      this.store?.giveWay(header.given_way);
    }
    document.body.dataset.stage = header.stage;
    document.body.dataset.state = header.state;
    // A screen reader is told of what stays.
    if (header.stage !== 'exact') return;
    byId('error').textContent = header.notes.join('\n');
    this.say(`Exact picture, drawn in ${header.seconds.toFixed(2)} s`);
  }

  async pick(place) {
    try {
      return (await this.link.ask({type: 'pick', ...place})).position;
    } catch (error) {
      byId('error').textContent = error.message;
      return undefined;
    }
  }

  pressLetter(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const actions = {
      l: () => this.active.toggleLog(),
      a: () => this.active.range?.adapt(),
      m: () => this.active.nextPalette(1),
      M: () => this.active.nextPalette(-1),
      r: () => this.active.range?.focus(),
      k: () => this.keyframes.add(),
      o: () => this.fold(),
      s: () => this.save.open('save_scene'),
      p: () => this.save.open('save_picture'),
    };
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  pressShortcut(event) {
    const isTyping = event.target.matches?.('input:not([type=range], [type=checkbox])');
    if (event.key === '?' && !isTyping && !document.querySelector('dialog[open]')) {
      byId('help-dialog').showModal();
    }
    if (!(event.ctrlKey || event.metaKey) || isTyping) return;
    const key = event.key.toLowerCase();
    if (key === 'z' || key === 'y') event.preventDefault();
    if (key === 'y' || (key === 'z' && event.shiftKey)) {
      this.store.redo();
    } else if (key === 'z') {
      this.store.undo();
    }
  }
}

window.app = new App();
