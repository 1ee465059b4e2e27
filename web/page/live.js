// The actuator in motion on the page: frames from an engine, and the curves so far.
import {Frame} from './frame.js';
import {Remote} from './remote.js';

const mostOwed = 0.25; // s of simulated time; what a slow engine cannot run is left out

const mostNoted = 4000; // instants of a curve; then every second one goes

/** The motion so far: s, m, V, V, A. */
const noTrace = () => ({time: [], stroke: [], voltage: [], command: [], current: []});

/** That of the parts of a network: s; for each member m and V; for each body that moves its angle (rad) in the plane, else
 * its height (m). */
const noParts = () => ({time: [], openings: [], voltages: [], bodies: []});

function partsOf(frame) {
  const members = frame.parts('member'), bodies = frame.parts('body').filter(({held}) => !held);
  const inPlane = frame.inPlane;
  return {
    openings: members.map(({opening}) => opening),
    voltages: members.map(({voltage}) => voltage),
    bodies: bodies.map(({y, angle}) => (inPlane ? angle : y)),
  };
}

export class Live {
  frame = null; // the newest
  end = null; // {failure}, {stopped}, {broken} or {refused}: why it does not continue, until something changes
  trace = noTrace(); // since a button changed the voltage
  parts = noParts(); // the same of a network
  pace = 1; // share of the time asked for that was run, lately
  #remote;
  #values; // of the scenario
  #wish = null; // what has changed since the last question
  #lost = true; // the engine knows nothing of the scenario
  #owed = 0; // s asked for since the last question
  #asked = 0; // s asked for by it
  #spare = new Float64Array(0); // not on show: the engine fills it
  #marks = NaN; // of the trace

  constructor(module) {
    this.#remote = new Remote(module, (answer) => this.#take(answer));
  }

  /** Start from the hanging equilibrium of the scenario, with the voltage on from now. */
  restart(values, voltage) {
    this.#want({values, voltage, restart: true});
  }

  /** The scenario has changed: continue in it. */
  change(values, voltage) {
    this.#want({values, voltage});
  }

  /** A button was pressed: another voltage from now on. */
  switchTo(voltage) {
    this.#want({voltage, pressed: true});
  }

  /** The pointer pulls at a load: {body, right, up}, N, from now on. */
  pull(force) {
    this.#want({pull: force});
  }

  /** Changes while the engine is busy are sent together, the newest of each kind. */
  #want(wish) {
    this.end = null;
    this.#values = wish.values ?? this.#values;
    const whole = this.#lost && {values: this.#values, restart: true};
    this.#wish = {...this.#wish, ...whole, ...wish};
  }

  /** Called once per frame: simulate another `span` seconds, 0 for a pause. */
  advance(span) {
    this.#owed = span ? Math.min(this.#owed + span, mostOwed) : 0;
    if (this.#remote.busy || (!this.#wish && (this.end || !span))) return;
    const question = {...this.#wish, span: this.#owed, frame: this.#spare};
    this.#asked = this.#owed;
    this.#owed = 0;
    this.#wish = null;
    this.#lost = false;
    this.#remote.ask(question, [this.#spare]);
  }

  #take({frame, lost, ...rest}) {
    const end = Object.entries(rest).find(([, value]) => value);
    if (!this.#wish) this.end = end ? Object.fromEntries([end]) : null;
    if (lost) this.#lose();
    else if (rest.failure || rest.refused) this.#spare = frame; // the last good instant stays in sight
    else this.#show(new Frame(frame));
  }

  #lose() {
    this.#lost = true;
    this.#marks = NaN;
    this.#spare = new Float64Array(0);
    if (this.#wish) this.#wish = {values: this.#values, restart: true, ...this.#wish};
  }

  #show(frame) {
    if (frame.get('marks') !== this.#marks) {
      this.trace = noTrace();
      this.parts = noParts();
    }
    this.#marks = frame.get('marks');
    this.#spare = this.frame?.data ?? new Float64Array(0);
    this.frame = frame;
    frame.eachSample((...sample) => this.#note(sample));
    if (frame.get('bodies') > 0) this.#noteParts(frame);
    if (this.#asked > 0) this.pace += 0.1 * (frame.get('advanced') / this.#asked - this.pace);
  }

  #noteParts(frame) {
    const seen = partsOf(frame), kinds = Object.keys(seen);
    if (kinds.some((kind) => this.parts[kind].length !== seen[kind].length))
      this.parts = {time: [], ...Object.fromEntries(kinds.map((kind) => [kind, seen[kind].map(() => [])]))};
    this.parts.time.push(frame.get('since'));
    for (const kind of kinds) seen[kind].forEach((value, k) => this.parts[kind][k].push(value));
    if (this.parts.time.length < mostNoted) return;
    const half = (list) => list.filter((_, k) => k % 2 === 0);
    for (const kind of kinds) this.parts[kind] = this.parts[kind].map(half);
    this.parts.time = half(this.parts.time);
  }

  /** `sample`: in the order of the lists of the trace. */
  #note(sample) {
    const lists = Object.entries(this.trace);
    lists.forEach(([, list], k) => list.push(sample[k]));
    if (this.trace.time.length < mostNoted) return;
    this.trace = Object.fromEntries(lists.map(([name, list]) => [name, list.filter((_, k) => k % 2 === 0)]));
  }
}
