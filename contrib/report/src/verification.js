// Results of `signorini verify --json`: problems with errors over refinement, observed orders and verdicts.
import {format, h, section, table} from './dom.js';
import {chart} from './charts.js';

const words = passes => h('span', {class: passes ? 'good' : 'warning'}, passes ? 'passes' : 'FAILS');

// What is exact but for rounding has none.
const hasOrder = q => Number.isFinite(q.least_order);

export function verificationPage(main, v) {
  const {problems} = v;
  main.replaceChildren(
    h('header', {}, h('h1', {}, 'Verification'), h('p', {}, `${v.version}, ${v.ranks} ${v.ranks === 1 ? 'rank' : 'ranks'}${v.quick ? ', on the first meshes only' : ''}`)),
    section('verdict', 'Verdict', h('div', {class: `verdict ${v.passes ? 'good' : 'bad'}`}, h('strong', {}, v.passes ? `All ${v.passed} problems pass` : `${v.failed} of ${problems.length} problems fail`)),
      table(['problem', '', 'what', 'seconds'], problems.map((p, i) => [h('a', {href: `#problem-${i}`}, p.name), words(p.passes), p.what, format(p.seconds, 3)]))),
    ...problems.map((p, i) => problem(p, i)));
}

// Of each quantity: errors by mesh, order from the mesh before, and bars.
function problem(p, index) {
  const errors = (q, k) => [format(q.errors[k], 3), Number.isFinite(q.most[k]) && h('span', {class: 'note'}, ` at most ${format(q.most[k], 3)}`), k > 0 && hasOrder(q) && h('div', {class: 'note'}, `order ${format(q.orders[k - 1], 3)}`)];
  const lines = p.quantities.filter(q => hasOrder(q) && q.errors.filter(e => e > 0).length > 1).map(q => ({name: q.name, points: q.errors.map((e, k) => [2 ** -k, e])}));
  return section(`problem-${index}`, p.name, h('p', {}, p.what, p.reference && h('span', {class: 'note'}, ` Reference: ${p.reference}.`)),
    p.failures.length > 0 && h('ul', {class: 'notes'}, p.failures.map(text => h('li', {class: 'warning'}, text))),
    p.meshes.length > 0 && table(['', ...p.meshes.map(m => m.what), 'least order', ''], [
      ...['unknowns', 'iterations'].filter(key => p.meshes.some(m => m[key] > 0)).map(key => [key, ...p.meshes.map(m => format(m[key])), '', '']),
      ...p.quantities.map(q => [h('span', {title: q.what}, q.name), ...p.meshes.map((_, k) => errors(q, k)), format(q.least_order), words(q.passes)]),
    ]),
    lines.length > 0 && h('div', {class: 'charts'}, chart({lines, x: 'width of the cells, relative to the first mesh', y: lines.length > 1 ? 'error' : `error: ${lines[0].name}`, logX: true, logY: true,
      xTicks: p.meshes.map((_, k) => [2 ** -k, k ? `1/${2 ** k}` : '1'])})));
}
