// The line of a film's time: its keyframes are dragged, its frames shown.
import {button, checkbox, element} from './elements.js';
import {suggestions} from './film_suggestions.js';
import {nameOfKey} from './film_keys.js';
import {FlightRecorder} from './flight_recorder.js';
import {numberInput} from './number_input.js';
import {readable} from './scaling.js';

const suggestedSeconds = 12;
const mostTicks = 9;
const niceSteps = [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600];

export class Timeline {
  // `draw` opens the dialog that draws the film, `plan` shows its way.
  constructor(place, store, film, {draw, plan}) {
    this.store = store;
    this.film = film;
    this.recorder = new FlightRecorder(store);
    this.play = button('▶', 'Play the keyframes', () => film.togglePlay());
    this.time = element('output', {className: 'time'});
    this.record = button('Record flight', 'Record my flight', () => this.toggleRecording());
    this.suggest = element('select', {'aria-label': 'Suggested films'});
    this.suggest.onchange = () => this.takeSuggestion();
    this.seconds = numberInput('Length of the film in seconds', (value, isMoving) => isMoving || film.setSeconds(value),
                               {min: 0.1, max: 36000});
    this.perSecond = numberInput('Frames per second', (value, isMoving) => isMoving || film.setPerSecond(value),
                                 {min: 0.01, max: 1000});
    this.draw = button('Draw film', 'Draw the film', draw);
    this.slider = element('input', {type: 'range', min: 0, step: 1, value: 0, 'aria-label': 'Frame of the film'});
    this.slider.oninput = () => film.goTo(Number(this.slider.value));
    this.ticks = element('div', {className: 'ticks', 'aria-hidden': true});
    this.marks = element('div', {className: 'marks', role: 'group', 'aria-label': 'Keyframes'});
    this.line = element('div', {className: 'line'}, this.ticks, this.slider, this.marks);
    this.chosen = element('div', {className: 'chosen'});
    const lengths = element('span', {className: 'lengths'}, this.seconds, ' s at ', this.perSecond, ' a second');
    this.lengths = lengths;
    place.replaceChildren(
      element('div', {className: 'film-buttons'}, this.play, this.time,
              button('Add keyframe', 'Add keyframe', () => film.add()), this.record, this.suggest, lengths,
              element('span', {className: 'space'}),
              button('Plan', 'Show the plan of the way', plan), this.draw),
      this.line, this.chosen);
    film.addEventListener('changed', () => this.show());
  }

  get components() {
    const all = this.store.components.map((_, i) => i);
    return all.filter((i) => !this.store.state.hidden.includes(i));
  }

  get scene() {
    return {settings: this.store.settings, times: this.store.opened.times, components: this.components};
  }

  takeSuggestion() {
    const make = suggestions(this.scene).get(this.suggest.value);
    const last = Math.round(suggestedSeconds * this.film.perSecond) - 1;
    if (make) this.film.replace(make(this.scene, last));
    this.suggest.value = '';
  }

  toggleRecording() {
    if (this.recorder.isOn) {
      this.film.append(this.recorder.stop(this.film.perSecond));
    } else {
      this.recorder.start();
    }
    this.show();
  }

  show() {
    const {film} = this;
    const isOn = this.recorder.isOn;
    this.record.textContent = isOn ? 'End recording' : 'Record flight';
    this.record.setAttribute('aria-label', isOn ? 'End the recording' : 'Record my flight');
    this.record.classList.toggle('recording', isOn);
    this.showSuggestions();
    this.play.disabled = !film.isFilm;
    this.play.textContent = film.isPlaying ? '❚❚' : '▶';
    this.play.setAttribute('aria-label', film.isPlaying ? 'Stop the film' : 'Play the keyframes');
    this.draw.disabled = !film.isFilm;
    this.line.hidden = film.keyframes.length === 0;
    this.lengths.hidden = !film.isFilm;
    this.slider.disabled = !film.isFilm;
    this.slider.max = Math.max(1, film.lastFrame);
    this.slider.value = film.frame ?? film.place ?? 0;
    this.slider.setAttribute('aria-valuetext', this.secondsOf(Number(this.slider.value)));
    this.showTime();
    this.showTicks();
    this.showMarks();
    this.showChosen();
  }

  showSuggestions() {
    const names = [...suggestions(this.scene).keys()];
    if (this.suggest.options.length === names.length + 1) return;
    this.suggest.replaceChildren(element('option', {value: ''}, 'Suggested films'),
                                 ...names.map((name) => element('option', {value: name}, name)));
  }

  secondsOf(frame) { return `${(frame / this.film.perSecond).toFixed(1)} s`; }

  showTime() {
    const {film} = this;
    const at = film.frame === null ? '' : `${this.secondsOf(film.frame)} of `;
    this.time.textContent = film.isFilm ? at + this.secondsOf(film.frames) : '';
    if (document.activeElement !== this.seconds) this.seconds.value = readable(film.frames / film.perSecond);
    if (document.activeElement !== this.perSecond) this.perSecond.value = readable(film.perSecond);
  }

  shareOf(frame) { return frame / Math.max(1, this.film.lastFrame); }

  showTicks() {
    const seconds = this.film.lastFrame / this.film.perSecond;
    const step = niceSteps.find((nice) => seconds / nice <= mostTicks) ?? 3600;
    const ticks = [];
    for (let at = 0; at <= seconds + 1e-9; at += step) {
      const tick = element('span', {}, readable(at));
      tick.style.left = `${100 * at / Math.max(seconds, 1e-9)}%`;
      ticks.push(tick);
    }
    this.ticks.replaceChildren(...ticks);
  }

  // Anew only where something has changed: a button that is pressed stays.
  showMarks() {
    const shown = JSON.stringify([this.film.keyframes, this.film.selected, this.film.perSecond]);
    if (shown === this.shownMarks) return;
    this.shownMarks = shown;
    const focused = [...this.marks.children].indexOf(document.activeElement);
    this.marks.replaceChildren(...this.film.keyframes.map((keyframe, i) => this.makeMark(keyframe, i)));
    if (focused >= 0) this.marks.children[this.film.selected ?? focused]?.focus();
  }

  makeMark({frame, ease}, i) {
    const mark = element('button', {type: 'button', className: ease ? 'mark eased' : 'mark', title: this.secondsOf(frame),
                                    'aria-label': `Keyframe ${i + 1} at ${this.secondsOf(frame)}`,
                                    'aria-pressed': String(this.film.selected === i)});
    mark.style.left = `${100 * this.shareOf(frame)}%`;
    mark.onclick = () => this.choose(i);
    mark.onkeydown = (event) => this.pressKey(event, i);
    this.listenToDrag(mark, i);
    return mark;
  }

  choose(i) {
    this.film.select(i);
    if (this.film.isFilm) this.film.goTo(this.film.keyframes[i].frame);
  }

  pressKey(event, i) {
    const steps = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    if (steps) this.film.move(i, this.film.keyframes[i].frame + steps * (event.shiftKey ? 10 : 1));
    if (event.key === 'Delete' || event.key === 'Backspace') this.film.remove(i);
    if (steps || event.key === 'Delete' || event.key === 'Backspace') event.preventDefault();
  }

  listenToDrag(mark, i) {
    mark.onpointerdown = (event) => {
      mark.setPointerCapture(event.pointerId);
      const {left, width} = this.marks.getBoundingClientRect();
      let frame = null;
      mark.onpointermove = (now) => {
        if (frame === null && Math.abs(now.clientX - event.clientX) < 4) return;
        frame = Math.max(0, Math.round((now.clientX - left) / width * this.film.lastFrame));
        mark.style.left = `${100 * this.shareOf(frame)}%`;
        this.time.textContent = this.secondsOf(frame);
      };
      mark.onpointerup = () => {
        mark.onpointermove = null;
        if (frame !== null) this.film.move(i, frame);
      };
    };
  }

  // Up to the next one.
  mostDwell(i) {
    const next = this.film.keyframes[i + 1];
    return next ? Math.max(0, Math.floor(next.frame - this.film.keyframes[i].frame) - 1) : 0;
  }

  showChosen() {
    const i = this.film.selected, keyframe = this.film.keyframes[i];
    const shown = JSON.stringify([i, keyframe, this.film.keyframes[i + 1]?.frame, this.store.state.added]);
    if (shown === this.shownChosen) return;
    this.shownChosen = shown;
    if (!keyframe) return this.chosen.replaceChildren();
    const number = i + 1;
    const frame = numberInput(`Frame of keyframe ${number}`, (value, isMoving) => isMoving || this.film.move(i, value),
                              {min: 0, max: 100000, step: 1, isWhole: true});
    frame.value = readable(keyframe.frame);
    const dwell = numberInput(`Frames that keyframe ${number} stays`,
                              (value, isMoving) => isMoving || this.film.change(i, {dwell: value}),
                              {min: 0, max: this.mostDwell(i), step: 1, isWhole: true});
    dwell.value = readable(keyframe.dwell ?? 0);
    const eases = checkbox('Slow down here', `Slow down at keyframe ${number}`, (ease) => this.film.change(i, {ease}));
    eases.box.checked = keyframe.ease || keyframe.dwell > 0;
    const others = Object.keys(keyframe.settings).filter((key) => !key.startsWith('camera.'))
        .map((key) => nameOfKey(key, this.store.components));
    this.chosen.replaceChildren(
      element('b', {}, `Keyframe ${number}`), element('span', {}, 'frame ', frame), eases.label,
      element('span', {}, 'stays ', dwell),
      button('Take this view', `Take this view for keyframe ${number}`, () => this.film.update(i)),
      button('Remove', `Remove keyframe ${number}`, () => this.film.remove(i)),
      element('span', {className: 'soft'}, ['Camera', ...others].join(', ')));
  }
}
