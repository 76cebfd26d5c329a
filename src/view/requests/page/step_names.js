// What a step of undo is called: by what two states do not have in common.
import {nameOfKey} from './film_keys.js';

const differ = (a, b) => JSON.stringify(a) !== JSON.stringify(b);

export function changeName(a, b, components) {
  if (differ(a.added, b.added)) return 'components';
  if (differ(a.hidden, b.hidden)) return 'what is shown';
  if (differ(a.keyframes, b.keyframes)) return 'keyframes';
  const keys = Object.keys({...a.settings, ...b.settings}).filter((key) => differ(a.settings[key], b.settings[key]));
  if (keys.length > 0 && keys.every((key) => key.startsWith('camera.'))) return 'camera';
  const names = [...new Set(keys.map((key) => nameOfKey(key, components)))];
  return names.length > 2 ? `${names.length} settings` : names.join(', ');
}
