// What an engine tells of one instant, as numbers in one array, which goes there and back without a copy:
// single numbers by name, the shape, and what the stroke was since the frame before.

const own = ['time', 'since', 'marks', 'advanced', 'nodes', 'offset', 'samples'];
const signals = ['voltage', 'stroke', 'opening', 'contraction', 'zipped_length', 'force', 'capacitance', 'insulator_field', 'max_stress'];
// of the scenario that this instant belongs to, which is not always the newest
const keys = ['ribbon.length', 'platform.length', 'platform.electrode', 'ribbon.thickness', 'insulator.thickness', 'load.mass',
              'medium.breakdown_field', 'electro.breakdown_cap', 'electro.voltage_share'];
const place = new Map([...own, ...signals, ...keys].map((name, k) => [name, k]));

/** Most pairs of time and stroke in a frame. */
export const mostSamples = 64;

/** Fill `data`, or a new array where it is too short, from a Motion. `advanced`: s run since the frame before. */
export function write(data, motion, advanced) {
  const {core, samples} = motion, shape = core.shape(), head = place.size + 2 * mostSamples, length = head + 6 * core.nodes;
  const frame = data?.length >= length ? data : new Float64Array(length);
  const numbers = [motion.time, motion.time - motion.zero, motion.marks, advanced, core.nodes, core.insulatorOffset,
                   samples.length / 2, ...signals.map((name) => core.signal(name)), ...keys.map((name) => core.value(name))];
  frame.set(numbers);
  frame.set(samples, place.size);
  let at = head;
  for (const part of [shape.x, shape.y, shape.gap, shape.lineForce]) {
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
   * frame before), nodes, offset (liquid that stands for both insulators, m), a signal or a key of the lists above. */
  get(name) {
    return this.data[place.get(name)];
  }

  /** Insulator faces: x, y [2 nodes], upper and lower by turns; gap, lineForce [nodes]. */
  get shape() {
    const nodes = this.get('nodes'), part = (from, to) => this.data.subarray(head + from * nodes, head + to * nodes);
    const head = place.size + 2 * mostSamples;
    return {x: part(0, 2), y: part(2, 4), gap: part(4, 5), lineForce: part(5, 6)};
  }

  /** `note` gets times since the mark and strokes. */
  eachSample(note) {
    for (let k = 0; k < this.get('samples'); k++) note(this.data[place.size + 2 * k], this.data[place.size + 2 * k + 1]);
  }
}
