// The state at one instant as numbers in one array, which is passed to the engine and back without a copy: single
// numbers by name, the shape, and the strokes since the previous frame.

const own = ['time', 'since', 'marks', 'advanced', 'nodes', 'offset', 'liquid', 'samples'];
const signals = {
  voltage: 'voltage_V', stroke: 'stroke_m', opening: 'opening_m', contraction: 'contraction', zipped_length: 'zipped_length_m',
  force: 'force_N', capacitance: 'capacitance_F', insulator_field: 'insulator_field_V_per_m', max_stress: 'max_stress_Pa',
  film_thickness: 'film_thickness_m', wet_length: 'wet_length_m',
};
// of the scenario of this instant, which is not always the newest
const keys = ['ribbon.length', 'platform.length', 'platform.electrode', 'ribbon.thickness', 'insulator.thickness', 'load.mass',
              'medium.breakdown_field', 'medium.permittivity', 'air.breakdown_field', 'electro.breakdown_cap', 'electro.voltage_share'];
const place = new Map([...own, ...Object.keys(signals), ...keys].map((name, k) => [name, k]));

/** Columns of a sample; the time counts from the last mark, the current is the mean since the previous sample, NaN if an
 * ideal source has charged the electrodes at once. */
export const sampled = ['time_s', 'stroke_m', 'voltage_V', 'command_V', 'current_A'];

/** Largest number of samples in a frame. */
export const mostSamples = 64;
const head = place.size + sampled.length * mostSamples, ofNodes = 8;

/** Fill `data`, or a new array if it is too short, from a Motion. `advanced`: simulated s since the previous frame. */
export function write(data, motion, advanced) {
  const {core, samples} = motion, length = head + ofNodes * core.nodes;
  const frame = data?.length >= length ? data : new Float64Array(length);
  const numbers = [motion.time, motion.time - motion.zero, motion.marks, advanced, core.nodes, core.insulatorOffset,
                   core.effective('liquid.model'), samples.length / sampled.length, ...core.read(Object.values(signals)),
                   ...keys.map((name) => core.value(name))];
  const shape = core.shape();
  frame.set(numbers);
  frame.set(samples, place.size);
  let at = head;
  for (const part of [shape.x, shape.y, shape.gap, shape.lineForce, shape.film, shape.pressure]) {
    frame.set(part, at);
    at += part.length;
  }
  return frame;
}

export class Frame {
  /** @param {Float64Array} data of `write` */
  constructor(data) {
    this.data = data;
  }

  /** A number by its name: time (of the simulation), since (the last mark), marks (their count), advanced (s since the
   * previous frame), nodes, offset (liquid equivalent to both insulators, m), liquid (as liquid.model, auto resolved), a
   * signal or a key of the lists above. */
  get(name) {
    return this.data[place.get(name)];
  }

  /** Insulator faces: x, y [2 nodes], upper and lower alternating; gap, lineForce [nodes]; film, pressure [nodes],
   * without meaning if there is no liquid. */
  get shape() {
    const nodes = this.get('nodes'), part = (from, to) => this.data.subarray(head + from * nodes, head + to * nodes);
    return {x: part(0, 2), y: part(2, 4), gap: part(4, 5), lineForce: part(5, 6), film: part(6, 7), pressure: part(7, 8)};
  }

  /** `note` is called with the numbers of each sample. */
  eachSample(note) {
    const size = sampled.length;
    for (let k = 0; k < this.get('samples'); k++) note(...this.data.subarray(place.size + size * k, place.size + size * (k + 1)));
  }
}
