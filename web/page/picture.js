// The actuators drawn to scale on a canvas: ribbons, liquid coloured by the field, load, and a lens at a zip front.
import {shade, theme} from './theme.js';

const steel = 7850; // kg/m3, of the weight that is drawn
const margin = {top: 8e-3, side: 2.5e-3, string: 5e-3, bottom: 4e-3}; // m around the actuator
const magnification = 25; // of the lens
const narrow = 500, legendHeight = 40; // px: the legend of the field is below the actuators of a narrow picture
const pullStiffness = 5; // N/m: force of the pointer over its distance from the load
const thinnest = 1.6; // px of a metal strip that would be thinner, not in the lens

/** A half of a member on the screen (geometry.js), `place` m to the right. */
class Half {
  constructor(half, {turned, angle}, to, place = 0) {
    this.half = half;
    this.x = half.x.map((of) => of.map((x) => to.x(x + place)));
    this.y = half.y.map((of) => of.map((y) => to.y(y)));
    this.axis = {x: Math.cos(angle), y: -Math.sin(angle)}; // along the upper platform
    const up = to.scale * (turned ? -1 : 1), across = {x: up * this.axis.y, y: -up * this.axis.x};
    this.outward = [across, {x: -across.x, y: -across.y}]; // px per m outward of ribbon 0 and 1
  }

  /** Path along ribbon r at a distance from its face, m, up to place `end`, a number of points with its fraction; the
   * other way round: backwards. */
  along(context, r, outward, backwards = false, end = this.x[r].length - 1) {
    const shift = {x: outward * this.outward[r].x, y: outward * this.outward[r].y}, whole = Math.floor(end);
    const places = Array.from({length: whole + 1}, (_, i) => i);
    if (whole < end) places.push(end);
    if (backwards) places.reverse();
    for (const at of places) context.lineTo(this.#at(this.x[r], at) + shift.x, this.#at(this.y[r], at) + shift.y);
  }

  /** Between two points of a list. */
  #at(list, place) {
    const k = Math.floor(place), part = place - k;
    return part ? list[k] + part * (list[k + 1] - list[k]) : list[k];
  }

  /** A layer of ribbon r between two distances from its face, up to place `end`. */
  layer(context, r, from, to, end) {
    context.beginPath();
    this.along(context, r, from, false, end);
    this.along(context, r, to, true, end);
    context.fill();
  }

  /** The liquid between the ribbons, up to `outward` from their faces, coloured by the field; a bead up to its end, with
   * its meniscus. */
  liquid(context, {largest}, electrode, outward) {
    const {first, last, field, wetEnd} = this.half, x = this.x[0], y = this.y[0], {axis} = this;
    const along = (i) => (x[i] - x[first]) * axis.x + (y[i] - y[first]) * axis.y, span = along(last);
    if (span === 0) return; // the picture has no room
    const gradient = context.createLinearGradient(x[first], y[first], x[first] + span * axis.x, y[first] + span * axis.y);
    field.forEach((E, i) => gradient.addColorStop(Math.min(Math.max(along(first + i) / span, 0), 1), shade(E / largest)));
    if (!electrode) gradient.addColorStop(1, shade(0));
    context.fillStyle = gradient;
    const end = Math.min(wetEnd, x.length - 1);
    context.beginPath();
    this.along(context, 0, outward[0], false, end);
    this.along(context, 1, outward[1], true, end);
    context.fill();
    if (end === x.length - 1) return;
    context.strokeStyle = theme.colour.accent;
    context.lineWidth = 1.5;
    context.beginPath();
    for (const r of [0, 1]) context.lineTo(this.#at(this.x[r], end), this.#at(this.y[r], end));
    context.stroke();
  }
}

/** The first place of a half, from the clip on, where the gap equals the mean thickness of an insulator; the platform if
 * there is none. */
function zipFront({x, y, gap, first}, insulator) {
  const thick = (insulator[0] + insulator[1]) / 2;
  let i = 1;
  while (i < gap.length - 1 && gap[i] < thick) i++;
  const share = Math.min(Math.max((thick - gap[i - 1]) / (gap[i] - gap[i - 1]), 0), 1) || 0, k = first + i;
  const between = (of) => of[k - 1] + share * (of[k] - of[k - 1]);
  return {x: between(x[0]), y: (between(y[0]) + between(y[1])) / 2};
}

/** Middle of a load and its side, px. */
function middleOf({x, y, mass, hangs}, to) {
  const size = Math.cbrt(mass / steel) * to.scale;
  return {x: to.x(x), y: to.y(y) + (hangs ? margin.string * to.scale + size / 2 : 0), size};
}

/** Middle and radius of the lens, px. */
function lensPlace(width, height) {
  const radius = Math.min(84, height * 0.19, width * 0.15);
  return {at: {x: radius + 16, y: height - radius - 34}, radius};
}

export class Picture {
  #canvas;
  #context;
  #view = null; // what is shown: left, right, top and bottom, m; follows the actuators softly
  #shown = null; // the loads of the last picture, and its scale

  constructor(canvas) {
    this.#canvas = canvas;
    this.#context = canvas.getContext('2d');
  }

  /** scene: geometry (of geometry.js), largest field (V/m), bath (is there liquid around?), opening (m), hanging (opening
   * without voltage, m; NaN: unknown), pull (null, or {body, right, up}, N), texts. */
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
    this.#shown = {loads: scene.geometry.loads, to};
    for (const support of scene.geometry.supports) this.#support(support, to);
    this.#hanging(scene, to);
    const {geometry} = scene, [hanging, sitting] = [true, false].map((hangs) => geometry.loads.filter((load) => load.hangs === hangs));
    this.#bodies(geometry, to);
    for (const load of sitting) this.#load(load, scene, to);
    this.#ribbons(scene, to);
    this.#links(geometry, to);
    for (const load of hanging) this.#load(load, scene, to);
    for (const load of sitting) this.#mass(load, scene, to);
    this.#voltages(scene, to);
    this.#pull(scene, to);
    this.#opening(scene, to);
    this.#scaleBar(to, width, height);
    if (to.lens) this.#lens(scene, to, width, height);
    this.#where(scene, width);
    this.#gravity(scene.geometry, width, height);
  }

  /** What the picture does not show otherwise: the surroundings of the ribbons, members that are not drawn. */
  #where({texts}, width) {
    const context = this.#context;
    context.fillStyle = theme.colour.soft;
    context.font = '12px system-ui, sans-serif';
    context.textAlign = 'right';
    context.textBaseline = 'top';
    texts.where.forEach((words, k) => context.fillText(words, width - 12, 10 + 16 * k));
  }

  /** An arrow, if gravity does not point down. */
  #gravity({gravity}, width, height) {
    if (Math.abs(gravity) < 1e-6) return;
    const context = this.#context, size = 16, x = width - 34, y = height - 92, way = {x: Math.sin(gravity), y: Math.cos(gravity)};
    context.strokeStyle = context.fillStyle = theme.colour.soft;
    context.lineWidth = 1.5;
    const tip = {x: x + size * way.x, y: y + size * way.y};
    context.beginPath();
    context.moveTo(x - size * way.x, y - size * way.y);
    context.lineTo(tip.x, tip.y);
    for (const turn of [2.6, -2.6]) {
      const angle = Math.atan2(way.y, way.x) + turn;
      context.moveTo(tip.x, tip.y);
      context.lineTo(tip.x + 7 * Math.cos(angle), tip.y + 7 * Math.sin(angle));
    }
    context.stroke();
    context.font = '12px system-ui, sans-serif';
    context.textAlign = 'right';
    context.textBaseline = 'middle';
    context.fillText('gravity', x - size - 8, y);
  }

  /** The view: all actuators, loads and some margin, with the same scale in both directions; beside the lens if they are
   * deep. Where there is no room for both, there is no lens. */
  #fit({geometry: {box, loads}, hanging}, width, height, still) {
    const largest = (list) => list.reduce((most, {mass}) => Math.max(most, Math.cbrt(mass / steel)), 0), below = loads.filter(({hangs}) => hangs);
    const deepest = Math.max(-box.bottom, 1.1 * (below.length ? hanging || 0 : 0));
    const under = below.length ? margin.string + largest(below) + margin.bottom : margin.top + largest(loads) / 2;
    const wanted = {left: box.left - margin.side, right: box.right + margin.side, top: box.top + margin.top, bottom: -deepest - under};
    const soft = this.#view && !still ? 0.12 : 1;
    this.#view ??= wanted;
    for (const key of Object.keys(wanted)) this.#view[key] += soft * (wanted[key] - this.#view[key]);
    const free = width < narrow ? height - legendHeight : height, {left, right, top, bottom} = this.#view;
    const wide = right - left, deep = top - bottom, scale = Math.min(width / wide, free / deep);
    const above = top * scale + Math.max(0, 0.35 * (free - deep * scale)); // px of y = 0
    const {at, radius} = lensPlace(width, height), covered = at.x + radius + 8 - (width - wide * scale) / 2;
    const low = above - scale * box.bottom > at.y - radius, spare = (width - wide * scale) / 2;
    const middle = width / 2 + (low ? Math.min(Math.max(covered, 0), spare) : 0) - (scale * (left + right)) / 2;
    return {scale, x: (x) => middle + scale * x, y: (y) => above - scale * y, lens: !low || covered <= spare};
  }

  /** What holds a platform or a joint, from the direction of its angle. */
  #support({x, y, angle, half}, to) {
    const context = this.#context;
    context.save();
    context.translate(to.x(x), to.y(y));
    context.rotate(-angle);
    context.scale(1, -1);
    this.#mount(4.5e-3 * to.scale, half * to.scale);
    context.restore();
  }

  /** A bar with hatches at `height` px above the origin, and what hangs from it. */
  #mount(height, half) {
    const context = this.#context;
    context.strokeStyle = theme.colour.soft;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(-half, height);
    context.lineTo(half, height);
    for (let k = -4; k <= 4; k++) {
      context.moveTo((k * half) / 4.5, height);
      context.lineTo((k * half) / 4.5 + 6, height + 6);
    }
    context.moveTo(0, height);
    context.lineTo(0, 0);
    context.stroke();
  }

  #hanging(scene, to) {
    if (!(scene.hanging > 0)) return;
    const context = this.#context, y = to.y(-scene.hanging), half = 0.6 * scene.geometry.box.right, [{mass}] = scene.geometry.loads;
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
    const words = 'hangs here without voltage', room = (half - Math.cbrt(mass / steel) / 2) * to.scale;
    if (scene.opening < 0.75 * scene.hanging && context.measureText(words).width < room - 6) context.fillText(words, to.x(half), y - 3);
  }

  #ribbons(scene, to) {
    const {geometry} = scene;
    for (const member of geometry.members)
      for (const place of member.places) this.#member(scene, member, to, place);
    if (geometry.joined) this.#bar(geometry, to);
  }

  #member(scene, member, to, place) {
    const context = this.#context, {insulator, metal} = member;
    for (const half of member.halves) {
      const drawn = new Half(half, member, to, place);
      drawn.liquid(context, scene, member.electrode, insulator);
      for (const r of [0, 1]) {
        const thin = thinnest / to.scale;
        context.fillStyle = theme.colour.insulator;
        if (member.along) drawn.layer(context, r, 0, Math.max(insulator[r], thin));
        context.fillStyle = theme.colour.metal;
        if (member.along) drawn.layer(context, r, insulator[r], insulator[r] + 2 * thin, member.electrodes);
        else drawn.layer(context, r, insulator[r], insulator[r] + Math.max(metal[r], thin));
      }
      if (member.platforms.length) this.#clip(drawn, half, to);
    }
    this.#platforms(member, to, place);
  }

  /** Rigid pieces on the metal where the ribbons are held and the load hangs. */
  #platforms({platforms, insulator, turned}, to, place) {
    const context = this.#context, height = Math.max(4, 0.6e-3 * to.scale);
    context.fillStyle = theme.colour.metal;
    for (const [r, [left, right]] of platforms.entries()) {
      const up = (r === 0) === !turned;
      context.save();
      context.translate(to.x(left.x + place), to.y(left.y));
      context.rotate(-Math.atan2(right.y - left.y, right.x - left.x));
      const outward = insulator[r] * to.scale;
      context.fillRect(0, up ? -outward - height : outward, Math.hypot(right.x - left.x, right.y - left.y) * to.scale, height);
      context.restore();
    }
  }

  /** The rigid bar that joins the lowest platforms of columns. */
  #bar({loads: [load], joined}, to) {
    const context = this.#context, y = to.y(load.y) + Math.max(4, 0.6e-3 * to.scale);
    context.strokeStyle = theme.colour.metal;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(to.x(joined.from), y);
    context.lineTo(to.x(joined.to), y);
    context.stroke();
  }

  /** Bodies of a network: rigid lines from the place of each to what is fixed to it. */
  #bodies({bodies}, to) {
    const context = this.#context;
    context.strokeStyle = theme.colour.soft;
    context.lineWidth = Math.max(4, 1e-3 * to.scale);
    context.lineCap = 'round';
    context.beginPath();
    for (const {fixed: [place, ...points]} of bodies)
      for (const point of points) {
        context.moveTo(to.x(place.x), to.y(place.y));
        context.lineTo(to.x(point.x), to.y(point.y));
      }
    context.stroke();
    context.lineCap = 'butt';
  }

  /** Joints as circles, springs as zigzags. */
  #links({joints, springs}, to) {
    const context = this.#context;
    context.strokeStyle = theme.colour.accent;
    context.lineWidth = 1.5;
    for (const [from, end] of springs) {
      const a = {x: to.x(from.x), y: to.y(from.y)}, d = {x: to.x(end.x) - a.x, y: to.y(end.y) - a.y};
      const length = Math.hypot(d.x, d.y) || 1, turns = 12, wide = 5;
      context.beginPath();
      context.moveTo(a.x, a.y);
      for (let k = 1; k < turns; k++) {
        const side = k === 1 || k === turns - 1 ? 0 : k % 2 ? wide : -wide;
        context.lineTo(a.x + (d.x * k) / turns - (side * d.y) / length, a.y + (d.y * k) / turns + (side * d.x) / length);
      }
      context.lineTo(a.x + d.x, a.y + d.y);
      context.stroke();
    }
    context.fillStyle = theme.colour.panel;
    for (const {x, y} of joints) {
      context.beginPath();
      context.arc(to.x(x), to.y(y), 4, 0, 2 * Math.PI);
      context.fill();
      context.stroke();
    }
  }

  /** The voltage of each member of a network, where there is room above it. */
  #voltages({geometry: {network, members}, texts}, to) {
    if (!network) return;
    const context = this.#context;
    context.font = '12px system-ui, sans-serif';
    for (const [k, {platforms: [[left, right]], reach}] of members.entries()) {
      const wide = context.measureText(texts.voltages[k]).width;
      if (wide + 16 > reach * to.scale) continue;
      this.#label(texts.voltages[k], to.x((left.x + right.x) / 2 + 9e-3) + 10, to.y((left.y + right.y) / 2) - 16);
    }
  }

  /** A force with which the pointer pulls at a load: an arrow from there. */
  #pull({pull, geometry: {loads}, texts}, to) {
    const load = pull && loads.find(({body}) => body === pull.body);
    if (!load) return;
    const context = this.#context, {x, y} = middleOf(load, to), reach = to.scale / pullStiffness;
    const tip = {x: x + pull.right * reach, y: y - pull.up * reach}, angle = Math.atan2(tip.y - y, tip.x - x);
    context.strokeStyle = context.fillStyle = theme.colour.accent;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(x, y);
    context.lineTo(tip.x, tip.y);
    context.stroke();
    context.beginPath();
    context.moveTo(tip.x, tip.y);
    for (const turn of [2.7, -2.7]) context.lineTo(tip.x + 10 * Math.cos(angle + turn), tip.y + 10 * Math.sin(angle + turn));
    context.fill();
    context.font = '600 13px system-ui, sans-serif';
    this.#label(texts.pull, tip.x + 10, tip.y);
  }

  /** The load at this place of the canvas, px => {body, pull: of another place, the force that the pointer has there, N};
   * null if there is none. A load that moves up and down is pulled up and down alone. */
  grip(x, y) {
    const {loads = [], to} = this.#shown ?? {};
    const seen = loads.map((load) => {
      const middle = middleOf(load, to);
      return {...load, distance: Math.hypot(x - middle.x, y - middle.y) - middle.size / 2};
    });
    const nearest = seen.reduce((best, one) => (one.distance < best.distance ? one : best), {distance: 14});
    if (nearest.body === undefined) return null;
    const {body, aside} = nearest, force = pullStiffness / to.scale;
    return {body, pull: (right, down) => ({body, right: aside ? (right - x) * force : 0, up: (y - down) * force})};
  }

  #clip({x, y, axis}, {first, outward}, to) {
    const context = this.#context, length = Math.hypot(x[0][0] - x[0][first], y[0][0] - y[0][first]), height = Math.max(9, 2.4e-3 * to.scale);
    context.fillStyle = theme.colour.load;
    context.save();
    context.translate((x[0][0] + x[1][0]) / 2, (y[0][0] + y[1][0]) / 2);
    context.rotate(Math.atan2(axis.y, axis.x));
    context.beginPath();
    context.roundRect(outward < 0 ? 0 : -length, -height / 2, length, height, 3);
    context.fill();
    context.restore();
  }

  /** A load hangs on a string along gravity. Where it does not hang, and where gravity does not point down, it sits on what
   * carries it. */
  #load({body, mass, x, y, hangs: may}, scene, to) {
    if (!(mass > 0)) return;
    const context = this.#context, side = Math.cbrt(mass / steel) * to.scale, {gravity} = scene.geometry;
    const hangs = may && Math.cos(gravity) > 0.3, string = hangs ? margin.string * to.scale : 0;
    const from = {x: to.x(x), y: to.y(y)};
    const at = {x: from.x + string * Math.sin(gravity), y: may ? from.y + string * Math.abs(Math.cos(gravity)) : from.y - side / 2};
    context.strokeStyle = theme.colour.load;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(from.x, from.y);
    context.lineTo(at.x, at.y);
    context.stroke();
    context.fillStyle = theme.colour.load;
    context.beginPath();
    context.roundRect(at.x - side / 2, at.y, side, side, Math.min(4, side / 5));
    context.fill();
    context.font = '600 13px system-ui, sans-serif';
    if (!may) return;
    const inside = side > 44;
    context.textBaseline = 'middle';
    context.textAlign = inside ? 'center' : 'left';
    context.fillStyle = inside ? theme.colour.panel : theme.colour.ink;
    context.fillText(scene.texts.masses.get(body), inside ? at.x : at.x + side / 2 + 7, at.y + side / 2);
  }

  /** The mass of a load that sits, below it. */
  #mass({body, mass, x, y}, {texts}, to) {
    if (!(mass > 0)) return;
    const context = this.#context, words = texts.masses.get(body), side = Math.cbrt(mass / steel) * to.scale;
    context.font = '600 13px system-ui, sans-serif';
    this.#label(words, to.x(x) - context.measureText(words).width / 2, to.y(y) + side / 2 + 14);
  }

  /** Words over what is drawn, from x on. */
  #label(words, x, y) {
    const context = this.#context;
    context.textAlign = 'left';
    context.textBaseline = 'middle';
    context.fillStyle = theme.colour.panel;
    context.globalAlpha = 0.75;
    context.beginPath();
    context.roundRect(x - 4, y - 10, context.measureText(words).width + 8, 20, 5);
    context.fill();
    context.globalAlpha = 1;
    context.fillStyle = theme.colour.ink;
    context.fillText(words, x, y);
  }

  /** The opening, beside the platforms. */
  #opening(scene, to) {
    const context = this.#context, x = to.x(scene.geometry.openingAt), top = to.y(0), bottom = to.y(-scene.opening);
    if (!(bottom - top >= 26)) return; // a kind without an opening has none
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
    this.#label(scene.texts.opening, x + 9, (top + bottom) / 2);
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

  /** The zip front of a left half, magnified: metal, insulator, liquid, insulator, metal, all to scale. */
  #lens(scene, to, width, height) {
    const context = this.#context, {at, radius} = lensPlace(width, height);
    const member = scene.geometry.focus, {insulator, metal, places} = member;
    const scale = to.scale * magnification, focus = zipFront(member.halves[0], insulator);
    const inside = {scale, x: (x) => at.x + scale * (x - focus.x), y: (y) => at.y - scale * (y - focus.y)};
    const from = {x: to.x(focus.x + places[0]), y: to.y(focus.y)};
    this.#beam(from, at, radius);
    context.save();
    context.beginPath();
    context.arc(at.x, at.y, radius, 0, 2 * Math.PI);
    context.fillStyle = scene.bath ? theme.colour.bath : theme.colour.panel;
    context.fill();
    context.clip();
    const half = new Half(member.halves[0], member, inside);
    half.liquid(context, scene, member.electrode, [0, 0]);
    for (const r of [0, 1]) {
      context.fillStyle = theme.colour.insulator;
      half.layer(context, r, 0, insulator[r]);
      context.fillStyle = theme.colour.metal;
      half.layer(context, r, insulator[r], insulator[r] + metal[r]);
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
    context.fillText(`${scene.texts.front}, ${magnification} times larger`, at.x - radius, height - 12);
    this.#layers(scene, at.x + radius + 8, height - 40);
  }

  /** Labels of the layers in the lens, from the lowest line up. */
  #layers({bath, texts}, x, y) {
    const context = this.#context, gap = context.createLinearGradient(x, 0, x + 14, 0);
    [0, 0.25, 1].forEach((share) => gap.addColorStop(Math.sqrt(share), shade(share)));
    const between = bath || texts.wet ? 'liquid, by field' : 'gap, by field';
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
