// Puts the page together: what the controls and the pointer change goes to the program, and what
// it draws is shown.
import {ClipHandles} from './clip_handles.js';
import {ComponentControls} from './component_controls.js';
import {showProblem} from './elements.js';
import {Film} from './film.js';
import {FilmDialog} from './film_dialog.js';
import {FilmPlan} from './film_plan.js';
import {FrameLink} from './frame_link.js';
import {Gestures} from './gestures.js';
import {KeptViews} from './kept_views.js';
import {Link} from './link.js';
import {linkTo, ofBrowser, ofTab, stateInAddress} from './memory.js';
import {Picture} from './picture.js';
import {ProbeTool} from './probe_tool.js';
import {SaveDialog} from './save_dialog.js';
import {cameraControls, componentAdder, lightControls, pictureControls, timeControls} from './scene_controls.js';
import {Store} from './store.js';
import {Timeline} from './timeline.js';
import {WindowFit} from './window_fit.js';

const byId = (id) => document.getElementById(id);
const memory = `splotchcl ${location.pathname}`;

function showTheme(theme) {
  document.documentElement.dataset.theme = theme;
  ofBrowser.setItem('splotchcl theme', theme);
}
showTheme(ofBrowser.getItem('splotchcl theme') ?? 'dark');

class App {
  constructor() {
    this.picture = new Picture(byId('picture'));
    this.store = null;
    this.link = new Link();
    this.frame = new FrameLink(this.link, (text) => this.showError(text));
    this.link.addEventListener('opened', ({detail}) => this.open(detail));
    this.link.addEventListener('frame', ({detail}) => this.showFrame(detail));
    this.link.addEventListener('error', ({detail}) => this.showError(detail.text));
    this.link.addEventListener('film', ({detail}) => this.filmDialog.show(detail));
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
    this.store = new Store(opened, stateInAddress() ?? JSON.parse(ofTab.getItem(memory)));
    this.palettes = new Map(opened.palettes.map(({name, colors}) => [name, colors]));
    this.gestures = new Gestures(byId('view'), this.picture, this.store, (place) => this.pick(place));
    this.probe = new ProbeTool(byId('probe'), byId('probed'), byId('view'), this.picture, this.store,
                               (place) => this.link.ask({type: 'pick', ...place}));
    this.clips = new ClipHandles(byId('clips'), this.picture, this.store);
    this.fit = new WindowFit(this.store);
    this.save = new SaveDialog(this.link, opened, byId('picture'));
    this.film = new Film(this.store, (frame, isPlaying) => this.showFilm(frame, isPlaying));
    this.filmDialog = new FilmDialog(this.link, this.store, this.film,
                                     () => this.save.download('save_scene', byId('film-answer')));
    this.plan = new FilmPlan(byId('plan'), this.store, this.film, this.link);
    this.timeline = new Timeline(byId('film'), this.store, this.film,
                                 {draw: () => this.filmDialog.open(), plan: () => this.plan.toggle()});
    this.kept = new KeptViews(byId('kept'), this.store, this.picture, `${memory} kept`,
                              (text) => this.showError(text));
    this.makeControls();
    if (matchMedia('(max-width: 700px)').matches) {
      this.fold();
      this.toggleFilm();
    }
    this.listen();
    this.show();
    this.frame.open(this.store);
  }

  // Anew where components come and go.
  makeControls() {
    const {opened} = this.store;
    this.componentNames = this.store.components.map(({name}) => name).join('\n');
    const move = (kind, x, y) => this.gestures.move(kind, x, y);
    this.components = this.store.components.map(
        (described, number) => new ComponentControls(number, described, this.palettes, this.store, this.link));
    this.controls = [cameraControls(this.store, move), ...this.components, lightControls(this.store, (look) => this.takeLook(look)),
                     pictureControls(this.store, this.fit)];
    if (opened.times) this.controls.splice(1, 0, timeControls(this.store, opened.times));
    byId('controls').replaceChildren(...this.controls.map((controls) => controls.element));
    this.components[this.components.length - 1].element.after(
        componentAdder(this.store, (type) => this.addComponent(type)));
    byId('controls').onsubmit = (event) => event.preventDefault();
    this.active = this.components[0];
    for (const component of this.components) {
      component.element.addEventListener('focusin', () => { this.active = component; });
    }
  }

  async takeLook(look) {
    try {
      this.store.change((await this.link.ask({type: 'look', look})).settings);
    } catch (error) {
      this.showError(error.message);
    }
  }

  async addComponent(type) {
    try {
      this.say(`Looking at ${type}`);
      const {component} = await this.link.ask({type: 'component', particles: type});
      this.store.addComponent(type, component);
    } catch (error) {
      this.showError(error.message);
    }
  }

  listen() {
    this.store.addEventListener('changed', () => this.changed());
    this.store.addEventListener('decided', () => this.show());
    byId('undo').onclick = () => this.store.undo();
    byId('redo').onclick = () => this.store.redo();
    byId('save-scene').onclick = () => this.save.open('save_scene');
    byId('save-picture').onclick = () => this.save.open('save_picture');
    byId('fold').onclick = () => this.fold();
    byId('film-toggle').onclick = () => this.toggleFilm();
    byId('keep').onclick = () => this.kept.keep();
    byId('swap').onclick = () => this.swap();
    byId('link').onclick = () => this.linkToState();
    byId('theme').onclick = () => showTheme(document.documentElement.dataset.theme === 'light' ? 'dark' : 'light');
    byId('help').onclick = () => byId('help-dialog').showModal();
    byId('view').addEventListener('keydown', (event) => this.pressLetter(event));
    document.addEventListener('keydown', (event) => this.pressShortcut(event));
    window.addEventListener('hashchange', () => location.reload());
  }

  // The controls, away or back.
  fold() {
    const isFolded = document.body.classList.toggle('folded');
    const name = isFolded ? 'Show controls' : 'Hide controls';
    byId('fold').setAttribute('aria-label', name);
    byId('fold').title = name;
  }

  toggleFilm() {
    const isFolded = document.body.classList.toggle('without-film');
    byId('film-toggle').setAttribute('aria-pressed', String(!isFolded));
  }

  swap() {
    this.kept.swap();
    byId('swap').setAttribute('aria-pressed', String(this.kept.isB));
    this.say(this.kept.isB ? 'State B' : 'State A');
  }

  async linkToState() {
    const {store} = this;
    history.replaceState(null, '', linkTo({...store.differences(), known: store.known}));
    try {
      await navigator.clipboard.writeText(location.href);
      this.say('The link is copied');
    } catch {
      this.say('The address above is the link');
    }
  }

  // Beside the field that it is of, where there is one.
  showError(text) {
    const fields = [...document.querySelectorAll('[data-key]')];
    const field = fields.find((one) => this.wordsFor(one.dataset.key).some((words) => text.includes(words)) &&
                                       one.checkVisibility());
    if (field) showProblem(field, text.replace(/^.*(?=found )|^component [^:]*: /, ''));
    byId('error').textContent = field ? '' : text;
    if (field) this.say('This cannot be drawn');
  }

  // How messages name a key.
  wordsFor(key) {
    const [table, number, ...rest] = key.split('.');
    return table === 'component' ? [key, `component ${this.components[number]?.name}: ${rest.join('.')}`] : [key];
  }

  changed() {
    byId('error').textContent = '';
    for (const field of document.querySelectorAll('[data-key][aria-invalid]')) showProblem(field, '');
    if (location.hash !== '') history.replaceState(null, '', location.pathname);
    this.say('Preview');
    this.film.leave();
    this.show();
    this.sendState();
  }

  sendState() {
    const state = this.store.differences();
    ofTab.setItem(memory, JSON.stringify({...state, known: this.store.known}));
    this.link.sendState({...state, moving: this.store.isMoving});
  }

  showFilm(frame, isPlaying) {
    this.link.sendState({...this.store.differences(), frame, moving: isPlaying});
  }

  show() {
    if (this.componentNames !== this.store.components.map(({name}) => name).join('\n')) this.makeControls();
    for (const controls of this.controls) controls.show();
    this.timeline.show();
    this.plan.show();
    this.clips.show();
    for (const [id, word, name] of [['undo', 'Undo', this.store.undoName], ['redo', 'Redo', this.store.redoName]]) {
      byId(id).disabled = name === '';
      byId(id).title = name === '' ? word : `${word}: ${name}`;
    }
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
      if (!this.film.isPlaying) this.store?.showFilm(header.film);
    }
    this.countFrame();
    document.body.dataset.stage = header.stage;
    document.body.dataset.state = header.state;
    // A screen reader is told of what stays.
    if (header.stage !== 'exact') return;
    this.filmDialog.secondsPerFrame = header.seconds;
    this.frame.tellScene().catch((error) => this.showError(error.message));
    byId('error').textContent = header.notes.join('\n');
    this.say(`Exact picture, drawn in ${header.seconds.toFixed(2)} s`);
  }

  countFrame() {
    const now = performance.now();
    this.frameTimes = [...(this.frameTimes ?? []).filter((time) => now - time < 1000), now];
    byId('rate').textContent = `Frames in the last second: ${this.frameTimes.length}; exact to ` +
        `${this.store.settings.tolerance} of white`;
  }

  async pick(place) {
    try {
      return (await this.link.ask({type: 'pick', ...place})).position;
    } catch (error) {
      this.showError(error.message);
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
      k: () => this.film.add(),
      v: () => this.kept.keep(),
      b: () => this.swap(),
      i: () => this.probe.toggle(),
      t: () => { byId('rate').hidden = !byId('rate').hidden; },
      ' ': () => this.film.isFilm && this.film.togglePlay(),
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
    const isTyping = event.target.matches?.('input:not([type=range], [type=checkbox], [type=color])');
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
