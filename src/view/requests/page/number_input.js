// Fields of numbers: typed, with exponents as anybody writes them; changed by a step with the arrow
// keys; and dragged to the left and right, in proportion where only positive numbers make sense.
import {element, showProblem} from './elements.js';
import {readable} from './scaling.js';

const pixelsBeforeDrag = 4;
const perPixel = 1.01;        // of positive numbers
const stepsPerPixel = 0.25;   // of others

// `limits`: min, max, step; isWhole: no fractions. `onchange` gets the number and whether more will
// follow at once; it is never called with what is no number or beyond the limits.
export function numberInput(name, onchange, limits = {}) {
  const made = element('input', {type: 'text', inputMode: 'decimal', autocomplete: 'off', className: 'number',
                                 'aria-label': name, title: 'Type, drag or use the arrow keys'});
  const set = (value, isMoving) => {
    const wanted = limits.isWhole ? Math.round(value) : Number(value.toPrecision(6));
    if (problemOf(wanted, limits) !== '') return;
    made.value = readable(wanted);
    showProblem(made, '');
    onchange(wanted, isMoving);
  };
  made.onchange = () => {
    const text = made.value.trim().replace(',', '.');
    if (text === '') return showProblem(made, '');
    const value = Number(text);
    const problem = problemOf(value, limits);
    showProblem(made, problem && `found ${text}, ${problem}`);
    if (problem === '') onchange(value, false);
  };
  made.addEventListener('keydown', (event) => {
    const way = {ArrowUp: 1, ArrowDown: -1}[event.key];
    if (!way || made.value === '') return;
    event.preventDefault();
    set(moved(Number(made.value), way * (event.shiftKey ? 40 : 4), limits), false);
  });
  listenToDrags(made, limits, set);
  return made;
}

function problemOf(value, {min = -Infinity, max = Infinity, isWhole = false}) {
  const kind = isWhole ? 'a whole number' : 'a number';
  if (!Number.isFinite(value) || (isWhole && !Number.isInteger(value))) return `expected ${kind}`;
  if (value >= min && value <= max) return '';
  if (max === Infinity) return `expected ${kind} of at least ${min}`;
  return `expected ${kind} from ${min} to ${max}`;
}

function moved(start, pixels, {min = -Infinity, max = Infinity, step}) {
  const isProportional = min >= 0 && step === undefined && start > 0;
  const value = isProportional ? start * perPixel ** pixels : start + pixels * stepsPerPixel * (step ?? 0.1);
  return Math.min(max, Math.max(min, value));
}

// A click still puts the cursor into the field.
function listenToDrags(field, limits, set) {
  let drag = null;
  field.addEventListener('pointerdown', (event) => {
    if (event.button !== 0 || document.activeElement === field || field.value === '') return;
    drag = {x: event.clientX, start: Number(field.value), isOn: false};
    field.setPointerCapture(event.pointerId);
  });
  field.addEventListener('pointermove', (event) => {
    if (drag === null) return;
    const pixels = event.clientX - drag.x;
    if (!drag.isOn && Math.abs(pixels) < pixelsBeforeDrag) return;
    drag.isOn = true;
    field.blur();
    set(moved(drag.start, pixels, limits), true);
  });
  const end = () => {
    if (drag?.isOn) set(Number(field.value), false);
    drag = null;
  };
  field.addEventListener('pointerup', end);
  field.addEventListener('pointercancel', end);
}
