// The actuator in motion, computed by the core step by step.
import {Refused} from './core.js';
import {mostSamples, sampled} from './frame.js';

const longest = 1e-3; // s of simulated time between two samples of the stroke
const patience = {time: 2e3, share: 1e-3}; // ms of computing that must give this share of the time asked for

export class Motion {
  time = 0; // s, as the simulation counts
  zero = 0; // s, when the voltage last changed by a button
  marks = 0; // how often that was
  samples = []; // rows of `sampled`, one after the other, since the last frame
  failure = 'nothing to run'; // reason why the solver failed, until something changes
  stopped = null; // {seconds, moved} that was computed in vain, until something changes
  #effort = {spent: 0, asked: 0, moved: 0}; // ms, s, s
  #jumped = false; // an ideal source has charged the electrodes at once: the next mean current has that charge

  constructor(core) {
    this.core = core;
  }

  get ended() {
    return this.failure !== null || this.stopped !== null;
  }

  /** Start from the hanging equilibrium, found within `limit` ms, with the voltage on from now; at drive.voltage with what
   * a network plays. */
  restart(voltage, limit) {
    this.#begin(false, limit);
    if (!this.core.plays || voltage !== this.core.value('drive.voltage')) this.#switch(voltage);
    this.time = 0;
    this.#mark();
  }

  /** The scenario has changed: continue in it; after a failure, in an actuator of another kind, or in a network that plays
   * waveforms, from its start. */
  change(voltage, limit) {
    if (this.ended || this.core.plays || !this.#continues(limit)) return this.restart(voltage, limit);
    if (this.core.signal('command') !== voltage || this.core.members > 1) this.#switch(voltage);
  }

  /** Continue, if the core can do so from the last state. */
  #continues(limit) {
    try {
      this.#begin(true, limit);
      return true;
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      return false;
    }
  }

  /** A button was pressed: another voltage from now on. */
  switchTo(voltage, limit) {
    if (this.ended) return this.restart(voltage, limit);
    this.#switch(voltage);
    this.#mark();
  }

  /** Pull at a load from now on: {body, right, up}, N. */
  pull(force) {
    if (!this.ended) this.core.pull(force);
  }

  #begin(goOn, limit) {
    this.failure = 'it did not start';
    this.core.allow(limit);
    this.core.start(goOn);
    this.failure = null;
    this.stopped = this.core.expired ? {seconds: limit / 1e3, moved: 0} : null;
    this.#effort = {spent: 0, asked: 0, moved: 0};
  }

  #switch(voltage) {
    this.core.setVoltage(voltage);
    this.#jumped = this.core.value('source.model') === 0;
  }

  #mark() {
    this.zero = this.time;
    this.marks++;
    this.samples.length = 0;
    this.samples.push(...this.core.read(sampled));
    this.#since();
  }

  #note() {
    this.samples.push(...this.core.read(sampled));
    if (this.#jumped) this.samples[this.samples.length - 1] = NaN;
    this.#jumped = false;
    this.#since();
  }

  /** The times of samples count from the mark. */
  #since() {
    const at = this.samples.length - sampled.length;
    this.samples[at] = this.time - this.zero;
  }

  /** Run `span` seconds, or as many as `budget` ms allow. => simulated seconds */
  advance(span, budget) {
    const {core} = this, begin = this.time, end = begin + span, start = performance.now();
    const piece = Math.max(longest, span / (mostSamples - 2));
    core.allow(budget);
    while (this.time < end && !core.expired && performance.now() - start < budget) {
      this.failure = core.run(this.time + piece > end ? end : this.time + piece);
      if (this.failure) break;
      this.time = core.signal('time');
      this.#note();
    }
    this.#judge(performance.now() - start, span, this.time - begin);
    return this.time - begin;
  }

  /** Give up if it does not move in spite of all computing. */
  #judge(spent, asked, moved) {
    const effort = this.#effort;
    effort.spent += spent;
    effort.asked += asked;
    effort.moved += moved;
    if (effort.spent < patience.time) return;
    if (effort.moved < patience.share * effort.asked) this.stopped = {seconds: patience.time / 1e3, moved: effort.moved};
    this.#effort = {spent: 0, asked: 0, moved: 0};
  }
}
