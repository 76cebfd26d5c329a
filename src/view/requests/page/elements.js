// Elements of forms, each with a name that a screen reader says.
export function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.startsWith('aria-') || name === 'role') {
      made.setAttribute(name, value);
    } else {
      made[name] = value;
    }
  }
  made.append(...children);
  return made;
}

// A word beside its control; `name` is what a screen reader says instead.
export function row(word, ...controls) {
  return element('div', {className: 'row'}, element('span', {'aria-hidden': true}, word), ...controls);
}

export function wide(control) {
  control.classList.add('wide');
  return control;
}

export function button(word, name, onclick) {
  return element('button', {type: 'button', onclick, 'aria-label': name}, word);
}

export function select(name, options, onchange) {
  const made = element('select', {'aria-label': name});
  made.append(...options.map((option) => element('option', {value: option}, option)));
  made.onchange = () => onchange(made.value);
  return made;
}

// Calls `onchange` with finite numbers only; others are marked.
export function numberInput(name, onchange, limits = {}) {
  const made = element('input', {type: 'number', step: 'any', 'aria-label': name, ...limits});
  made.onchange = () => {
    if (made.value !== '' && made.validity.valid) onchange(Number(made.value));
  };
  return made;
}

export function checkbox(word, name, onchange) {
  const box = element('input', {type: 'checkbox', 'aria-label': name});
  box.onchange = () => onchange(box.checked);
  return {box, label: element('label', {}, box, word)};
}

// With a heading that folds it away.
export function group(name, ...children) {
  const heading = element('button', {type: 'button', className: 'fold', 'aria-expanded': 'true'}, name);
  const made = element('fieldset', {}, element('legend', {}, heading), ...children);
  heading.onclick = () => {
    const isFolded = made.classList.toggle('folded');
    heading.setAttribute('aria-expanded', String(!isFolded));
  };
  return made;
}
