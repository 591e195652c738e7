// The page of a run: what summary.json says, in the order in which people ask.
import {Scene, csv, json} from './data.js';
import {format, h, number, section, select, table} from './dom.js';
import {chart} from './charts.js';
import {Store, bodiesSection, contactSection} from './views.js';
import {verificationPage} from './verification.js';

const unitText = unit => (unit ? ` ${unit}` : '');
const inUnit = unit => (unit ? ` [${unit}]` : '');

function duration(seconds) {
  return seconds < 120 ? `${format(seconds, 3)} s` : seconds < 7200 ? `${format(seconds / 60, 3)} min` : `${format(seconds / 3600, 3)} h`;
}

function bytes(n) {
  return n < 1e9 ? `${format(n / 1e6, 3)} MB` : `${format(n / 1e9, 3)} GB`;
}

function card(title, value, ...more) {
  return h('div', {class: 'card'}, h('span', {class: 'title'}, title), h('span', {class: 'value'}, value), h('span', {class: 'more'}, ...more));
}

function verdict(s, run) {
  const {certificate: c, converged} = s, holds = c.contact_conditions_hold && converged;
  const lines = [];
  if (!converged) lines.push('The iteration did not converge: the numbers below are those of the last iterate.');
  lines.push(...c.objections);
  const words = !converged ? 'Not converged' : holds ? 'The contact conditions hold' : 'The contact conditions do not hold';
  return section('verdict', 'Verdict', h('div', {class: `verdict ${holds ? 'good' : 'bad'}`, 'data-key': 'certificate.contact_conditions_hold', 'data-value': String(c.contact_conditions_hold)},
    h('strong', {}, words), lines.map(line => h('p', {}, line))), cards(s, run),
  s.notes.length > 0 && h('div', {}, h('h3', {}, 'Notes'), h('ul', {class: 'notes'}, s.notes.map(note => h('li', {class: /^warning/.test(note) ? 'warning' : null}, note)))));
}

function cards(s, {units}) {
  const last = s.cycles.length - 1, cycle = `cycles.${last}`;
  const list = s.pairs.map((pair, p) => pair.contact_area > 0
    ? card(`${pair.name}: ${pair.pressures_cancel ? 'integral of the pressure' : 'contact force'}`, [format(pair.pressures_cancel ? pair.load : Math.hypot(...pair.force)), unitText(units.force)], 'largest pressure ', number(s, `pairs.${p}.max_pressure`), unitText(units.stress), pair.scatter_is_told && [', smoothed ', number(s, `pairs.${p}.max_recovered_pressure`), unitText(units.stress)], ', area ', number(s, `pairs.${p}.contact_area`), units.length && ` ${units.length}²`, pair.is_narrow && '; narrower than a face: the pressure is that of the mesh')
    : card(`${pair.name}: contact force`, '0', pair.missed_penetration > 0 ? ['the surfaces penetrate by ', number(s, `pairs.${p}.missed_penetration`), unitText(units.length)] : 'the surfaces are separated'));
  s.bodies.forEach((body, b) => list.push(card(`${body.name}: largest displacement`, [number(s, `bodies.${b}.largest_displacement`), unitText(units.length)], 'largest von Mises stress ', number(s, `bodies.${b}.largest_von_mises`), unitText(units.stress))));
  list.push(card('Displacements are small', s.displacements_are_small ? 'yes' : 'NO', 'largest rotation ', format((Math.max(0, ...s.bodies.map(b => b.largest_rotation)) * 180) / Math.PI, 2), '°'));
  list.push(card('Meshes are fine', s.meshes_are_fine ? 'yes' : 'NO', 'estimated error of stresses ', format(100 * Math.max(1e-4, ...s.bodies.map(b => b.stress_error)), 2), s.bodies.length > 1 ? ' % or less' : ' %'));
  if (last >= 0)
    list.push(card('Unknowns', number(s, `${cycle}.dofs`), number(s, `${cycle}.nonlinear.iterations`), ' iterations, ', duration(s.wall_time_s), ', ', bytes(s.peak_memory_bytes), ', ', number(s, 'ranks'), s.ranks === 1 ? ' rank' : ' ranks'));
  return h('div', {class: 'cards'}, list);
}

// Lines of `signorini --check`: what belongs to the line above is indented.
function problem(run, s) {
  const {units} = run, u = inUnit(units.stress), lines = run.problem.split('\n').filter(line => line.trim());
  const isBody = line => /^body .*: \d+ cells/.test(line) || /^  boundary /.test(line);
  return section('problem', 'The problem as understood',
    table(['body', `Young's modulus E${u}`, "Poisson's ratio ν", 'boundaries'], run.bodies.map(b => [b.name, b.materials.map(m => format(m.young)).join('; '), b.materials.map(m => format(m.poisson)).join('; '), b.boundaries.join(', ')])),
    s.pairs.length > 0 && table(['contact pair', 'kind', 'with multipliers (nonmortar)', 'partner (mortar)'], s.pairs.map((pair, p) => [pair.name, (run.pairs[p] || {}).is_tied ? 'tied' : 'contact', pair.nonmortar, pair.mortar])),
    h('h3', {}, 'Loads, constraints, pairs'),
    h('ul', {class: 'lines'}, lines.filter(line => !isBody(line)).map(line => h('li', {class: /^  /.test(line) ? 'inner' : null}, line.trim()))),
    h('details', {}, h('summary', {}, 'Boundaries with areas and boxes'), h('ul', {class: 'lines'}, lines.filter(isBody).map(line => h('li', {class: /^  /.test(line) ? 'inner' : null}, line.trim())))));
}

function forces(s, {units}) {
  const f = inUnit(units.force), m = units.force && units.length ? ` [${units.force} ${units.length}]` : '';
  const l = inUnit(units.length), a = units.length ? ` [${units.length}²]` : '', p = inUnit(units.stress);
  const bolts = s.pretension || [], isLocked = bolts.some(b => b.locked_after !== undefined);
  return section('forces', 'Forces',
    h('h3', {}, 'What acts on the bodies'),
    table(['body', `loads${f}`, `reactions${f}`, `contact${f}`, `moment of the loads${m}`], s.bodies.map((b, i) => [b.name, ...['load', 'reaction', 'contact_force', 'load_moment'].map(key => number(s, `bodies.${i}.${key}`))])),
    s.boundaries.length > 0 && table(['held boundary', `reaction${f}`], s.boundaries.map((b, i) => [`${b.body}: ${b.name}`, number(s, `boundaries.${i}.reaction`)])),
    s.pairs.length > 0 && h('h3', {}, 'Contact'),
    s.pairs.length > 0 && table(['', ...s.pairs.map(pair => pair.name)], [
      [`force on the nonmortar side${f}`, 'force'], [`force on the mortar side${f}`, 'force_on_mortar'], [`moment about the origin${m}`, 'moment'], [`integral of the pressure${f}`, 'load'],
      [`centre of pressure${l}`, 'centre_of_pressure'], [`largest pressure${p}`, 'max_pressure'], [`where${l}`, 'max_pressure_at'], [`largest pressure, smoothed${p}`, 'max_recovered_pressure'], ['scatter of nodal pressures', 'pressure_scatter'], [`smallest pressure${p}`, 'min_pressure'], [`contact area${a}`, 'contact_area'],
      [`approach${l}`, 'approach'], [`smallest gap${l}`, 'min_gap'], [`slip${l}`, 'slip'], ['slip in faces', 'slip_in_faces'],
    ].map(([name, key]) => [name, ...s.pairs.map((_, i) => number(s, `pairs.${i}.${key}`))])),
    h('h3', {}, 'Largest values'),
    table(['body', `displacement${l}`, `where${l}`, `von Mises stress${p}`, `where${l}`, 'rotation [rad]', 'strain', 'estimated error of stresses'], s.bodies.map((b, i) => [b.name,
      ...['largest_displacement', 'largest_displacement_at', 'largest_von_mises', 'largest_von_mises_at', 'largest_rotation', 'largest_strain', 'stress_error'].map(key => number(s, `bodies.${i}.${key}`))])),
    bolts.length > 0 && h('h3', {}, 'Bolts'),
    bolts.length > 0 && table(['bolt', `wanted${f}`, `force${f}`, `shortening${l}`, 'strain', ...isLocked ? ['locked after t'] : []], bolts.map((b, i) => [`${b.body}: ${b.name}`, ...['wanted', 'force', 'shortening', 'strain', ...isLocked ? ['locked_after'] : []].map(key => number(s, `pretension.${i}.${key}`))])),
    s.probes.length > 0 && h('h3', {}, 'Probes'),
    s.probes.length > 0 && table(['probe', `at${l}`, `displacement${l}`], s.probes.map((b, i) => [b.name, number(s, `probes.${i}.point`), number(s, `probes.${i}.displacement`)])));
}

function steps(run, scene, store) {
  const {head, rows} = csv(run.curve), place = h('div', {class: 'charts'});
  const columns = head.map((name, i) => [String(i), name]);
  const load = head.findIndex(name => / load$/.test(name));
  let x = 0, y = load >= 0 ? load : 1, time = null;
  const draw = () => {
    const mark = time === null ? null : (rows.find(row => row[0] === time) || [])[x];
    place.replaceChildren(chart({lines: [{points: rows.map(row => [row[x], row[y]])}], x: head[x], y: head[y], mark}));
  };
  const choose = set => value => {
    set(Number(value));
    draw();
  };
  draw();
  store.onState(k => {
    time = scene.states[k] ? scene.states[k].time : null;
    draw();
  });
  return section('steps', 'Load steps', h('div', {class: 'options'},
    select('Draw', columns, String(y), choose(v => (y = v))), select('over', columns, String(x), choose(v => (x = v)))), place,
  scene.states.length < rows.length && h('p', {class: 'note'}, `Pictures are there of ${scene.states.length} of the ${rows.length} steps.`),
  h('details', {}, h('summary', {}, 'All numbers'), table(head, rows.map(row => row.map(v => format(v))), {class: 'curve'})));
}

function convergence(s, run) {
  const {head, rows} = csv(run.convergence), column = name => head.indexOf(name);
  const lines = s.cycles.map(c => ({name: `mesh ${c.cycle}`, points: rows.filter(row => row[column('cycle')] === c.cycle).map(row => [row[column('iteration')], row[column('relative')]])})).filter(line => line.points.length > 0);
  const compared = s.cycles.some(c => c.linear);
  const cell = (i, path) => number(s, `cycles.${i}.${path}`, 3);
  return section('convergence', 'Convergence',
    h('div', {class: 'charts'}, h('div', {}, h('h3', {}, 'Correction of each iteration, relative to the solution (energy norm)'), chart({lines, x: 'iteration', y: 'relative correction', logY: true}))),
    h('h3', {}, compared ? 'Contact beside the linear problem' : 'Meshes and iterations'),
    table(['mesh', 'levels', 'cells', 'unknowns', 'contact nodes', 'active', 'iterations', 'rate', ...(compared ? ['linear multigrid', 'its rate', 'with conjugate gradients'] : []), 'solve [s]'],
      s.cycles.map((c, i) => [String(c.cycle), ...['levels', 'cells', 'dofs', 'contact_nodes', 'active_nodes', 'nonlinear.iterations', 'nonlinear.rate', ...(compared ? ['linear.iterations', 'linear.rate', 'linear_cg.iterations'] : []), 'times_s.solve'].map(key => cell(i, key))])),
    compared && h('p', {class: 'note'}, 'Linear: the same bodies loaded with the computed contact stresses instead of the pairs, solved by the same V-cycles from the same start.'),
    s.cycles.some(c => c.nonlinear.safety_net) && h('p', {class: 'note'}, 'The iteration was slow on some mesh and the safety net went on: see the notes.'));
}

function mapping(s) {
  if (s.mappings.length === 0) return null;
  const m = key => s.mappings.map((_, i) => number(s, `mappings.${i}.${key}`));
  const reasons = [...new Set(s.mappings.flatMap(entry => Object.keys(entry.unmapped || {})))];
  return section('mapping', 'Contact mapping', table(['', ...s.mappings.map(entry => entry.pair)], [
    ['covered part of the nonmortar surface', ...m('coverage_nonmortar')], ['covered part of the mortar surface', ...m('coverage_mortar')], ['area', ...m('area')],
    ['cells of the overlay', ...m('cells')], ['worst tiling defect', ...m('worst_tiling_defect')], ['smallest gap', ...m('min_gap')], ['largest gap', ...m('max_gap')],
    ['largest angle between normals [°]', ...m('largest_angle_degrees')], ['mean angle [°]', ...m('mean_angle_degrees')],
    ...['turned', 'conflicting_edges', 'lost_edges', 'lost_triangles', 'torn_edges'].map(key => [key.replace('_', ' '), ...m(key)]),
    ...reasons.map(reason => [`vertices without image: ${reason}`, ...m(`unmapped.${reason}`)]), ['time [s]', ...m('time_s')],
  ]));
}

function certificate(s, run) {
  const meaning = {
    penetration: 'of the nodes, relative to the largest displacement', geometric_penetration: 'of the true surfaces, relative to the approach', loaded_gap: 'of the true surfaces, mean over the contact forces, relative to the approach', gap_doubt: 'by how much the gap may be wrong, relative to the approach',
    tension: 'relative to the largest pressure', complementarity: 'pressure times opening, relative to the largest pressure times the largest displacement', equilibrium: 'what is left of the nodal forces, relative to their norm', force_balance: 'of the two sides of the pairs, relative to the load',
    moment_balance: 'of the two sides of the pairs', body_force_balance: 'what is left of all forces on a body', body_moment_balance: 'what is left of their moments',
  };
  return section('certificate', 'Certificate', table(['', 'value', 'NO above', ''], Object.keys(meaning).filter(key => key in s.certificate).map(key => {
    const limit = run.limits[key], value = s.certificate[key], isBad = limit !== undefined && value > limit;
    return [key.replace(/_/g, ' '), number(s, `certificate.${key}`, 3), h('span', {class: isBad ? 'warning' : null}, limit === undefined ? '–' : format(limit)), meaning[key]];
  })));
}

function times(s) {
  const phases = [...new Set(s.cycles.flatMap(c => Object.keys(c.times_s)))].filter(key => s.cycles.some(c => c.times_s[key] > 0));
  const total = c => Object.values(c.times_s).reduce((a, b) => a + b, 0);
  const most = Math.max(1e-300, ...phases.map(key => s.cycles.reduce((a, c) => a + c.times_s[key], 0)));
  return section('times', 'Times and memory',
    h('p', {}, 'Wall time ', number(s, 'wall_time_s', 4), ' s on ', number(s, 'ranks'), s.ranks === 1 ? ' rank' : ' ranks', '; largest memory ', bytes(s.peak_memory_bytes), '.'),
    table(['phase [s]', ...s.cycles.map(c => `mesh ${c.cycle}`), 'all', ''], [
      ...phases.map(key => {
        const sum = s.cycles.reduce((a, c) => a + c.times_s[key], 0);
        return [key.replace(/_/g, ' '), ...s.cycles.map((_, i) => number(s, `cycles.${i}.times_s.${key}`, 3)), format(sum, 3), h('i', {class: 'time', style: `width:${(8 * sum) / most}em`})];
      }),
      ['all phases', ...s.cycles.map(c => format(total(c), 3)), format(s.cycles.reduce((a, c) => a + total(c), 0), 3), ''],
    ], {class: 'times'}));
}

function meshes(s) {
  const rows = [['levels', 'levels'], ['cells', 'cells'], ['unknowns', 'dofs'], ['contact nodes', 'contact_nodes'], ['energy', 'energy'], ['potential energy', 'potential_energy'], ['error indicator (energy norm)', 'indicator'], ['estimated error of stresses', 'stress_error'], ['change to the mesh before', 'error_to_last_cycle'],
    ['nodes moved to true shapes', 'boundary_shapes.moved_nodes'], ['nodes not there yet', 'boundary_shapes.nodes_not_yet_there'], ['worst quality of cells', 'boundary_shapes.worst_quality_after']];
  const value = (c, key) => key.split('.').reduce((o, k) => (o ? o[k] : undefined), c);
  const exact = [...new Set(s.cycles.flatMap(c => Object.keys(c.exact || {})))];
  return section('meshes', 'Mesh levels', table(['', ...s.cycles.map(c => `mesh ${c.cycle}`)], [
    ...rows.filter(([, key]) => s.cycles.some(c => value(c, key) !== undefined)).map(([name, key]) => [name, ...s.cycles.map((_, i) => number(s, `cycles.${i}.${key}`))]),
    ...exact.flatMap(body => [['L2 error', 'l2_error'], ['energy error', 'energy_error']].map(([name, key]) => [`${name} of ${body}`, ...s.cycles.map(c => format(((c.exact || {})[body] || {})[key]))])),
  ]));
}

function texts(run) {
  return section('parameters', 'Parameters', h('details', {}, h('summary', {}, 'All parameters of the run, as in parameters.prm'), h('pre', {}, run.parameters)),
    h('details', {}, h('summary', {}, 'All numbers, as in summary.json'), h('pre', {}, document.getElementById('summary').textContent.trim())));
}

function runPage(main, s, run) {
  const scene = new Scene(), store = scene.isEmpty() ? null : new Store(scene);
  const context = {units: run.units, store, pairs: s.pairs};
  const contact = store && scene.sides.length > 0 ? contactSection(scene, context) : null;
  const bodies = store ? bodiesSection(scene, context) : null;
  const sections = [
    verdict(s, run), contact && contact.element, bodies && bodies.element, problem(run, s), forces(s, run), run.curve && store && steps(run, scene, store), convergence(s, run), certificate(s, run),
    mapping(s), meshes(s), times(s), texts(run),
  ].filter(Boolean);
  main.replaceChildren(
    h('header', {}, h('h1', {}, s.title || s.parameter_file || 'A run'), h('p', {}, `${s.parameter_file}, ${s.version}, ${run.time}`),
      h('nav', {}, sections.map(e => h('a', {href: `#${e.id}`}, e.firstChild.textContent)))),
    ...sections);
  if (contact) contact.start();
  if (bodies) bodies.start();
}

const main = document.getElementById('page'), verification = json('verification'), summary = json('summary');
if (verification) verificationPage(main, verification);
else if (summary) runPage(main, summary, json('run'));
else main.replaceChildren(h('p', {}, 'There are no results in this page.'));
document.documentElement.dataset.ready = 'yes';
