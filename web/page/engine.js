// Answers requests of the page with its own core: in a worker, or, if there is none, between two frames.
import {Core, Refused} from './core.js';
import {write} from './frame.js';
import {Motion} from './motion.js';

/** ms that a study, a hanging equilibrium and the motion of one frame may take. */
export const limits = {
  worker: {study: 20e3, start: 5e3, frame: 8},
  page: {study: 300, start: 100, frame: 4},
};

export class Engine {
  #core;
  #motion;
  #limits;

  /** @param {WebAssembly.Module} module @param limits one of the above */
  constructor(module, limits) {
    this.#core = new Core(module);
    this.#motion = new Motion(this.#core);
    this.#limits = limits;
  }

  /** Request of a Study or of Live => its answer; {refused} if the core refuses it. */
  answer(question) {
    try {
      return question.study ? this.#study(question) : this.#move(question);
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      return {refused: error.message, frame: question.frame};
    }
  }

  /** {study, values, scalars, columns} => {result, stopped: seconds after which it was stopped, or null} */
  #study({study, values, scalars, columns}) {
    const core = this.#core, limit = this.#limits.study;
    core.resolve(values);
    core.allow(limit);
    const result = core.study(study, scalars, columns);
    return {result, stopped: core.expired ? {seconds: limit / 1e3} : null};
  }

  /** {values: those of the scenario if it has changed, voltage: of the source, V, restart: from hanging, pressed: a button
   * set the voltage, pull: force of the pointer on a load, span: time to run, s, frame: array to fill} => {frame, failure, stopped} of Motion. The answer to a
   * restart is its first instant. */
  #move({values, voltage, restart, pressed, pull, span, frame}) {
    const motion = this.#motion, {start, frame: budget} = this.#limits;
    if (values) this.#core.resolve(values);
    if (restart) motion.restart(voltage, start);
    else if (values) motion.change(voltage, start);
    if (pressed && !restart) motion.switchTo(voltage, start);
    if (pull) motion.pull(pull);
    const advanced = restart || motion.ended ? 0 : motion.advance(span, budget);
    const filled = write(frame, motion, advanced);
    motion.samples.length = 0;
    return {frame: filled, failure: motion.failure, stopped: motion.stopped};
  }
}
