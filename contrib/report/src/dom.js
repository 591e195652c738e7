// Elements and numbers. Texts of users only ever become text nodes.
export function h(tag, attributes = {}, ...children) {
  const e = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes))
    if (key.startsWith('on')) e.addEventListener(key.slice(2), value);
    else if (value === true) e.setAttribute(key, '');
    else if (value !== false && value !== null && value !== undefined) e.setAttribute(key, value);
  e.append(...children.flat(9).filter(c => c !== null && c !== undefined && c !== false));
  return e;
}

// As people write numbers: five digits, powers of ten for what is very large or small.
export function format(value, digits = 5) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  if (typeof value !== 'number') return String(value);
  if (value === 0) return '0';
  if (Number.isInteger(value) && Math.abs(value) < 1e15) return value.toLocaleString('en').replace(/,/g, '\u202f');
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    return `${Number(mantissa)}e${Number(exponent)}`;
  }
  return String(Number(value.toPrecision(digits)));
}

// A number of summary.json: where it stands there, and all its digits when the pointer is on it.
export function number(source, path, digits) {
  const value = path.split('.').reduce((o, key) => (o === null || o === undefined ? undefined : o[key]), source);
  const text = Array.isArray(value) ? `(${value.map(v => format(v, digits)).join(', ')})` : format(value, digits);
  return h('span', {class: 'number', 'data-key': path, 'data-value': JSON.stringify(value), title: value === undefined ? null : JSON.stringify(value)}, text);
}

export function table(head, rows, attributes = {}) {
  return h('div', {class: 'wide'}, h('table', attributes,
    h('thead', {}, h('tr', {}, head.map(cell => h('th', {scope: 'col'}, cell)))),
    h('tbody', {}, rows.map(row => h('tr', {}, row.map((cell, i) => h(i === 0 ? 'th' : 'td', i === 0 ? {scope: 'row'} : {}, cell)))))));
}

export function section(id, title, ...content) {
  return h('section', {id}, h('h2', {}, title), ...content);
}

export function select(label, options, value, change) {
  const e = h('select', {onchange: () => change(e.value)}, options.map(([v, text]) => h('option', {value: v, selected: v === value}, text)));
  return h('label', {}, label, ' ', e);
}
