// Has the film drawn where the program runs, tells how far it is, and gives the browser the film and
// its scene. Films are everybody's who has the page open.
import {element} from './elements.js';

const byId = (id) => document.getElementById(id);

export function durationOf(seconds) {
  const whole = Math.round(seconds);
  if (whole < 90) return `${whole} s`;
  return whole < 5400 ? `${Math.round(whole / 60)} min` : `${(whole / 3600).toFixed(1)} h`;
}

export class FilmDialog {
  constructor(link, store, film, download) {
    this.link = link;
    this.store = store;
    this.film = film;
    this.download = download;
    this.replaces = false;
    this.secondsPerFrame = null;
    this.dialog = byId('film-dialog');
    byId('film-path').value = store.opened.film_file;
    byId('film-path').oninput = () => this.mayReplace(false);
    this.dialog.querySelector('form').onsubmit = (event) => {
      event.preventDefault();
      this.start();
    };
    byId('film-cancel').onclick = () => link.send({type: 'cancel_film'});
    byId('film-close').onclick = () => this.dialog.close();
    byId('film-scene').onclick = () => download();
    this.show({state: 'none'});
  }

  open() {
    const [width, height] = this.store.settings['image.size'];
    const {frames, perSecond} = this.film;
    const about = this.secondsPerFrame === null ? '' : ` Drawing takes about ${durationOf(frames * this.secondsPerFrame)}.`;
    byId('film-about').textContent = `${frames} frames of ${width} × ${height} pixels, ` +
        `${durationOf(frames / perSecond)} at ${perSecond} a second.${about}`;
    if (!this.isUnderWay) byId('film-answer').textContent = '';
    this.mayReplace(false);
    this.dialog.showModal();
  }

  mayReplace(may) {
    this.replaces = may;
    byId('film-go').textContent = may ? 'Replace and draw' : 'Draw film';
  }

  async start() {
    const answer = byId('film-answer');
    answer.textContent = 'Starting';
    try {
      const {saved, path} = await this.link.ask({type: 'make_film', path: byId('film-path').value, replace: this.replaces});
      if (!saved) answer.textContent = `${path} or the scene beside it exists already. Replace it?`;
      this.mayReplace(!saved);
    } catch (error) {
      answer.textContent = error.message;
    }
  }

  // What the program tells of the film that is drawn.
  show(progress) {
    const {state, done, frames, number, path, text} = progress;
    this.isUnderWay = ['reading', 'drawing', 'joining'].includes(state);
    const bar = byId('film-progress');
    bar.hidden = !this.isUnderWay;
    if (frames > 0) [bar.max, bar.value] = [frames, done];
    else bar.removeAttribute('value');
    byId('film-go').disabled = this.isUnderWay;
    byId('film-cancel').hidden = !this.isUnderWay;
    const isDone = state === 'complete';
    byId('film-download').hidden = !isDone;
    if (isDone) {
      byId('film-download').href = `film/${number}`;
      byId('film-download').download = path.split('/').pop();
    }
    const left = progress.seconds_left === undefined ? '' : `, ${durationOf(progress.seconds_left)} left`;
    const words = {reading: 'Reading', drawing: `Frame ${done} of ${frames}${left}`, joining: 'Joining the frames',
                   complete: `Drawn: ${path}`, cancelled: 'Cancelled. Nothing is left of it.', failed: text};
    if (words[state]) byId('film-answer').textContent = words[state];
    document.body.dataset.film = state;
    const short = {drawing: `Film ${Math.floor(100 * done / frames)} %`, reading: 'Film: reading', joining: 'Film: joining'};
    byId('film-short').textContent = short[state] ?? '';
  }
}
