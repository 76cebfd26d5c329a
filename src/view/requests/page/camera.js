// What moves of the pointer and keys do to a camera {position, look_at, sky, field_of_view}: each
// function returns the keys of the scene that change.
import {add, cross, dot, length, normalize, rotate, scale, subtract} from './vector.js';

const degrees = Math.PI / 180;
// The view may not be parallel to the sky direction.
const leastAngleToSky = 2 * degrees;

export function cameraOf(settings) {
  return {
    position: settings['camera.position'],
    lookAt: settings['camera.look_at'],
    sky: normalize(settings['camera.sky']),
    fieldOfView: (settings['camera.field_of_view'] ?? 90) * degrees,
  };
}

function axesOf(camera) {
  const forward = normalize(subtract(camera.lookAt, camera.position));
  const right = normalize(cross(forward, camera.sky));
  return {forward, right, up: cross(right, forward)};
}

// About the look-at point: to the right and upwards, in radians.
export function orbit(camera, right, up) {
  let offset = subtract(camera.position, camera.lookAt);
  offset = rotate(offset, camera.sky, -right);
  const angle = Math.acos(dot(normalize(offset), camera.sky));
  const wanted = Math.min(Math.PI - leastAngleToSky, Math.max(leastAngleToSky, angle - up));
  const axis = normalize(cross(camera.sky, offset));
  offset = rotate(offset, axis, wanted - angle);
  return {'camera.position': add(camera.lookAt, offset)};
}

// What the picture shows moves by these parts of its width.
export function pan(camera, right, up) {
  const axes = axesOf(camera);
  const distance = length(subtract(camera.lookAt, camera.position));
  const angle = Math.min(camera.fieldOfView, 170 * degrees);
  const width = 2 * distance * Math.tan(angle / 2);
  const move = add(scale(axes.right, -right * width), scale(axes.up, -up * width));
  return moved(camera, move);
}

// The distance to the look-at point is multiplied by `factor`.
export function dolly(camera, factor) {
  const offset = scale(subtract(camera.position, camera.lookAt), factor);
  return {'camera.position': add(camera.lookAt, offset)};
}

// The same, and what lies at a place of the picture, 0 to 1 each way, stays there, as far away as the
// look-at point. `shape` is the picture's height over its width.
export function dollyTowards(camera, factor, place, shape) {
  const nearer = {...camera, position: dolly(camera, factor)['camera.position']};
  const part = (1 - factor) / factor;
  return pan(nearer, (0.5 - place.x) * part, (place.y - 0.5) * shape * part);
}

// The point comes into the middle, without turning the camera.
export function recenter(camera, point) {
  return moved(camera, subtract(point, camera.lookAt));
}

// Along the camera's own axes, in parts of the distance to the look-at point.
export function fly(camera, right, up, forward) {
  const axes = axesOf(camera);
  const distance = length(subtract(camera.lookAt, camera.position));
  const move = add(add(scale(axes.right, right), scale(axes.up, up)), scale(axes.forward, forward));
  return moved(camera, scale(move, distance));
}

// Turns about the camera itself: to the right and upwards, in radians.
export function lookAround(camera, right, up) {
  let view = subtract(camera.lookAt, camera.position);
  view = rotate(view, camera.sky, -right);
  const angle = Math.acos(dot(normalize(view), camera.sky));
  const wanted = Math.min(Math.PI - leastAngleToSky, Math.max(leastAngleToSky, angle - up));
  view = rotate(view, normalize(cross(camera.sky, view)), wanted - angle);
  return {'camera.look_at': add(camera.position, view)};
}

function moved(camera, move) {
  return {
    'camera.position': add(camera.position, move),
    'camera.look_at': add(camera.lookAt, move),
  };
}
