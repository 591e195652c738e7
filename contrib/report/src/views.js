// The two pictures of a run, bodies and contact surfaces, with what steers them, and the pressure over a line.
import {View} from './view.js';
import {extent} from './data.js';
import {h, format, section, select} from './dom.js';
import {chart} from './charts.js';

const names = {pressure: 'contact pressure', recovered_pressure: 'contact pressure, smoothed', gap: 'gap', von_Mises: 'von Mises stress', 'displacement length': 'displacement'};
const contactFields = ['pressure', 'recovered_pressure', 'gap'];

function unitOf(name, units) {
  return name === 'gap' || name === 'displacement length' ? units.length : units.stress;
}

// Undeformed, as computed, and exaggerated up to a third of the bodies' size.
function deformations(scene) {
  const largest = Math.max(...scene.range(scene.bodies, 'displacement length'));
  let size = 0;
  for (const body of scene.bodies) {
    const points = scene.points(body);
    for (let c = 0; c < 3; ++c) {
      const [low, high] = extent(points.filter((_, i) => i % 3 === c));
      size = Math.max(size, high - low);
    }
  }
  const most = largest > 0 ? (size / largest) / 3 : 1, steps = [0, 1];
  for (let ten = 1; steps[steps.length - 1] < most && ten < 1e12; ten *= 10)
    for (const f of [2, 5, 10]) if (f * ten <= most) steps.push(f * ten);
      else { ten = 1e12; break; }
  return steps;
}

// The ends of the scale of a field.
function limitsOf(scene, surfaces, name, pairs) {
  const [low, high] = scene.range(surfaces, name);
  if (name === 'gap') {
    // Where surfaces bend away from each other gaps are of no interest.
    const approach = Math.max(0, ...pairs.map(pair => pair.approach || 0));
    return [0, approach > 0 ? Math.min(high, 4 * approach) || high : high];
  }
  // What contact presses on the other side with falls below zero at the border of the zone, by mortar matrices with negative entries; ties pull.
  const pulls = pairs.some(pair => pair.min_pressure < -1e-6 * pair.max_pressure);
  if (/pressure/.test(name) && !pulls) return [0, high];
  return [Math.min(low, 0), high];
}

// Field, scale, deformation, load step and a picture.
class Panel {
  constructor({id, scene, surfaces, fields, units, store, pairs}) {
    Object.assign(this, {scene, surfaces, units, store, pairs});
    this.picture = h('div', {class: 'picture', id: `${id}-picture`});
    this.legend = h('div', {class: 'legend'});
    this.answer = h('p', {class: 'answer', 'aria-live': 'polite'}, 'Drag to turn, wheel to come nearer, right button to move, click for a value; arrow keys, + and − on the picture.');
    this.options = h('div', {class: 'options'});
    this.element = h('div', {class: 'panel', id}, this.options, h('div', {class: 'stage'}, this.picture, this.legend), this.answer);
    this.fields = fields.filter(name => surfaces.some(surface => name === 'displacement length' || scene.states.some((_, k) => scene.ranges(k, surface)[name])));
  }

  // Once the element is in the document.
  start(view) {
    this.view = view;
    view.lengthUnit = this.units.length;
    view.onPick = hit => this.tell(hit);
    this.options.append(select('Colour', this.fields.map(name => [name, names[name]]), this.fields[0], name => this.choose(name)));
    const {steps} = this.store;
    const text = h('output', {});
    const slider = h('input', {type: 'range', min: 0, max: steps.length - 1, value: 1, class: 'deformation', 'aria-label': 'deformation'});
    slider.addEventListener('input', () => this.store.setScale(steps[slider.value]));
    this.store.onScale(scale => {
      slider.value = steps.indexOf(scale);
      text.textContent = scale === 0 ? 'undeformed' : scale === 1 ? 'deformed' : `${format(scale)} times`;
      view.scale = scale;
      view.update();
    });
    this.options.append(h('label', {}, 'Deformation ', slider, ' ', text));
    if (this.scene.states.length > 1) this.addStates(view);
    const edges = h('input', {type: 'checkbox', disabled: !view.canHaveEdges(), onchange: () => view.setEdges(edges.checked)});
    this.options.append(h('label', {title: view.canHaveEdges() ? null : 'too many faces'}, edges, ' mesh'));
    this.choose(this.fields[0]);
  }

  addStates(view) {
    const last = this.scene.states.length - 1, text = h('output', {});
    const slider = h('input', {type: 'range', min: 0, max: last, value: last, class: 'state', 'aria-label': 'load step'});
    slider.addEventListener('input', () => this.store.setState(Number(slider.value)));
    this.store.onState(state => {
      slider.value = state;
      text.textContent = `t = ${format(this.scene.states[state].time)}`;
      view.state = state;
      view.update();
    });
    this.options.append(h('label', {}, 'Load step ', slider, ' ', text));
  }

  choose(name) {
    this.field = name;
    this.limits = limitsOf(this.scene, this.surfaces, name, this.pairs);
    this.view.leaveOutContact(contactFields.includes(name));
    this.view.setField(name, this.limits);
    if (this.onField) this.onField();
    this.drawLegend();
  }

  drawLegend() {
    const end = i => {
      const e = h('input', {type: 'text', inputmode: 'decimal', value: format(this.limits[i]), 'aria-label': i ? 'largest value of the scale' : 'smallest value of the scale'});
      e.addEventListener('change', () => {
        const value = Number(e.value.replace(',', '.'));
        if (Number.isFinite(value)) {
          this.limits = i ? [this.limits[0], value] : [value, this.limits[1]];
          this.view.setLimits(this.limits);
        }
        this.drawLegend();
      });
      return e;
    };
    const [low, high] = this.limits, unit = unitOf(this.field, this.units);
    const middle = [0.75, 0.5, 0.25].map(f => h('span', {}, format(low + f * (high - low), 4)));
    this.legend.replaceChildren(h('b', {}, names[this.field], unit && h('br'), unit && `[${unit}]`),
      h('div', {class: 'bar'}, h('i'), h('div', {}, end(1), middle, end(0))),
      h('button', {type: 'button', onclick: () => this.choose(this.field)}, 'reset'));
  }

  tell(hit) {
    if (!hit) return;
    const unit = unitOf(this.field, this.units), at = `(${hit.point.map(x => format(x)).join(', ')})`;
    const value = Number.isFinite(hit.value) ? `${names[this.field]} ${format(hit.value)} ${unit}` : `no ${names[this.field]} here`;
    this.answer.textContent = `${hit.surface.name}: ${value} at ${at} ${this.units.length} before deformation`;
  }
}

// What both pictures share.
class Store {
  constructor(scene) {
    this.steps = deformations(scene);
    this.scaleListeners = [];
    this.stateListeners = [];
    this.scale = 1;
    this.state = scene.states.length - 1;
  }

  setScale(scale) {
    this.scale = scale;
    this.scaleListeners.forEach(f => f(scale));
  }

  onScale(f) {
    this.scaleListeners.push(f);
    f(this.scale);
  }

  setState(state) {
    this.state = state;
    this.stateListeners.forEach(f => f(state));
  }

  onState(f) {
    this.stateListeners.push(f);
    f(this.state);
  }
}

function startView(panel, scene, surfaces, options) {
  try {
    // three.js would tell the console.
    if (!document.createElement('canvas').getContext('webgl2')) throw new Error('it does not make a context');
    const view = new View(panel.picture, scene, surfaces, options);
    panel.start(view);
    return view;
  } catch (error) {
    panel.element.replaceChildren(h('p', {class: 'note without-webgl'}, `There is no turnable picture, as the browser has no WebGL (${error.message}). All numbers are below; bodies.pvd and the other files open in ParaView.`));
    return null;
  }
}

function thinned(surfaces) {
  const fine = surfaces.filter(s => s.triangles < s.triangles_before);
  return fine.length > 0 && h('p', {class: 'note'}, 'Drawn with fewer triangles than computed with, vertices merged where the mesh is finest: ',
    fine.map(s => `${s.name} ${format(s.triangles)} of ${format(s.triangles_before)}`).join(', '), '. All of them are in the files for ParaView.');
}

export function bodiesSection(scene, context) {
  const surfaces = [...scene.bodies, ...scene.sides];
  const panel = new Panel({id: 'bodies-panel', scene, surfaces, fields: ['von_Mises', 'displacement length', ...contactFields], ...context});
  const boxes = scene.bodies.map((body, b) => h('input', {type: 'checkbox', checked: true, 'data-body': b, onchange: () => show()}));
  const isContact = () => contactFields.includes(panel.field);
  const show = () => panel.view.show(surface => boxes[surface.kind === 'body' ? surface.index : surface.body].checked && (surface.kind === 'body' || isContact()));
  panel.onField = show;
  const start = () => {
    if (!startView(panel, scene, surfaces)) return;
    panel.options.append(h('span', {class: 'bodies'}, scene.bodies.map((body, b) => h('label', {}, boxes[b], ' ', body.name))));
    const looks = [['oblique', [1, -1.6, 0.9]], ['along x', [1, 0, 0]], ['along y', [0, -1, 0]], ['along z', [0, 0, 1]]];
    panel.options.append(h('span', {class: 'looks'}, looks.map(([name, d]) => h('button', {type: 'button', onclick: () => panel.view.lookAtAll(d)}, name))));
    panel.view.lookAtAll();
  };
  return {element: section('bodies', 'Bodies', panel.element, thinned(scene.bodies)), start};
}

const minus = (a, b) => a.map((x, c) => x - b[c]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => {
  const n = Math.hypot(...a);
  return n > 0 ? a.map(x => x / n) : a;
};
const finite = v => Array.isArray(v) && v.every(Number.isFinite);

// Where and how a surface is in contact: weighted by pressure and area.
function zone(scene, state, side) {
  const points = scene.points(side), triangles = scene.triangles(side), p = scene.field(state, side, 'pressure');
  const at = v => [points[3 * v], points[3 * v + 1], points[3 * v + 2]];
  const sums = useAll => {
    let weight = 0, normal = [0, 0, 0], centre = [0, 0, 0];
    for (let i = 0; i < triangles.length; i += 3) {
      const [a, b, c] = [at(triangles[i]), at(triangles[i + 1]), at(triangles[i + 2])];
      const n = cross(minus(b, a), minus(c, a));
      const mean = useAll || !p ? 1 : (Math.max(p[triangles[i]], 0) + Math.max(p[triangles[i + 1]], 0) + Math.max(p[triangles[i + 2]], 0)) / 3;
      const w = Number.isFinite(mean) ? mean * Math.hypot(...n) : 0;
      weight += w;
      normal = normal.map((x, k) => x + (Number.isFinite(mean) ? mean : 0) * n[k]);
      centre = centre.map((x, k) => x + (w * (a[k] + b[k] + c[k])) / 3);
    }
    return {weight, normal: normal.map(x => x / weight), centre: centre.map(x => x / weight)};
  };
  let {weight, normal, centre} = sums(false);
  const isActive = weight > 0;
  if (!isActive) ({normal, centre} = sums(true));
  const highest = p ? extent(p)[1] : 0;
  let radius = 0, moments = [[0, 0, 0], [0, 0, 0], [0, 0, 0]];
  for (let v = 0; v < points.length / 3; ++v)
    if (!isActive || p[v] > 0.01 * highest) {
      const d = minus(at(v), centre);
      radius = Math.max(radius, Math.hypot(...d));
      const w = isActive ? p[v] : 1;
      for (let r = 0; r < 3; ++r) for (let c = 0; c < 3; ++c) moments[r][c] += w * d[r] * d[c];
    }
  return {centre, normal, radius, isActive, moments};
}

// Largest first, by powers of the matrix; the second one across the first and the normal.
function principal(moments, normal) {
  let d = [0.61, 0.53, 0.59];
  for (let k = 0; k < 300; ++k) {
    const next = moments.map(row => dot(row, d));
    if (!(Math.hypot(...next) > 0)) break;
    d = unit(next);
  }
  const largest = d.reduce((best, x, c) => (Math.abs(x) > Math.abs(d[best]) ? c : best), 0);
  if (d[largest] < 0) d = d.map(x => -x);
  let across = cross(normal, d);
  if (!(Math.hypot(...across) > 1e-6)) across = cross(Math.abs(d[2]) < 0.9 ? [0, 0, 1] : [0, 1, 0], d);
  return [d, unit(across)];
}

// Pieces of the surface's cut with the plane through a point along a direction and the normal of the zone.
function cut(scene, side, values, point, direction, across, radius) {
  const points = scene.points(side), triangles = scene.triangles(side), pieces = [];
  const at = v => [points[3 * v], points[3 * v + 1], points[3 * v + 2]];
  const height = v => {
    const x = dot(minus(at(v), point), across);
    return x === 0 ? 1e-12 * radius : x;
  };
  for (let i = 0; i < triangles.length; i += 3) {
    const corners = [triangles[i], triangles[i + 1], triangles[i + 2]], z = corners.map(height), ends = [];
    for (let k = 0; k < 3; ++k) {
      const a = k, b = (k + 1) % 3;
      if (z[a] * z[b] >= 0) continue;
      const f = z[a] / (z[a] - z[b]), pa = at(corners[a]), pb = at(corners[b]);
      ends.push([dot(minus(pa.map((x, c) => x + f * (pb[c] - x)), point), direction), values[corners[a]] + f * (values[corners[b]] - values[corners[a]])]);
    }
    if (ends.length === 2 && ends.every(e => Number.isFinite(e[1]) && Math.abs(e[0]) < 1.6 * radius)) pieces.push(...ends);
  }
  return pieces;
}

function profiles(scene, side, pair, units) {
  const place = h('div', {class: 'charts'}), choices = h('div', {class: 'options'});
  const largest = finite(pair.max_pressure_at) ? pair.max_pressure_at : null, centre = finite(pair.centre_of_pressure) ? pair.centre_of_pressure : null;
  let state = scene.states.length - 1, through = null, along = null;
  const u = text => (text ? ` [${text}]` : '');
  const draw = () => {
    const {centre: middle, normal, radius, isActive, moments} = zone(scene, state, side);
    const values = scene.field(state, side, 'pressure'), smooth = scene.field(state, side, 'recovered_pressure');
    if (!isActive || !values) {
      place.replaceChildren(h('p', {class: 'note'}, 'There is no contact pressure in this state.'));
      return;
    }
    const [d, across] = principal(moments, normal);
    const points = {largest: largest || middle, centre: centre || middle};
    if (through === null) {
      // In half and quarter models the pressure is largest on the border, away from the centre of pressure.
      const isOff = largest && centre && Math.hypot(...minus(largest, centre)) > 0.3 * radius;
      through = isOff || (largest && !centre) ? 'largest' : 'centre';
      // The axes of such a zone may only touch it there.
      along = isOff ? 'inward' : 'principal';
      choices.querySelectorAll('select').forEach((box, i) => (box.value = [through, along][i]));
    }
    const point = points[through], inward = minus(middle, point), inNormal = dot(inward, normal) / (dot(normal, normal) || 1);
    const tangent = inward.map((x, c) => x - inNormal * normal[c]);
    const directions = {principal: [d, across], across: [across, d]};
    const hasInward = Math.hypot(...tangent) > 1e-6 * radius;
    directions.inward = hasInward ? [unit(tangent), unit(cross(Math.hypot(...normal) > 0.3 ? normal : across, tangent))] : directions.principal;
    const [direction, normalOfCut] = directions[along];
    const lines = [{name: 'pressure', points: cut(scene, side, values, point, direction, normalOfCut, radius), pieces: true, colour: '#21918c'}];
    if (smooth) lines.push({name: 'smoothed', points: cut(scene, side, smooth, point, direction, normalOfCut, radius), pieces: true, dash: true, colour: '#440154'});
    const xyz = scene.points(side), n = xyz.length / 3, step = Math.ceil(n / 20000), dots = [];
    for (let v = 0; v < n; v += step) {
      const r = Math.hypot(xyz[3 * v] - point[0], xyz[3 * v + 1] - point[1], xyz[3 * v + 2] - point[2]);
      if (Number.isFinite(values[v]) && r < 1.3 * (radius + Math.hypot(...minus(point, middle)))) dots.push([r, values[v]]);
    }
    place.replaceChildren(
      h('div', {}, h('h4', {}, `Along (${direction.map(x => format(Math.abs(x) < 1e-3 ? 0 : x, 3)).join(', ')}) through (${point.map(x => format(x, 4)).join(', ')})`),
        chart({lines, x: `distance along the line${u(units.length)}`, y: `contact pressure${u(units.stress)}`, fromZero: true})),
      h('div', {}, h('h4', {}, 'Over the distance from this point'),
        chart({lines: [{points: dots, dots: true, colour: '#31688e'}], x: `distance${u(units.length)}`, y: `contact pressure${u(units.stress)}`, fromZero: true})));
  };
  choices.append(
    select('Line through', [['centre', 'the centre of pressure'], ['largest', 'the largest pressure']], 'centre', value => {
      through = value;
      draw();
    }),
    select('along', [['principal', 'the longest axis of the contact zone'], ['across', 'the axis across it'], ['inward', 'the way to the middle of the zone']], 'principal', value => {
      along = value;
      draw();
    }));
  draw();
  return {element: h('div', {class: 'profiles'}, h('h3', {}, 'Pressure over a line'), choices, place), setState: k => {
    state = k;
    draw();
  }};
}

export function contactSection(scene, context) {
  const {sides} = scene, {pairs, units, store} = context;
  const panel = new Panel({id: 'contact-panel', scene, surfaces: sides, fields: pairs.some(pair => pair.scatter_is_told) ? ['recovered_pressure', 'pressure', 'gap'] : contactFields, ...context});
  const profile = h('div', {});
  let chosen = 0, curve = null;
  const look = isWhole => {
    const {centre, normal, radius} = zone(scene, store.state, sides[chosen]), n = Math.hypot(...normal);
    // A surface that closes around something has no side to be looked at from.
    if (isWhole || !(n > 0.3)) panel.view.lookAtAll(n > 0.3 ? normal : undefined);
    else panel.view.look(centre, normal, 1.25 * radius);
  };
  const choose = s => {
    chosen = Number(s);
    if (panel.view) {
      panel.view.show(surface => surface.index === chosen);
      // Pressures on the other sides may be larger.
      panel.surfaces = [sides[chosen]];
      panel.choose(panel.field);
      panel.view.lookAtAll();
      look(false);
    }
    curve = profiles(scene, sides[chosen], pairs[sides[chosen].pair] || {}, units);
    profile.replaceChildren(curve.element);
  };
  const start = () => {
    panel.options.append(select('Surface', sides.map((s, i) => [String(i), `${(pairs[s.pair] || {}).name}: ${s.name}`]), '0', choose));
    if (startView(panel, scene, sides, {isOpen: true}))
      panel.options.append(h('span', {class: 'looks'}, h('button', {type: 'button', onclick: () => look(false)}, 'contact zone'), h('button', {type: 'button', onclick: () => look(true)}, 'whole surface')));
    choose(0);
    if (scene.states.length > 1) store.onState(k => curve.setState(k));
  };
  return {element: section('contact', 'Contact pressure', panel.element, thinned(sides), profile), start};
}

export {Store};
