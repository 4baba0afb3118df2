// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Makes elements of the page in one expression: element('dt', {className: 'soft'}, 'u'). Text is
// never interpreted as markup.

function fill(made, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined) continue;
    if (name.startsWith('on')) made.addEventListener(name.slice(2), value);
    else made.setAttribute(name === 'className' ? 'class' : name, value);
  }
  made.append(...children);
  return made;
}

export const element = (name, attributes = {}, ...children) =>
    fill(document.createElement(name), attributes, children);

export const svgElement = (name, attributes = {}, ...children) =>
    fill(document.createElementNS('http://www.w3.org/2000/svg', name), attributes, children);

export const byId = (id) => document.getElementById(id);

// Makes a button for each of [[value, label, title]], which calls choose(value); the button of
// state[key] is pressed.
export function choice(group, entries, state, key, choose) {
  const buttons = entries.map(([value, label, title]) => element('button', {
    'type': 'button', 'title': title, 'data-value': value, 'onclick': () => choose(value),
  }, label));
  group.replaceChildren(...buttons);
  state.watch([key], () => {
    for (const button of buttons)
      button.setAttribute('aria-pressed', button.dataset.value === state[key]);
  });
}
