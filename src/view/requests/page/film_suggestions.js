// Films that suit what is shown: each makes keyframes of so many frames from the settings.
import {cameraOf, dolly, orbit} from './camera.js';

const turnSteps = 12;
const closest = 0.2;  // of the distance at the start

function cameraKeyframe(settings, frame, camera, change) {
  const kept = {'camera.position': camera.position, 'camera.look_at': camera.lookAt, 'camera.sky': settings['camera.sky']};
  if (settings['camera.field_of_view'] !== undefined) kept['camera.field_of_view'] = settings['camera.field_of_view'];
  return {frame, settings: {...kept, ...change}, ease: false, dwell: 0};
}

// From step to step of the whole, 0 to 1.
function along(settings, last, steps, changeAt) {
  const camera = cameraOf(settings);
  return Array.from({length: steps + 1}, (_, i) =>
    cameraKeyframe(settings, Math.round(last * i / steps), camera, changeAt(camera, i / steps)));
}

const turn = ({settings}, last) =>
  along(settings, last, turnSteps, (camera, part) => orbit(camera, 2 * Math.PI * part, 0));

const dive = ({settings}, last) =>
  along(settings, last, 6, (camera, part) => dolly(camera, closest ** part));

const swing = ({settings}, last) => along(settings, last, 8, (camera, part) => {
  const nearer = {...camera, position: dolly(camera, (2 * closest) ** part)['camera.position']};
  return orbit(nearer, Math.PI * part, 0);
});

const time = ({settings, times}, last) => along(settings, last, 1, (_, part) =>
  ({'time.index': times[0] + part * (times[1] - times[0])}));

// Each component comes in its own share of the film's first half.
function appear({settings, components}, last) {
  const share = 0.5 / components.length;
  const brightness = components.map((i) => [`component.${i}.brightness`, settings[`component.${i}.brightness`]]);
  return Array.from({length: components.length + 2}, (_, step) => {
    const isEnd = step === components.length + 1;
    const held = brightness.map(([key, value], i) => [key, step > i || isEnd ? value : 0]);
    const frame = isEnd ? last : Math.round(last * share * step);
    const camera = cameraOf(settings);
    return cameraKeyframe(settings, frame, camera,
      {...orbit(camera, Math.PI / 2 * frame / last, 0), ...Object.fromEntries(held)});
  });
}

// By their names, those that the scene can have.
export function suggestions({times, components}) {
  const found = [['Turn once', turn], ['Move closer', dive], ['Swing closer', swing]];
  if (times) found.push(['Through time', time]);
  if (components.length > 1) found.push(['One kind after another', appear]);
  return new Map(found);
}
