// A study that follows the scenario: only the newest request is answered.
import {Remote} from './remote.js';

const tooOld = 500; // ms after which a question that is overtaken is given up

/** A number of a study at each of several voltages. The voltages are computed in turn, each for the newest scenario:
 * during a drag, the curve follows from one end to the other. */
export class Chart {
  #remote;
  #values = null;
  #version = 0;
  #drawn; // version of each point
  #next = 0;

  /** `volts` ascending; `changed` is called after each point; the points are in `y`, NaN if there is none. */
  constructor(module, study, scalar, volts, changed) {
    this.volts = volts;
    this.y = volts.map(() => NaN);
    this.#drawn = volts.map(() => 0);
    this.#remote = new Remote(module, ({result}) => {
      this.y[this.#next] = result?.scalars[scalar] ?? NaN;
      this.#next = (this.#next + 1) % volts.length;
      changed();
      this.#go();
    });
    this.form = {study, scalars: [scalar], columns: []};
  }

  /** Are points missing? */
  get due() {
    return this.#drawn.some((version) => version < this.#version);
  }

  /** Does point `k` belong to the newest scenario? */
  fresh(k) {
    return this.#drawn[k] === this.#version && !(this.#remote.busy && k === this.#next);
  }

  /** `values`: a Map of key => text */
  ask(values) {
    this.#values = values;
    this.#version++;
    if (!this.#remote.busy) this.#go();
  }

  #go() {
    if (!this.due) return;
    this.#drawn[this.#next] = this.#version;
    this.#remote.ask({...this.form, values: new Map([...this.#values, ['drive.voltage', `${this.volts[this.#next]} V`]])});
  }
}

export class Study {
  #remote;
  #waiting = null;

  /** `answer` gets {result, stopped}, {refused}, {stopped} or {broken}; results have the requested `scalars` and `columns`. */
  constructor(module, study, scalars, columns, answer) {
    this.form = {study, scalars, columns};
    this.#remote = new Remote(module, (data) => {
      answer(data);
      this.#next();
    });
  }

  /** Is an answer missing? */
  get due() {
    return this.#remote.busy;
  }

  /** `values`: a Map of key => text */
  ask(values) {
    this.#waiting = values;
    if (this.#remote.waited >= tooOld) this.#remote.drop();
    if (!this.#remote.busy) this.#next();
  }

  #next() {
    if (!this.#waiting) return;
    const values = this.#waiting;
    this.#waiting = null;
    this.#remote.ask({...this.form, values});
  }
}
