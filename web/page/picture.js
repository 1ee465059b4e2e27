// The actuator drawn to scale on a canvas: ribbons, liquid coloured by the field, load, and a lens at the zip front.
import {shade, theme} from './theme.js';

const steel = 7850; // kg/m3, of the weight that is drawn
const margin = {top: 8e-3, side: 6e-3, string: 5e-3, bottom: 4e-3}; // m around the actuator
const magnification = 25; // of the lens
const thinnest = 1.6; // px of a metal strip that would be thinner, not in the lens

/** Colours by the field in the liquid at each station, and the places of faces on the screen. */
class Half {
  constructor(scene, side, to) {
    const {shape, nodes, centre} = scene;
    this.nodes = nodes;
    this.x = (i, r) => to.x(side * (shape.x[2 * i + r] - centre));
    this.y = (i, r, outward) => to.y(shape.y[2 * i + r] + (r === 0 ? outward : -outward));
    this.field = (i) => shade((scene.field[i] + scene.field[Math.min(i + 1, nodes - 1)]) / (2 * scene.largest));
  }
}

/** A band along ribbon r between two distances from its face, m. */
function band(context, half, r, from, to) {
  context.beginPath();
  for (let i = 0; i < half.nodes; i++) context.lineTo(half.x(i, r), half.y(i, r, from));
  for (let i = half.nodes - 1; i >= 0; i--) context.lineTo(half.x(i, r), half.y(i, r, to));
  context.closePath();
  context.fill();
}

/** What is between the ribbons, as far as `outward` of their faces. */
function liquid(context, half, outward) {
  for (let i = 0; i + 1 < half.nodes; i++) {
    const step = Math.sign(half.x(i + 1, 0) - half.x(i, 0)) * (i + 2 < half.nodes ? 0.6 : 0); // no seams
    context.fillStyle = half.field(i);
    context.beginPath();
    context.moveTo(half.x(i, 0), half.y(i, 0, outward));
    context.lineTo(half.x(i + 1, 0) + step, half.y(i + 1, 0, outward));
    context.lineTo(half.x(i + 1, 1) + step, half.y(i + 1, 1, outward));
    context.lineTo(half.x(i, 1), half.y(i, 1, outward));
    context.fill();
  }
}

export class Picture {
  #canvas;
  #context;
  #view = null; // width and depth shown, m; follows the actuator softly

  constructor(canvas) {
    this.#canvas = canvas;
    this.#context = canvas.getContext('2d');
  }

  /** scene: shape, nodes, centre (x of the middle, m), field [nodes] and largest (V/m), front (station), platform (m),
   * metal, insulator (m, thickness), mass (kg), hanging (opening without voltage, m; NaN: unknown), texts. */
  draw(scene, still) {
    const context = this.#context, ratio = Math.min(devicePixelRatio, 2);
    const {clientWidth: width, clientHeight: height} = this.#canvas;
    if (this.#canvas.width !== Math.round(width * ratio)) this.#canvas.width = Math.round(width * ratio);
    if (this.#canvas.height !== Math.round(height * ratio)) this.#canvas.height = Math.round(height * ratio);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    const to = this.#fit(scene, width, height, still);
    this.#support(to);
    this.#hanging(scene, to);
    this.#ribbons(scene, to);
    this.#load(scene, to);
    this.#opening(scene, to);
    this.#scaleBar(to, width, height);
    this.#lens(scene, to, width, height);
  }

  /** The whole actuator, its load and some air, in one scale for both directions. */
  #fit(scene, width, height, still) {
    const opening = Math.max(scene.opening, 1.1 * (scene.hanging || 0));
    const wanted = {
      width: 2 * (scene.centre + margin.side),
      depth: opening + margin.string + Math.cbrt(scene.mass / steel) + margin.bottom,
    };
    const soft = this.#view && !still ? 0.12 : 1;
    this.#view ??= wanted;
    for (const key of ['width', 'depth']) this.#view[key] += soft * (wanted[key] - this.#view[key]);
    const scale = Math.min(width / this.#view.width, height / (this.#view.depth + margin.top));
    const top = margin.top * scale + Math.max(0, 0.35 * (height - (this.#view.depth + margin.top) * scale));
    return {scale, x: (x) => width / 2 + scale * x, y: (y) => top - scale * y};
  }

  #support(to) {
    const context = this.#context, y = to.y(4.5e-3), half = 9e-3 * to.scale, x = to.x(0);
    context.strokeStyle = theme.colour.soft;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(x - half, y);
    context.lineTo(x + half, y);
    for (let k = -4; k <= 4; k++) {
      context.moveTo(x + (k * half) / 4.5, y);
      context.lineTo(x + (k * half) / 4.5 + 6, y - 6);
    }
    context.moveTo(x, y);
    context.lineTo(x, to.y(0));
    context.stroke();
  }

  #hanging(scene, to) {
    if (!(scene.hanging > 0)) return;
    const context = this.#context, y = to.y(-scene.hanging), half = scene.centre * 0.42;
    context.strokeStyle = context.fillStyle = theme.colour.soft;
    context.lineWidth = 1;
    context.setLineDash([4, 5]);
    context.beginPath();
    context.moveTo(to.x(-half), y);
    context.lineTo(to.x(half), y);
    context.stroke();
    context.setLineDash([]);
    if (scene.opening > 0.75 * scene.hanging) return;
    context.font = '12px system-ui, sans-serif';
    context.textAlign = 'left';
    context.textBaseline = 'bottom';
    context.fillText('hangs here without voltage', to.x(-half), y - 3);
  }

  #ribbons(scene, to) {
    const context = this.#context, thickness = Math.max(scene.metal * to.scale, thinnest) / to.scale;
    for (const side of [1, -1]) {
      const half = new Half(scene, side, to);
      liquid(context, half, scene.insulator);
    }
    this.#betweenPlatforms(scene, to);
    context.fillStyle = theme.colour.metal;
    for (const side of [1, -1]) {
      const half = new Half(scene, side, to);
      for (const r of [0, 1]) band(context, half, r, scene.insulator, scene.insulator + thickness);
      this.#clip(scene, half, to, side);
    }
    this.#platforms(scene, to, thickness);
  }

  #betweenPlatforms(scene, to) {
    const last = scene.nodes - 1, y = scene.shape.y, context = this.#context;
    context.fillStyle = shade(scene.electrode ? scene.field[last] / scene.largest : 0);
    const top = to.y(y[2 * last] + scene.insulator), bottom = to.y(y[2 * last + 1] - scene.insulator);
    context.fillRect(to.x(-scene.platform / 2) - 0.5, top, scene.platform * to.scale + 1, bottom - top);
  }

  #platforms(scene, to, thickness) {
    const last = scene.nodes - 1, y = scene.shape.y, context = this.#context;
    const height = Math.max(4, thickness * to.scale * 1.5), x = to.x(-scene.platform / 2), width = scene.platform * to.scale;
    context.fillRect(x, to.y(y[2 * last] + scene.insulator) - height, width, height);
    context.fillRect(x, to.y(y[2 * last + 1] - scene.insulator), width, height);
  }

  /** Where the ribbons are joined, beyond the first station. */
  #clip(scene, half, to, side) {
    const context = this.#context, length = 3.5e-3 * to.scale, height = Math.max(10, 2.2e-3 * to.scale);
    const x = half.x(0, 0) + (side > 0 ? -length : 0), y = (half.y(0, 0, 0) + half.y(0, 1, 0)) / 2;
    context.save();
    context.fillStyle = theme.colour.load;
    context.beginPath();
    context.roundRect(x, y - height / 2, length, height, 3);
    context.fill();
    context.restore();
  }

  #load(scene, to) {
    if (!(scene.mass > 0)) return;
    const context = this.#context, side = Math.cbrt(scene.mass / steel) * to.scale;
    const top = to.y(-scene.opening), y = to.y(-scene.opening - margin.string), x = to.x(0);
    context.strokeStyle = theme.colour.load;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(x, top);
    context.lineTo(x, y);
    context.stroke();
    context.fillStyle = theme.colour.load;
    context.beginPath();
    context.roundRect(x - side / 2, y, side, side, Math.min(4, side / 5));
    context.fill();
    const inside = side > 44;
    context.font = '600 13px system-ui, sans-serif';
    context.textBaseline = 'middle';
    context.textAlign = inside ? 'center' : 'left';
    context.fillStyle = inside ? theme.colour.panel : theme.colour.ink;
    context.fillText(scene.texts.mass, inside ? x : x + side / 2 + 7, y + side / 2);
  }

  /** How far the platforms are apart, beside them. */
  #opening(scene, to) {
    const context = this.#context, x = to.x(scene.platform / 2 + 3e-3), top = to.y(0), bottom = to.y(-scene.opening);
    if (bottom - top < 26) return;
    context.strokeStyle = context.fillStyle = theme.colour.ink;
    context.lineWidth = 1;
    context.beginPath();
    for (const [y, way] of [[top, 1], [bottom, -1]]) {
      context.moveTo(x - 4, y + 6 * way);
      context.lineTo(x, y + 1.5 * way);
      context.lineTo(x + 4, y + 6 * way);
    }
    context.moveTo(x, top + 2);
    context.lineTo(x, bottom - 2);
    context.stroke();
    context.font = '600 13px system-ui, sans-serif';
    context.textAlign = 'left';
    context.textBaseline = 'middle';
    const y = (top + bottom) / 2, width = context.measureText(scene.texts.opening).width;
    context.fillStyle = theme.colour.panel;
    context.globalAlpha = 0.75;
    context.beginPath();
    context.roundRect(x + 5, y - 10, width + 8, 20, 5);
    context.fill();
    context.globalAlpha = 1;
    context.fillStyle = theme.colour.ink;
    context.fillText(scene.texts.opening, x + 9, y);
  }

  #scaleBar(to, width, height) {
    const context = this.#context, length = 10e-3 * to.scale, right = width - 18, y = height - 14;
    context.strokeStyle = context.fillStyle = theme.colour.soft;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(right - length, y - 4);
    context.lineTo(right - length, y);
    context.lineTo(right, y);
    context.lineTo(right, y - 4);
    context.stroke();
    context.font = '12px system-ui, sans-serif';
    context.textAlign = 'center';
    context.textBaseline = 'bottom';
    context.fillText('10 mm', right - length / 2, y - 4);
  }

  /** The zip front of the left half, magnified: metal, insulator, liquid, insulator, metal, all to scale. */
  #lens(scene, to, width, height) {
    const context = this.#context, radius = Math.min(84, height * 0.19, width * 0.15);
    const at = {x: radius + 16, y: height - radius - 34};
    const {shape, front} = scene, scale = to.scale * magnification;
    const focus = {x: shape.x[2 * front] - scene.centre, y: (shape.y[2 * front] + shape.y[2 * front + 1]) / 2};
    const inside = {x: (x) => at.x + scale * (x - focus.x), y: (y) => at.y - scale * (y - focus.y)};
    const from = {x: to.x(focus.x), y: to.y(focus.y)};
    this.#beam(from, at, radius);
    context.save();
    context.beginPath();
    context.arc(at.x, at.y, radius, 0, 2 * Math.PI);
    context.fillStyle = theme.colour.panel;
    context.fill();
    context.clip();
    const half = new Half(scene, 1, inside);
    liquid(context, half, 0);
    for (const r of [0, 1]) {
      context.fillStyle = theme.colour.insulator;
      band(context, half, r, 0, scene.insulator);
      context.fillStyle = theme.colour.metal;
      band(context, half, r, scene.insulator, scene.insulator + scene.metal);
    }
    context.restore();
    context.strokeStyle = theme.colour.accent;
    context.lineWidth = 2;
    context.beginPath();
    context.arc(at.x, at.y, radius, 0, 2 * Math.PI);
    context.stroke();
    context.fillStyle = theme.colour.soft;
    context.font = '12px system-ui, sans-serif';
    context.textAlign = 'left';
    context.textBaseline = 'alphabetic';
    context.fillText(`zip front, ${magnification} times larger`, at.x - radius, height - 12);
  }

  /** A ring at the front, joined to the lens. */
  #beam(from, at, radius) {
    const context = this.#context, ring = 6, angle = Math.atan2(at.y - from.y, at.x - from.x);
    context.strokeStyle = theme.colour.accent;
    context.lineWidth = 1.5;
    context.beginPath();
    context.arc(from.x, from.y, ring, 0, 2 * Math.PI);
    context.moveTo(from.x + ring * Math.cos(angle), from.y + ring * Math.sin(angle));
    context.lineTo(at.x - radius * Math.cos(angle), at.y - radius * Math.sin(angle));
    context.stroke();
  }
}
