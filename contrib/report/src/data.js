// What the program has written into the page.
export const element = id => document.getElementById(id);

export function json(id) {
  const e = element(id);
  return e ? JSON.parse(e.textContent) : null;
}

const types = {float32: Float32Array, uint32: Uint32Array, uint16: Uint16Array};

// The numbers of an element, or null if there is none.
export function array(id) {
  const e = element(id);
  if (!e) return null;
  const text = atob(e.textContent.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return new types[e.dataset.type](bytes.buffer);
}

// Rounded numbers between the ends of a range; NaN for none.
function roundedArray(id, [low, high]) {
  const numbers = array(id);
  const values = new Float32Array(numbers.length);
  for (let i = 0; i < values.length; ++i) values[i] = numbers[i] === 65535 ? NaN : low + (numbers[i] / 65534) * (high - low);
  return values;
}

// Surfaces of bodies and pairs with the fields of the states (load steps) that are drawn.
export class Scene {
  constructor() {
    const scene = json('scene');
    this.states = [...document.querySelectorAll('script[id^="state-"]')]
      .filter(e => /^state-\d+$/.test(e.id))
      .map(e => ({id: e.id, ...JSON.parse(e.textContent)}));
    const surface = kind => (meta, index) => ({...meta, kind, index, id: `${kind}-${index}`});
    this.bodies = scene ? scene.bodies.map(surface('body')) : [];
    this.sides = scene ? scene.sides.map(surface('side')) : [];
    this.cache = new Map();
  }

  isEmpty() {
    return this.states.length === 0 || this.bodies.length === 0;
  }

  points(surface) {
    return this.cached(`${surface.id}-points`, id => array(id));
  }

  triangles(surface) {
    return this.cached(`${surface.id}-triangles`, id => array(id));
  }

  ranges(state, surface) {
    return this.states[state][surface.kind === 'body' ? 'bodies' : 'sides'][surface.index] || {};
  }

  // Three numbers a vertex for the displacement, else one; null if the surface has no such field.
  field(state, surface, name) {
    if (name === 'displacement length') return this.cached(`${state}-${surface.id}-length`, () => this.lengths(state, surface));
    const range = this.ranges(state, surface)[name];
    if (!range) return null;
    return this.cached(`${this.states[state].id}-${surface.id}-${name}`, id => roundedArray(id, range));
  }

  lengths(state, surface) {
    const u = this.field(state, surface, 'displacement');
    const values = new Float32Array(u.length / 3);
    for (let i = 0; i < values.length; ++i) values[i] = Math.hypot(u[3 * i], u[3 * i + 1], u[3 * i + 2]);
    return values;
  }

  // Over all states.
  range(surfaces, name) {
    let low = Infinity, high = -Infinity;
    for (let state = 0; state < this.states.length; ++state)
      for (const surface of surfaces) {
        let range = this.ranges(state, surface)[name];
        if (name === 'displacement length') range = this.cached(`${state}-${surface.id}-range`, () => extent(this.lengths(state, surface)));
        if (range) {
          low = Math.min(low, range[0]);
          high = Math.max(high, range[1]);
        }
      }
    return low <= high ? [low, high] : [0, 0];
  }

  cached(key, make) {
    if (!this.cache.has(key)) this.cache.set(key, make(key));
    return this.cache.get(key);
  }
}

export function extent(values) {
  let low = Infinity, high = -Infinity;
  for (const v of values)
    if (Number.isFinite(v)) {
      if (v < low) low = v;
      if (v > high) high = v;
    }
  return low <= high ? [low, high] : [0, 0];
}

export function csv(text) {
  const [head, ...rows] = text.trim().split('\n').map(line => line.split(','));
  return {head, rows: rows.map(row => row.map(Number))};
}
