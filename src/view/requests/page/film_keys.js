// Which settings move in a film.
const cameraKeys = ['camera.position', 'camera.look_at', 'camera.sky', 'camera.field_of_view'];
const still = ['image.size', 'tolerance', 'movie.', 'stereo.', 'select.where'];

const isNumber = (value) => typeof value === 'number' || (Array.isArray(value) && typeof value[0] === 'number');

const canMove = (key, value) => isNumber(value) && !still.some((word) => key.includes(word));

// Beside the camera: numbers that are others now.
export function changedKeys(before, now) {
  return Object.keys(now).filter((key) => !cameraKeys.includes(key) && canMove(key, now[key]) &&
      isNumber(before[key]) && JSON.stringify(before[key]) !== JSON.stringify(now[key]));
}

// Those of a new keyframe: the camera's, and what other keyframes hold.
export function movableKeys(keyframes, settings, changed) {
  const held = keyframes.flatMap((keyframe) => Object.keys(keyframe.settings));
  const keys = new Set([...cameraKeys, ...held, ...changed]);
  return [...keys].filter((key) => canMove(key, settings[key]));
}

// As people read it: "component.0.color.min" -> "gas color min".
export function nameOfKey(key, components) {
  const parts = key.split('.');
  if (parts[0] !== 'component') return parts.slice(1).join(' ').replaceAll('_', ' ') || key;
  return [components[parts[1]]?.name ?? parts[1], ...parts.slice(2)].join(' ').replaceAll('_', ' ');
}
