// One study that follows the scenario: the newest question is answered, those that were overtaken are not.
import {Remote} from './remote.js';

const tooOld = 500; // ms after which a question that is overtaken is given up

export class Study {
  #remote;
  #waiting = null;

  /** `answer` gets {result, stopped}, {refused}, {stopped} or {broken}; results have the `scalars` and `columns` asked for. */
  constructor(module, study, scalars, columns, answer) {
    this.form = {study, scalars, columns};
    this.#remote = new Remote(module, (data) => {
      answer(data);
      this.#next();
    });
  }

  /** True while an answer is due. */
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
