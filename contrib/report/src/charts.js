// Lines and dots over axes, as SVG.
import {scaleLinear, scaleLog} from 'd3-scale';
import {interpolateViridis} from 'd3-scale-chromatic';
import {h, format} from './dom.js';

const size = {width: 520, height: 300, left: 66, right: 14, top: 12, bottom: 44};

function svg(tag, attributes = {}, ...children) {
  const e = document.createElementNS('http://www.w3.org/2000/svg', tag);
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
  e.append(...children);
  return e;
}

export function lineColour(i, n) {
  return n === 1 ? '#2b5c8a' : interpolateViridis(0.05 + (0.8 * i) / (n - 1));
}

function padded([low, high]) {
  if (!(low <= high)) return [0, 1];
  const pad = high > low ? 0.04 * (high - low) : Math.abs(high) || 1;
  return [low < 0 || low > 0.3 * high ? low - pad : low, high + pad];
}

function range(points, c, isLog) {
  let low = Infinity, high = -Infinity;
  for (const line of points)
    for (const p of line)
      if (Number.isFinite(p[c]) && (!isLog || p[c] > 0)) {
        low = Math.min(low, p[c]);
        high = Math.max(high, p[c]);
      }
  return [low, high];
}

// An axis with ticks of its own ends where its values do.
function scale(isLog, values, pixels, isRound = true) {
  if (!isLog) return scaleLinear().domain(padded(values)).range(pixels).nice();
  const [low, high] = values[0] <= values[1] ? values : [0.1, 1];
  const axis = scaleLog().domain(low < high ? [low, high] : [low / 2, high * 2]).range(pixels);
  return isRound ? axis.nice() : axis;
}

// Logarithmic axes have a label at powers of ten alone.
function ticks(axis, isLog, n) {
  if (!isLog) return axis.ticks(n);
  const all = axis.ticks().filter(t => Math.abs(Math.log10(t) - Math.round(Math.log10(t))) < 1e-9);
  const step = Math.ceil(all.length / n);
  return all.length > 1 ? all.filter((_, i) => i % step === 0) : axis.ticks(3);
}

// lines: [{name, points: [[x, y]...], pieces (pairs of points that belong together), dots, dash}]; mark: an x to point at; xTicks: [[x, text]...] instead of round numbers; fromZero: y begins there, or below.
export function chart({lines, x, y, logX = false, logY = false, mark = null, label = '', xTicks = null, fromZero = false}) {
  const points = lines.map(line => line.points);
  const {width, height, left, right, top, bottom} = size;
  const sx = scale(logX, range(points, 0, logX), [left, width - right], xTicks === null);
  const [low, high] = range(points, 1, logY), sy = scale(logY, [fromZero ? Math.min(low, 0) : low, high], [height - bottom, top]);
  const good = p => Number.isFinite(p[0]) && Number.isFinite(p[1]) && (!logX || p[0] > 0) && (!logY || p[1] > 0);
  const root = svg('svg', {viewBox: `0 0 ${width} ${height}`, class: 'chart', role: 'img', 'aria-label': label || `${y} over ${x}`});
  for (const [t, text] of xTicks || ticks(sx, logX, 6).map(t => [t, format(t, 4)])) {
    root.append(svg('line', {x1: sx(t), x2: sx(t), y1: top, y2: height - bottom, class: 'grid'}));
    root.append(svg('text', {x: sx(t), y: height - bottom + 16, class: 'tick middle'}, text));
  }
  for (const t of ticks(sy, logY, 6)) {
    root.append(svg('line', {x1: left, x2: width - right, y1: sy(t), y2: sy(t), class: 'grid'}));
    root.append(svg('text', {x: left - 6, y: sy(t) + 4, class: 'tick end'}, format(t, 4)));
  }
  root.append(svg('path', {d: `M${left},${top}V${height - bottom}H${width - right}`, class: 'axis'}));
  root.append(svg('text', {x: (left + width - right) / 2, y: height - 8, class: 'axis-name middle'}, x));
  root.append(svg('text', {x: 14, y: (top + height - bottom) / 2, class: 'axis-name middle', transform: `rotate(-90 14 ${(top + height - bottom) / 2})`}, y));
  lines.forEach((line, i) => {
    const colour = line.colour || lineColour(i, lines.length);
    const xy = p => `${sx(p[0]).toFixed(1)},${sy(p[1]).toFixed(1)}`;
    const shown = line.points.filter(good);
    if (line.dots)
      root.append(svg('path', {d: shown.map(p => `M${xy(p)}h0`).join(''), stroke: colour, class: 'dots'}));
    else {
      const d = line.pieces
        ? shown.map((p, k) => (k % 2 ? 'L' : 'M') + xy(p)).join('')
        : shown.map((p, k) => (k ? 'L' : 'M') + xy(p)).join('');
      root.append(svg('path', {d, stroke: colour, class: 'line', 'stroke-dasharray': line.dash ? '5 4' : 'none'}));
      if (!line.pieces && shown.length < 60)
        for (const p of shown) root.append(svg('circle', {cx: sx(p[0]), cy: sy(p[1]), r: 2.4, fill: colour}));
    }
  });
  if (mark !== null && Number.isFinite(mark))
    root.append(svg('line', {x1: sx(mark), x2: sx(mark), y1: top, y2: height - bottom, class: 'mark'}));
  const names = lines.filter(line => line.name);
  return h('figure', {}, root, names.length > 1 &&
    h('figcaption', {}, names.map(line => h('span', {class: 'key'}, h('i', {style: `background:${line.colour || lineColour(lines.indexOf(line), lines.length)}`}), line.name))));
}
