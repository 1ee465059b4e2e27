// One study that follows the scenario: the newest question is answered, those that were overtaken are not.
import source from 'worker:study.js';

export class Study {
  #worker;
  #waiting = null;
  #busy = false;

  /** `answer` gets {result} or {refused}; results have the `scalars` asked for. */
  constructor(module, study, scalars, answer) {
    this.study = study;
    this.scalars = scalars;
    this.#worker = new Worker(URL.createObjectURL(new Blob([source], {type: 'text/javascript'})));
    this.#worker.postMessage({module});
    this.#worker.onmessage = ({data}) => {
      this.#busy = false;
      answer(data);
      this.#next();
    };
  }

  /** True while an answer is due. */
  get due() {
    return this.#busy;
  }

  ask(values) {
    this.#waiting = {study: this.study, scalars: this.scalars, values};
    if (!this.#busy) this.#next();
  }

  #next() {
    if (!this.#waiting) return;
    this.#busy = true;
    this.#worker.postMessage(this.#waiting);
    this.#waiting = null;
  }
}
