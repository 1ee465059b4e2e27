// The actuator in motion: what the core computes from frame to frame, and what was seen so far.
const budget = 4; // ms of a frame for the simulation; where it needs more, time goes slower
const chunk = {least: 1e-5, most: 1e-3, cost: 1.5}; // s of simulated time between looks at the clock; ms it may cost

export class Live {
  time = 0; // s, as the simulation counts
  zero = 0; // s, when the voltage last changed by a button
  failure = null; // how the numerics ended, until something changes
  trace = {time: [], stroke: []}; // since `zero`
  pace = 1; // share of the time asked for that was run, lately
  #cost = 2000; // ms a simulated second, lately

  constructor(core) {
    this.core = core;
  }

  get voltage() {
    return this.core.signal('voltage');
  }

  /** From the hanging equilibrium, the voltage on from now. */
  restart(voltage) {
    this.core.start();
    this.core.setVoltage(voltage);
    this.time = 0;
    this.failure = null;
    this.#mark();
  }

  /** The scenario has changed: go on in it; after a failure, or with another number of nodes, from its start. */
  change(voltage) {
    if (!this.failure && this.core.nodes === this.core.value('mesh.nodes')) {
      this.core.start(true);
      if (this.voltage !== voltage) this.core.setVoltage(voltage);
    } else {
      this.restart(voltage);
    }
  }

  /** A button: another voltage from now on. */
  switchTo(voltage) {
    if (this.failure) this.core.start();
    this.failure = null;
    this.core.setVoltage(voltage);
    this.#mark();
  }

  #mark() {
    this.zero = this.time;
    this.trace = {time: [], stroke: []};
    this.#note();
  }

  #note() {
    const {time, stroke} = this.trace, most = 4000;
    time.push(this.time - this.zero);
    stroke.push(this.core.signal('stroke'));
    if (time.length < most) return;
    const every = (_, k) => k % 2 === 0;
    this.trace = {time: time.filter(every), stroke: stroke.filter(every)};
  }

  /** Run `span` seconds, or as far as the budget of a frame goes. */
  advance(span) {
    const begin = this.time, end = begin + span, start = performance.now();
    let now = start;
    while (this.time < end && now - start < budget) {
      const length = Math.min(Math.max(chunk.cost / this.#cost, chunk.least), chunk.most);
      const next = this.time + length > end ? end : this.time + length;
      this.failure = this.core.run(next);
      if (this.failure) return;
      const done = performance.now();
      this.#cost += 0.2 * ((done - now) / (next - this.time) - this.#cost);
      this.time = next;
      now = done;
      this.#note();
    }
    this.pace += 0.1 * ((this.time - begin) / span - this.pace);
  }
}
