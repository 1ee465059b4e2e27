// The actuator in motion: what the core computes from frame to frame, and what was seen so far.
const chunk = 1e-3; // s of simulated time between looks at the clock
const budget = 5; // ms of a frame for the simulation; where it needs more, time goes slower

export class Live {
  time = 0; // s, as the simulation counts
  zero = 0; // s, when the voltage last changed by a button
  failure = null; // how the numerics ended, until something changes
  trace = {time: [], stroke: []}; // since `zero`

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
    const end = this.time + span, begin = performance.now();
    while (this.time < end && !this.failure && performance.now() - begin < budget) {
      const next = Math.min(this.time + chunk, end);
      this.failure = this.core.run(next);
      if (this.failure) return;
      this.time = next;
      this.#note();
    }
  }
}
