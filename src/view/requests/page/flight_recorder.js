// Records how the camera is moved, and makes few keyframes of it.
import {fewKnots} from './curve.js';
import {length, subtract} from './vector.js';

const samplesPerSecond = 25;
const tolerance = 0.02;  // of the distance to what is looked at
const smoothedSamples = 8;  // to each side: a hand moves by jerks
const mostKeyframes = 60;

export class FlightRecorder {
  constructor(store) {
    this.store = store;
    this.timer = null;
  }

  get isOn() { return this.timer !== null; }

  start() {
    this.samples = [];
    this.begin = performance.now();
    this.take();
    this.timer = setInterval(() => this.take(), 1000 / samplesPerSecond);
  }

  take() {
    const {settings} = this.store;
    this.samples.push({seconds: (performance.now() - this.begin) / 1000,
                       position: settings['camera.position'], lookAt: settings['camera.look_at'],
                       sky: settings['camera.sky'], fieldOfView: settings['camera.field_of_view']});
  }

  // Keyframes from frame 0; none where the camera has not moved.
  stop(framesPerSecond) {
    clearInterval(this.timer);
    this.timer = null;
    this.take();
    const moves = withoutRest(this.samples);
    if (moves.length < 2) return [];
    const points = smoothed(moves.map(({position, lookAt}) => [...position, ...lookAt]));
    const reach = Math.min(...moves.map(({position, lookAt}) => length(subtract(position, lookAt))));
    const chosen = fewKnots(moves.map(({seconds}) => seconds), points,
                            (a, b) => length(subtract(a, b)), tolerance * reach, mostKeyframes);
    return distinct(chosen.map((i) => keyframeOf(moves[i], points[i], moves[0].seconds, framesPerSecond)));
  }
}

const isSame = (a, b) => String(a.position) === String(b.position) && String(a.lookAt) === String(b.lookAt);

// Without the time before the first move and after the last.
function withoutRest(samples) {
  const first = samples.findIndex((sample) => !isSame(sample, samples[0]));
  if (first < 0) return [];
  let end = samples.length;
  while (isSame(samples[end - 2], samples[end - 1])) --end;
  return samples.slice(first - 1, end);
}

// Means over times around each point, less and less of them towards the ends, which stay.
function smoothed(points) {
  return points.map((point, i) => {
    const reach = Math.min(smoothedSamples, i, points.length - 1 - i);
    const near = points.slice(i - reach, i + reach + 1);
    return point.map((_, axis) => near.reduce((sum, other) => sum + other[axis], 0) / near.length);
  });
}

function keyframeOf(sample, point, start, framesPerSecond) {
  const settings = {'camera.position': point.slice(0, 3), 'camera.look_at': point.slice(3), 'camera.sky': sample.sky};
  if (sample.fieldOfView !== undefined) settings['camera.field_of_view'] = sample.fieldOfView;
  return {frame: Math.round((sample.seconds - start) * framesPerSecond), settings, ease: false, dwell: 0};
}

const distinct = (keyframes) => keyframes.filter(({frame}, i) => i === 0 || frame > keyframes[i - 1].frame);
