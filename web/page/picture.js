// The actuator drawn to scale on a canvas: ribbons, liquid coloured by the field, load, and a lens at the zip front.
import {shade, theme} from './theme.js';

const steel = 7850; // kg/m3, of the weight that is drawn
const margin = {top: 8e-3, side: 6e-3, string: 5e-3, bottom: 4e-3}; // m around the actuator
const clip = 3.5e-3; // m, length of a clip
const magnification = 25; // of the lens
const thinnest = 1.6; // px of a metal strip that would be thinner, not in the lens

/** Faces of one half on the screen; side 1: the left one. Ribbons continue straight in clip and platform. */
class Half {
  constructor({shape, nodes, centre, platform}, side, to) {
    const last = nodes - 1;
    const stations = [[0, -clip], ...Array.from({length: nodes}, (_, i) => [i, 0]), [last, platform / 2]];
    this.x = [0, 1].map((r) => stations.map(([i, beyond]) => to.x(side * (shape.x[2 * i + r] + beyond - centre))));
    this.y = [0, 1].map((r) => stations.map(([i]) => to.y(shape.y[2 * i + r])));
    this.scale = to.scale;
  }

  /** Path along ribbon r at a distance from its face, m, up to place `end`, a number of points with its fraction; the
   * other way round: backwards. */
  along(context, r, outward, backwards = false, end = this.x[r].length - 1) {
    const shift = (r === 0 ? -outward : outward) * this.scale, whole = Math.floor(end);
    const places = Array.from({length: whole + 1}, (_, i) => i);
    if (whole < end) places.push(end);
    if (backwards) places.reverse();
    for (const at of places) context.lineTo(this.#at(this.x[r], at), this.#at(this.y[r], at) + shift);
  }

  /** Between two points of a list. */
  #at(list, place) {
    const k = Math.floor(place), part = place - k;
    return part ? list[k] + part * (list[k + 1] - list[k]) : list[k];
  }

  /** A layer of ribbon r between two distances from its face. */
  layer(context, r, from, to) {
    context.beginPath();
    this.along(context, r, from);
    this.along(context, r, to, true);
    context.fill();
  }

  /** The liquid between the ribbons, up to `outward` from their faces, coloured by the field; a bead up to its end, with
   * its meniscus. */
  liquid(context, {field, largest, electrode, wetEnd}, outward) {
    const x = this.x[0], span = x.at(-2) - x[1];
    const gradient = context.createLinearGradient(x[1], 0, x.at(-2), 0);
    field.forEach((E, i) => gradient.addColorStop(Math.min(Math.max((x[i + 1] - x[1]) / span, 0), 1), shade(E / largest)));
    if (!electrode) gradient.addColorStop(1, shade(0));
    context.fillStyle = gradient;
    const end = Math.min(wetEnd, x.length - 1);
    context.beginPath();
    this.along(context, 0, outward, false, end);
    this.along(context, 1, outward, true, end);
    context.fill();
    if (end === x.length - 1) return;
    context.strokeStyle = theme.colour.accent;
    context.lineWidth = 1.5;
    context.beginPath();
    for (const r of [0, 1]) context.lineTo(this.#at(this.x[r], end), this.#at(this.y[r], end));
    context.stroke();
  }
}

/** The first place, from the clip on, where the gap equals the thickness of an insulator; the platform if there is none. */
function zipFront({shape: {x, y, gap}, nodes, centre, insulator}) {
  let i = 1;
  while (i < nodes - 1 && gap[i] < insulator) i++;
  const share = Math.min(Math.max((insulator - gap[i - 1]) / (gap[i] - gap[i - 1]), 0), 1) || 0;
  const between = (values, k) => values[2 * i - 2 + k] + share * (values[2 * i + k] - values[2 * i - 2 + k]);
  return {x: between(x, 0) - centre, y: (between(y, 0) + between(y, 1)) / 2};
}

export class Picture {
  #canvas;
  #context;
  #view = null; // width and depth shown, m; follows the actuator softly

  constructor(canvas) {
    this.#canvas = canvas;
    this.#context = canvas.getContext('2d');
  }

  /** scene: shape, nodes, centre (x of the middle, m), field [nodes] and largest (V/m), bath (is there liquid around?),
   * wetEnd (where a bead ends: a number of points of a Half; Infinity: nowhere), platform (m),
   * metal, insulator (m, thickness), mass (kg), hanging (opening without voltage, m; NaN: unknown), texts. */
  draw(scene, still) {
    const context = this.#context, ratio = Math.min(devicePixelRatio, 2);
    const {clientWidth: width, clientHeight: height} = this.#canvas;
    if (this.#canvas.width !== Math.round(width * ratio)) this.#canvas.width = Math.round(width * ratio);
    if (this.#canvas.height !== Math.round(height * ratio)) this.#canvas.height = Math.round(height * ratio);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    if (scene.bath) {
      context.fillStyle = theme.colour.bath;
      context.fillRect(0, 0, width, height);
    }
    const to = this.#fit(scene, width, height, still);
    this.#support(to);
    this.#hanging(scene, to);
    this.#ribbons(scene, to);
    this.#load(scene, to);
    this.#opening(scene, to);
    this.#scaleBar(to, width, height);
    this.#lens(scene, to, width, height);
    this.#where(scene, width);
  }

  /** The surroundings of the ribbons. */
  #where({texts}, width) {
    if (!texts.liquid) return;
    const context = this.#context;
    context.fillStyle = theme.colour.soft;
    context.font = '12px system-ui, sans-serif';
    context.textAlign = 'right';
    context.textBaseline = 'top';
    context.fillText(texts.liquid, width - 12, 10);
  }

  /** The view: the whole actuator, its load and some margin, with the same scale in both directions. */
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
    const context = this.#context, y = to.y(-scene.hanging), half = 0.6 * scene.centre;
    context.strokeStyle = context.fillStyle = theme.colour.soft;
    context.lineWidth = 1;
    context.setLineDash([4, 5]);
    context.beginPath();
    context.moveTo(to.x(-half), y);
    context.lineTo(to.x(half), y);
    context.stroke();
    context.setLineDash([]);
    context.font = '12px system-ui, sans-serif';
    context.textAlign = 'right';
    context.textBaseline = 'bottom';
    const words = 'hangs here without voltage', room = (half - Math.cbrt(scene.mass / steel) / 2) * to.scale;
    if (scene.opening < 0.75 * scene.hanging && context.measureText(words).width < room - 6) context.fillText(words, to.x(half), y - 3);
  }

  #ribbons(scene, to) {
    const context = this.#context, thickness = Math.max(scene.metal, thinnest / to.scale);
    for (const side of [1, -1]) {
      const half = new Half(scene, side, to);
      half.liquid(context, scene, scene.insulator);
      context.fillStyle = theme.colour.metal;
      for (const r of [0, 1]) half.layer(context, r, scene.insulator, scene.insulator + thickness);
      this.#clip(half, to, side);
    }
    this.#platforms(scene, to);
  }

  /** Rigid pieces on the metal where the ribbons are held and the load hangs. */
  #platforms(scene, to) {
    const context = this.#context, y = scene.shape.y, last = scene.nodes - 1;
    const x = to.x(-scene.platform / 2), width = scene.platform * to.scale, height = Math.max(4, 0.6e-3 * to.scale);
    context.fillStyle = theme.colour.metal;
    context.fillRect(x, to.y(y[2 * last] + scene.insulator) - height, width, height);
    context.fillRect(x, to.y(y[2 * last + 1] - scene.insulator), width, height);
  }

  #clip(half, to, side) {
    const context = this.#context, length = clip * to.scale, height = Math.max(9, 2.4e-3 * to.scale);
    context.fillStyle = theme.colour.load;
    context.beginPath();
    context.roundRect(side > 0 ? half.x[0][0] : half.x[0][1], (half.y[0][0] + half.y[1][0] - height) / 2, length, height, 3);
    context.fill();
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

  /** The opening, beside the platforms. */
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
    const context = this.#context, length = 10e-3 * to.scale, right = width - 18, y = height - 40;
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
    const scale = to.scale * magnification, focus = zipFront(scene);
    const inside = {scale, x: (x) => at.x + scale * (x - focus.x), y: (y) => at.y - scale * (y - focus.y)};
    const from = {x: to.x(focus.x), y: to.y(focus.y)};
    this.#beam(from, at, radius);
    context.save();
    context.beginPath();
    context.arc(at.x, at.y, radius, 0, 2 * Math.PI);
    context.fillStyle = scene.bath ? theme.colour.bath : theme.colour.panel;
    context.fill();
    context.clip();
    const half = new Half(scene, 1, inside);
    half.liquid(context, scene, 0);
    for (const r of [0, 1]) {
      context.fillStyle = theme.colour.insulator;
      half.layer(context, r, 0, scene.insulator);
      context.fillStyle = theme.colour.metal;
      half.layer(context, r, scene.insulator, scene.insulator + scene.metal);
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
    this.#layers(scene, at.x + radius + 8, height - 40);
  }

  /** Labels of the layers in the lens, from the lowest line up. */
  #layers({bath, texts}, x, y) {
    const context = this.#context, gap = context.createLinearGradient(x, 0, x + 14, 0);
    [0, 0.25, 1].forEach((share) => gap.addColorStop(Math.sqrt(share), shade(share)));
    const between = bath || texts.liquid ? 'liquid, by field' : 'gap, by field';
    for (const [colour, words] of [[gap, between], [theme.colour.insulator, 'insulator'], [theme.colour.metal, 'metal']]) {
      context.fillStyle = colour;
      context.fillRect(x, y - 9, 14, 9);
      context.fillStyle = theme.colour.soft;
      context.fillText(words, x + 19, y);
      y -= 16;
    }
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
