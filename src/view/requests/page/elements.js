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

// `options`: words, or pairs of a value and what is shown for it.
export function select(name, options, onchange) {
  const made = element('select', {'aria-label': name});
  fillSelect(made, options);
  made.onchange = () => onchange(made.value);
  return made;
}

export function fillSelect(made, options) {
  made.replaceChildren(...options.map((option) => {
    const [value, shown] = Array.isArray(option) ? option : [option, option];
    return element('option', {value}, shown);
  }));
}

export function checkbox(word, name, onchange) {
  const box = element('input', {type: 'checkbox', 'aria-label': name});
  box.onchange = () => onchange(box.checked);
  return {box, label: element('label', {}, box, word)};
}

export function textInput(name, onchange) {
  const made = element('input', {type: 'text', 'aria-label': name, spellcheck: false});
  made.onchange = () => {
    showProblem(made, '');
    onchange(made.value.trim());
  };
  return made;
}

let problems = 0;

// Says beside a field what is wrong with it; nothing: that all is well.
export function showProblem(field, text) {
  field.problem?.remove();
  field.problem = null;
  field.removeAttribute('aria-invalid');
  field.removeAttribute('aria-describedby');
  if (text === '') return;
  field.problem = element('p', {className: 'problem', id: `problem-${++problems}`, role: 'alert'}, text);
  field.setAttribute('aria-invalid', 'true');
  field.setAttribute('aria-describedby', field.problem.id);
  (field.closest('.row') ?? field.parentElement).append(field.problem);
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

// A part of a group that few need: closed at first.
export function more(name, ...children) {
  return element('details', {className: 'more'}, element('summary', {}, name), ...children);
}
