// The way of a film from above and from the side, in a small second view: where matter is, where the
// camera goes, its keyframes, and where it is now.
import {curveThrough} from './curve.js';
import {cross, dot, normalize, subtract} from './vector.js';

const side = 220;
const margin = 14;
const samples = 200;
const pointsKept = 0.98;  // of matter's spread, so that few outliers do not make all small

export class FilmPlan {
  constructor(place, store, film, link) {
    this.place = place;
    this.canvas = place.querySelector('canvas');
    this.store = store;
    this.film = film;
    this.link = link;
    this.places = null;
    film.addEventListener('changed', () => this.show());
  }

  toggle() {
    this.place.hidden = !this.place.hidden;
    if (!this.place.hidden && this.places === null) this.ask();
    this.show();
  }

  async ask() {
    try {
      this.places = (await this.link.ask({type: 'places'})).places;
    } catch {
      this.places = [];
    }
    this.show();
  }

  show() {
    if (this.place.hidden) return;
    const scale = window.devicePixelRatio;
    [this.canvas.width, this.canvas.height] = [2 * side * scale, side * scale];
    const context = this.canvas.getContext('2d');
    context.scale(scale, scale);
    const style = getComputedStyle(this.canvas);
    const colors = {accent: style.getPropertyValue('--accent'), text: style.color};
    const axes = axesOf(this.store.opened.settings['camera.sky']);
    [[axes.right, axes.back, 'from above'], [axes.right, axes.down, 'from the side']].forEach(([x, y, name], i) => {
      context.save();
      context.translate(i * side, 0);
      this.draw(context, (point) => [dot(point, x), dot(point, y)], name, colors);
      context.restore();
    });
  }

  draw(context, project, name, {accent, text}) {
    const {way, knots} = this.wayOf();
    const {settings} = this.store;
    const here = settings['camera.position'], target = settings['camera.look_at'];
    const matter = [];
    for (let i = 0; i < (this.places?.length ?? 0); i += 3) matter.push(project(this.places.slice(i, i + 3)));
    const place = fitting([...core(matter), ...[...way, here, target].map(project)]);
    context.fillStyle = text;
    context.globalAlpha = 0.25;
    for (const point of matter) context.fillRect(...place(point), 1.2, 1.2);
    context.globalAlpha = 1;
    context.font = '11px system-ui, sans-serif';
    context.fillText(name, margin, side - 5);
    line(context, way.map((point) => place(project(point))), accent, 1.6);
    context.fillStyle = accent;
    for (const knot of knots) disc(context, place(project(knot)), 2.6);
    line(context, [here, target].map((point) => place(project(point))), text, 1);
    context.fillStyle = text;
    disc(context, place(project(here)), 3.4);
  }

  wayOf() {
    const key = 'camera.position';
    const held = this.film.keyframes.filter(({settings}) => settings[key]);
    if (held.length === 0) return {way: [], knots: []};
    const knots = held.map(({settings}) => settings[key]);
    const curve = curveThrough(held.map(({frame}) => frame), knots);
    const first = held[0].frame, last = held[held.length - 1].frame;
    return {knots, way: Array.from({length: samples + 1}, (_, i) => curve(first + (last - first) * i / samples))};
  }
}

function axesOf(sky) {
  const up = normalize(sky);
  const other = Math.abs(up[2]) < 0.9 ? [0, 0, 1] : [0, 1, 0];
  const right = normalize(cross(up, other));
  return {right, back: cross(right, up), down: subtract([0, 0, 0], up)};
}

// Without what is farthest out along each axis.
function core(points) {
  const limits = [0, 1].map((axis) => {
    const sorted = points.map((point) => point[axis]).sort((a, b) => a - b);
    const cut = Math.floor(sorted.length * (1 - pointsKept) / 2);
    return [sorted[cut], sorted[sorted.length - 1 - cut]];
  });
  return points.filter((point) => limits.every(([low, high], axis) => point[axis] >= low && point[axis] <= high));
}

// From lengths to pixels, so that all of these are in the square.
function fitting(points) {
  const ends = (axis) => points.reduce(([low, high], point) =>
    [Math.min(low, point[axis]), Math.max(high, point[axis])], [Infinity, -Infinity]);
  const [left, right] = ends(0), [top, bottom] = ends(1);
  const scale = (side - 2 * margin) / Math.max(right - left, bottom - top, 1e-30);
  return ([x, y]) => [side / 2 + (x - (left + right) / 2) * scale, side / 2 + (y - (top + bottom) / 2) * scale];
}

function line(context, points, color, width) {
  context.strokeStyle = color;
  context.lineWidth = width;
  context.beginPath();
  points.forEach(([x, y], i) => (i === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
  context.stroke();
}

function disc(context, [x, y], radius) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fill();
}
