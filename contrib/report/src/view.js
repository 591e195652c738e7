// Surfaces that can be turned: three.js with a shader of our own, which colours values, not vertices.
import {
  BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, LineBasicMaterial, LineSegments, LinearFilter, Mesh,
  OrthographicCamera, Raycaster, RGBAFormat, Scene as World, ShaderMaterial, Vector2, Vector3, WebGLRenderer,
} from 'three';
import {OrbitControls} from 'three/examples/jsm/controls/OrbitControls.js';
import {interpolateViridis} from 'd3-scale-chromatic';
import {rgb} from 'd3-color';
import {h, format} from './dom.js';

const most_edges = 200000;

export function colours() {
  const data = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) {
    const {r, g, b} = rgb(interpolateViridis(i / 255));
    data.set([r, g, b, 255], 4 * i);
  }
  const texture = new DataTexture(data, 256, 1, RGBAFormat);
  texture.magFilter = texture.minFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

const vertexShader = `
  attribute vec2 value;
  varying vec2 v_value;
  varying vec3 v_place;
  void main() {
    v_value = value;
    vec4 place = modelViewMatrix * vec4(position, 1.0);
    v_place = place.xyz;
    gl_Position = projectionMatrix * place;
  }`;

// Facets are shown as they are: their normals come from the picture.
const fragmentShader = `
  uniform sampler2D map;
  uniform vec2 limits;
  uniform vec3 plain;
  uniform bool is_open;
  varying vec2 v_value;
  varying vec3 v_place;
  void main() {
    // One looks through faces from behind, into bores: a dot is left here and there.
    if (is_open && !gl_FrontFacing && (mod(gl_FragCoord.x, 5.0) > 1.0 || mod(gl_FragCoord.y, 5.0) > 1.0)) discard;
    vec3 normal = normalize(cross(dFdx(v_place), dFdy(v_place)));
    float light = 0.62 + 0.38 * abs(dot(normal, normalize(vec3(-0.35, 0.45, 0.82))));
    float t = clamp((v_value.x - limits.x) / max(limits.y - limits.x, 1e-30), 0.0, 1.0);
    vec3 colour = v_value.y > 0.001 ? plain : texture2D(map, vec2(t * 255.0 / 256.0 + 0.5 / 256.0, 0.5)).rgb;
    gl_FragColor = vec4(colour * light, 1.0);
  }`;

// Edges of faces: those of triangles but for diagonals of quadrilaterals.
function edgesOf(triangles, kinds) {
  const n = triangles.length / 3, seen = new Set(), ends = [];
  for (let i = 0; i < n; ++i) {
    const isHalf = (i >= kinds[0] && i < kinds[0] + kinds[1]) || i >= kinds[0] + kinds[1] + kinds[2];
    for (let k = 0; k < (isHalf ? 2 : 3); ++k) {
      const a = triangles[3 * i + k], b = triangles[3 * i + ((k + 1) % 3)];
      const key = Math.min(a, b) * 4294967296 + Math.max(a, b);
      if (!seen.has(key)) {
        seen.add(key);
        ends.push(a, b);
      }
    }
  }
  return new Uint32Array(ends);
}

export class View {
  // Throws where there is no WebGL.
  // isOpen: surfaces without thickness, seen from their front.
  constructor(place, scene, surfaces, {onPick, isOpen = false} = {}) {
    this.place = place;
    this.scene = scene;
    this.onPick = onPick;
    this.renderer = new WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.setClearColor(new Color('#ffffff'));
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.world = new World();
    this.camera = new OrthographicCamera();
    this.uniforms = {map: {value: colours()}, limits: {value: new Vector2(0, 1)}, plain: {value: new Color(0.72, 0.73, 0.75)}, is_open: {value: isOpen}};
    this.material = new ShaderMaterial({vertexShader, fragmentShader, uniforms: this.uniforms, side: DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1});
    this.lineMaterial = new LineBasicMaterial({color: 0x1d2733, transparent: true, opacity: 0.35});
    this.scale = 1;
    this.state = scene.states.length - 1;
    this.surfaces = surfaces.map(surface => this.drawn(surface));
    this.axes = h('span', {class: 'axes', 'aria-hidden': 'true'});
    this.ruler = h('span', {class: 'ruler', 'aria-hidden': 'true'}, h('i'), h('b'));
    place.append(this.canvas, this.axes, this.ruler);
    this.listen();
    this.update();
  }

  drawn(surface) {
    const points = this.scene.points(surface);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(points), 3));
    geometry.setAttribute('value', new BufferAttribute(new Float32Array((2 * points.length) / 3), 2));
    geometry.setIndex(new BufferAttribute(this.scene.triangles(surface), 1));
    const mesh = new Mesh(geometry, this.material);
    mesh.frustumCulled = false;
    this.world.add(mesh);
    return {surface, geometry, mesh, edges: null, isShown: true, isWithoutContact: false};
  }

  listen() {
    new ResizeObserver(() => this.resize()).observe(this.place);
    let down = null;
    this.canvas.addEventListener('pointerdown', e => (down = [e.clientX, e.clientY]));
    this.canvas.addEventListener('pointerup', e => {
      if (down && Math.hypot(e.clientX - down[0], e.clientY - down[1]) < 4) this.pick(e);
      down = null;
    });
    this.canvas.addEventListener('keydown', e => this.key(e));
  }

  // Arrows turn, + and - come nearer.
  key(e) {
    const turn = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1]}[e.key];
    if (turn) {
      const offset = this.camera.position.clone().sub(this.controls.target);
      const side = new Vector3().crossVectors(this.camera.up, offset).normalize();
      const turned = offset.clone().applyAxisAngle(this.camera.up.clone().normalize(), turn[0]).applyAxisAngle(side, turn[1]);
      if (turned.clone().normalize().cross(this.camera.up).length() > 0.02) this.camera.position.copy(this.controls.target).add(turned);
    } else if (e.key === '+' || e.key === '-') {
      this.camera.zoom *= e.key === '+' ? 1.15 : 1 / 1.15;
      this.camera.updateProjectionMatrix();
    } else return;
    e.preventDefault();
    this.controls.update();
    this.draw();
  }

  // Looks at a point along a direction; what lies within a radius fills the picture.
  look(target, direction, radius) {
    const d = new Vector3(...direction).normalize();
    const up = Math.abs(d.z) < 0.9 ? new Vector3(0, 0, 1) : new Vector3(0, 1, 0);
    this.radius = radius;
    const reach = 20 * Math.max(radius, this.size || radius);
    this.camera.up.copy(up);
    this.camera.position.set(...target).addScaledVector(d, reach / 2);
    this.camera.near = 0;
    this.camera.far = reach;
    this.camera.zoom = 1;
    if (this.controls) this.controls.dispose();
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.target.set(...target);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', () => this.draw());
    this.resize();
  }

  lookAtAll(direction = [1, -1.6, 0.9]) {
    const {centre, radius} = this.box();
    this.size = radius;
    this.look(centre, direction, radius);
  }

  box() {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const {geometry, isShown} of this.surfaces) {
      if (!isShown) continue;
      const p = geometry.getAttribute('position').array;
      for (let i = 0; i < p.length; ++i) {
        low[i % 3] = Math.min(low[i % 3], p[i]);
        high[i % 3] = Math.max(high[i % 3], p[i]);
      }
    }
    if (!(low[0] <= high[0])) return {centre: [0, 0, 0], radius: 1};
    return {centre: low.map((l, c) => (l + high[c]) / 2), radius: Math.hypot(...low.map((l, c) => high[c] - l)) / 2 || 1};
  }

  resize() {
    const {clientWidth: width, clientHeight: height} = this.place;
    if (!width || !height || !this.radius) return;
    this.renderer.setSize(width, height, false);
    const half = this.radius * 1.05, aspect = width / height;
    const [x, y] = aspect > 1 ? [half * aspect, half] : [half, half / aspect];
    Object.assign(this.camera, {left: -x, right: x, top: y, bottom: -y});
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  // What is coloured: name of a field, ends of the scale.
  setField(name, limits) {
    this.field = name;
    this.setLimits(limits);
    this.update();
  }

  setLimits(limits) {
    this.uniforms.limits.value.set(...limits);
    this.draw();
  }

  // Places and values of the present state.
  update() {
    for (const drawn of this.surfaces) {
      const {surface, geometry} = drawn;
      const points = this.scene.points(surface), u = this.scene.field(this.state, surface, 'displacement');
      const position = geometry.getAttribute('position'), value = geometry.getAttribute('value');
      for (let i = 0; i < points.length; ++i) {
        const shift = u ? this.scale * u[i] : 0;
        position.array[i] = points[i] + (Number.isFinite(shift) ? shift : 0);
      }
      const values = this.field ? this.scene.field(this.state, surface, this.field) : null;
      for (let i = 0; i < value.count; ++i) {
        const v = values ? values[i] : NaN;
        value.array[2 * i] = Number.isFinite(v) ? v : 0;
        value.array[2 * i + 1] = Number.isFinite(v) ? 0 : 1;
      }
      position.needsUpdate = value.needsUpdate = true;
      geometry.boundingSphere = geometry.boundingBox = null;
    }
    this.draw();
  }

  show(isShown) {
    for (const drawn of this.surfaces) {
      drawn.isShown = drawn.mesh.visible = isShown(drawn.surface);
      if (drawn.edges) drawn.edges.visible = drawn.isShown && this.hasEdges;
    }
    this.draw();
  }

  // Bodies leave out their contact faces where the surfaces of pairs are drawn in their places.
  leaveOutContact(isWanted) {
    for (const {surface, geometry} of this.surfaces)
      if (surface.kind === 'body') geometry.setDrawRange(0, isWanted ? 3 * (surface.kinds[0] + surface.kinds[1]) : Infinity);
  }

  canHaveEdges() {
    return this.surfaces.reduce((n, {surface}) => n + surface.triangles, 0) <= most_edges;
  }

  setEdges(isWanted) {
    this.hasEdges = isWanted;
    for (const drawn of this.surfaces) {
      if (isWanted && !drawn.edges) {
        const lines = new BufferGeometry();
        lines.setAttribute('position', drawn.geometry.getAttribute('position'));
        lines.setIndex(new BufferAttribute(edgesOf(this.scene.triangles(drawn.surface), drawn.surface.kinds), 1));
        drawn.edges = new LineSegments(lines, this.lineMaterial);
        drawn.edges.frustumCulled = false;
        this.world.add(drawn.edges);
      }
      if (drawn.edges) drawn.edges.visible = isWanted && drawn.isShown;
    }
    this.draw();
  }

  pick(e) {
    const box = this.canvas.getBoundingClientRect();
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2((2 * (e.clientX - box.left)) / box.width - 1, 1 - (2 * (e.clientY - box.top)) / box.height), this.camera);
    const shown = this.surfaces.filter(drawn => drawn.isShown);
    const hits = ray.intersectObjects(shown.map(drawn => drawn.mesh));
    const isFront = hit => hit.face.normal.dot(ray.ray.direction) < 0;
    const hit = (this.uniforms.is_open.value && hits.find(isFront)) || hits[0];
    if (!hit || !this.onPick) return this.onPick && this.onPick(null);
    const {surface} = shown.find(drawn => drawn.mesh === hit.object);
    const corners = [hit.face.a, hit.face.b, hit.face.c];
    const p = hit.object.geometry.getAttribute('position').array;
    const nearest = corners.reduce((best, v) => {
      const d = Math.hypot(p[3 * v] - hit.point.x, p[3 * v + 1] - hit.point.y, p[3 * v + 2] - hit.point.z);
      return d < best.d ? {d, v} : best;
    }, {d: Infinity, v: 0}).v;
    const points = this.scene.points(surface), values = this.field ? this.scene.field(this.state, surface, this.field) : null;
    this.onPick({surface, point: [...points.subarray(3 * nearest, 3 * nearest + 3)], value: values ? values[nearest] : NaN});
  }

  draw() {
    if (!this.controls || this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => {
      this.isWaiting = false;
      this.renderer.render(this.world, this.camera);
      this.drawAxes();
      this.drawRuler();
    });
  }

  drawAxes() {
    const m = this.camera.matrixWorldInverse.elements;
    const axes = ['x', 'y', 'z'].map((name, c) => ({name, x: 20 * m[4 * c], y: -20 * m[4 * c + 1], z: m[4 * c + 2]})).sort((a, b) => a.z - b.z);
    const colour = {x: '#b3261e', y: '#2e7d32', z: '#1f5fa8'};
    this.axes.innerHTML = `<svg viewBox="-32 -32 64 64">${axes.map(({name, x, y}) => `<path d="M0,0L${x},${y}" stroke="${colour[name]}"/><text x="${1.35 * x}" y="${1.35 * y + 4}" fill="${colour[name]}">${name}</text>`).join('')}</svg>`;
  }

  // A length of 1, 2 or 5 times a power of ten, about a fifth of the picture.
  drawRuler() {
    const width = (this.camera.right - this.camera.left) / this.camera.zoom, wanted = width / 5;
    const ten = 10 ** Math.floor(Math.log10(wanted)), length = [5, 2, 1].find(f => f * ten <= wanted) * ten;
    this.ruler.firstChild.style.width = `${(100 * length) / width}%`;
    this.ruler.lastChild.textContent = `${format(length)} ${this.lengthUnit || ''}`;
  }
}
