// The state at one instant as numbers in one array, which is passed to the engine and back without a copy: single
// numbers by name, the strokes since the previous frame, numbers of each member, body, spring and joint, and the shapes.
import {kinds, ofPart} from './core.js';

const own = ['time', 'since', 'marks', 'advanced', 'nodes', 'halves', ...Object.values(kinds), 'liquid', 'samples'];
const signals = {
  voltage: 'voltage_V', stroke: 'stroke_m', opening: 'opening_m', contraction: 'contraction', zipped_length: 'zipped_length_m',
  force: 'force_N', capacitance: 'capacitance_F', insulator_field: 'insulator_field_V_per_m', max_stress: 'max_stress_Pa',
  film_thickness: 'film_thickness_m',
};
// of the scenario of this instant, which is not always the newest
const keys = ['actuator.kind', 'load.mass', 'load.offset', 'mount.tilt', 'stack.series', 'stack.parallel', 'stack.distance', 'pouch.count',
              'medium.breakdown_field', 'medium.permittivity', 'air.breakdown_field', 'electro.breakdown_cap', 'electro.voltage_share'];
const place = new Map([...own, ...Object.keys(signals), ...keys].map((name, k) => [name, k]));

/** Columns of a sample; the time counts from the last mark, the current is the mean since the previous sample, NaN if an
 * ideal source has charged the electrodes at once. */
export const sampled = ['time_s', 'stroke_m', 'voltage_V', 'command_V', 'current_A'];

/** Largest number of samples in a frame. */
export const mostSamples = 64;
const head = place.size + sampled.length * mostSamples, ofNodes = 8, most = 2; // halves of a member

/** Where the numbers of each kind of part begin, then the wet lengths and the shapes, if `count` says how many there are
 * of each; and the length of all. */
function layout(count, nodes) {
  const at = {};
  let end = head;
  for (const [kind, name] of Object.entries(kinds)) {
    at[kind] = end;
    end += count(name) * ofPart[kind].length;
  }
  return {at, wet: end, shapes: end + most * count('members'), length: end + (most + ofNodes * nodes) * count('members')};
}

/** Fill `data`, or a new array if it is too short, from a Motion. `advanced`: simulated s since the previous frame. */
export function write(data, motion, advanced) {
  const {core, samples} = motion, {nodes} = core, {at, wet, shapes, length} = layout((name) => core[name], nodes);
  const frame = data?.length >= length ? data : new Float64Array(length);
  const numbers = [motion.time, motion.time - motion.zero, motion.marks, advanced, nodes, core.halves,
                   ...Object.values(kinds).map((name) => core[name]), core.effective('liquid.model'), samples.length / sampled.length,
                   ...core.read(Object.values(signals)), ...keys.map((name) => core.value(name))];
  frame.set(numbers);
  frame.set(samples, place.size);
  for (const [kind, name] of Object.entries(kinds))
    for (let k = 0; k < core[name]; k++) frame.set(core.part(kind, k), at[kind] + k * ofPart[kind].length);
  const shape = core.shape();
  frame.set(shape.wetLength, wet);
  let next = shapes;
  for (const part of [shape.x, shape.y, shape.gap, shape.lineForce, shape.film, shape.pressure]) {
    frame.set(part, next);
    next += part.length;
  }
  return frame;
}

export class Frame {
  /** @param {Float64Array} data of `write` */
  constructor(data) {
    this.data = data;
  }

  /** A number by its name: time (of the simulation), since (the last mark), marks (their count), advanced (s since the
   * previous frame), nodes (stations of each ribbon), halves (as that of the core), members, bodies, springs and joints
   * (how many there are), liquid (as liquid.model, auto resolved), a signal or a key of the lists above. */
  get(name) {
    return this.data[place.get(name)];
  }

  /** The numbers of part k of a kind, by the names of `ofPart`. */
  part(kind, k) {
    const from = this.#layout().at[kind] + k * ofPart[kind].length;
    return Object.fromEntries(ofPart[kind].map((name, i) => [name, this.data[from + i]]));
  }

  /** Do bodies of a network move in the plane? */
  get inPlane() {
    return this.get('bodies') > 0 && Number.isNaN(this.part('member', 0).middle);
  }

  /** All parts of a kind. */
  parts(kind) {
    return Array.from({length: this.get(kinds[kind])}, (_, k) => this.part(kind, k));
  }

  #layout() {
    return layout((name) => this.get(name), this.get('nodes'));
  }

  /** Member k: its numbers; x, y [2 nodes] of the insulator faces, upper and lower alternating; gap, lineForce [nodes];
   * film, pressure [nodes] and wetLength [halves], without meaning if there is no liquid. */
  member(k) {
    const {data} = this, nodes = this.get('nodes'), members = this.get('members'), halves = Math.max(this.get('halves'), 1);
    const {wet, shapes} = this.#layout();
    const part = (from, size) => {
      const at = shapes + nodes * (from * members + size * k);
      return data.subarray(at, at + size * nodes);
    };
    return {
      ...this.part('member', k),
      x: part(0, 2), y: part(2, 2), gap: part(4, 1), lineForce: part(5, 1), film: part(6, 1), pressure: part(7, 1),
      wetLength: data.subarray(wet + k * halves, wet + (k + 1) * halves),
    };
  }

  /** `note` is called with the numbers of each sample. */
  eachSample(note) {
    const size = sampled.length;
    for (let k = 0; k < this.get('samples'); k++) note(...this.data.subarray(place.size + size * k, place.size + size * (k + 1)));
  }
}
