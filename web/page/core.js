// zipact's C core as a JavaScript object: web/zipact_web.c with its buffer of text, and its numbers without copying.

// The system calls of the C library: no files, no environment; exit is an exception.
const system = {
  environ_get: () => 0,
  environ_sizes_get: () => 0,
  fd_close: () => 8,
  fd_seek: () => 8,
  fd_write: () => 8,
  proc_exit: (code) => {
    throw new Error(`the core ended with ${code}`);
  },
};

/** What the page draws beside shapes: parts, and how many there are of each kind. Only a network has bodies. */
export const kinds = {member: 'members', body: 'bodies', spring: 'springs', joint: 'joints'};

/** Numbers of each part: of a member the voltage of its electrodes (V), its opening (m), the liquid equivalent to both insulators, thicknesses of the
 * upper and the lower insulator and metal, lengths of its ribbons and platform (m), 1 if the platform attracts, its middle
 * in the drawing (m; NaN: its shape is in the drawing as it is), 1 if it is upside down, the bodies at its ends, of
 * which 0 is the frame, 1 if it hangs and its load pulls along its films, and the length of its electrodes over theirs; of a body its place (m, rad), mass (kg), and 1 if it is held; of a spring its ends, and of a joint
 * its place (m), both with their bodies. */
export const ofPart = {
  member: ['voltage', 'opening', 'offset', 'upperInsulator', 'lowerInsulator', 'upperMetal', 'lowerMetal', 'length', 'platform', 'electrode',
           'middle', 'turned', 'upper', 'lower', 'along', 'covered'],
  body: ['x', 'y', 'angle', 'mass', 'held'],
  spring: ['fromX', 'fromY', 'toX', 'toY', 'from', 'to'],
  joint: ['x', 'y', 'from', 'to'],
};

/** A wrong value, a refused scenario, no memory: with the message of the command. */
export class Refused extends Error {}

export class Core {
  expired = false; // the last call was stopped, because its time was over
  #deadline = Infinity;
  #c;
  #web;
  #text;
  #textSize;
  #columns; // of a row of signals: name => place

  /** @param {WebAssembly.Module} module */
  constructor(module) {
    const c = new WebAssembly.Instance(module, {
      wasi_snapshot_preview1: system,
      zipact: {expired: () => Number((this.expired ||= performance.now() > this.#deadline))},
    }).exports;
    c._initialize();
    this.#c = c;
    this.#web = c.zp_web_create();
    this.#text = c.zp_web_text(this.#web);
    this.#textSize = c.zp_web_text_size();
    this.keys = new Map(Array.from({length: c.zp_web_key_count()}, (_, index) => {
      const name = this.#string(c.zp_web_key_name(index));
      return [name, {
        index,
        name,
        shown: this.#string(c.zp_web_key_shown(index)),
        help: this.#string(c.zp_web_key_help(index)),
        min: c.zp_web_key_min(index),
        max: c.zp_web_key_max(index),
        default: c.zp_web_key_default(index),
        choices: Array.from({length: c.zp_web_key_choices(index)}, (__, k) => ({
          word: this.#string(c.zp_web_choice_word(index, k)),
          help: this.#string(c.zp_web_choice_help(index, k)),
        })),
      }];
    }));
    this.#columns = new Map(Array.from({length: c.zp_web_signals()}, (_, k) => [this.#string(c.zp_web_signal_column(k)), k]));
  }

  #bytes(pointer, length) {
    return new Uint8Array(this.#c.memory.buffer, pointer, length);
  }

  #string(pointer) {
    let end = pointer;
    const all = new Uint8Array(this.#c.memory.buffer);
    while (all[end]) end++;
    return new TextDecoder().decode(all.subarray(pointer, end));
  }

  #put(text) {
    const bytes = new TextEncoder().encode(text).subarray(0, this.#textSize - 1);
    const buffer = this.#bytes(this.#text, this.#textSize);
    buffer.set(bytes);
    buffer[bytes.length] = 0;
  }

  #get() {
    return this.#string(this.#text);
  }

  #check(status) {
    if (status !== 0) throw new Refused(this.#get());
  }

  #doubles(pointer, length) {
    return new Float64Array(this.#c.memory.buffer, pointer, length);
  }

  /** Limit the following calls to `ms` from now on; then they stop with their results so far, and `expired` is true. */
  allow(ms) {
    this.#deadline = performance.now() + ms;
    this.expired = false;
  }

  // -- scenario

  /** Take `values`, a Map of key => text ("8 g"), over the defaults. If they are refused, the scenario is unchanged. */
  resolve(values) {
    this.#c.zp_web_clear(this.#web);
    for (const [key, text] of values) {
      this.#put(`${key}=${text}`);
      this.#check(this.#c.zp_web_assign(this.#web));
    }
    this.#check(this.#c.zp_web_resolve(this.#web));
  }

  /** Every key of the scenario, of members of a stack those that are given => [{name, default, value, text}]. */
  settings() {
    const c = this.#c, all = [];
    for (let index = c.zp_web_next_key(this.#web, -1); index >= 0; index = c.zp_web_next_key(this.#web, index)) {
      const name = this.#get(), value = c.zp_web_key_value(this.#web, index);
      c.zp_web_print(this.#web, index, value);
      all.push({name, default: c.zp_web_key_default(index), value, text: this.#get()});
    }
    return all;
  }

  /** Value of a key in the scenario, SI. */
  value(name) {
    return this.#c.zp_web_key_value(this.#web, this.keys.get(name).index);
  }

  /** The same; for auto the value that it means, NaN if that is not a single value. */
  effective(name) {
    return this.#c.zp_web_key_effective(this.#web, this.keys.get(name).index);
  }

  /** (key, SI) => "8 g". */
  print(name, value) {
    this.#c.zp_web_print(this.#web, this.keys.get(name).index, value);
    return this.#get();
  }

  // -- simulation

  /** A simulation of the scenario, from its hanging equilibrium or from the state of the last simulation. */
  start(goOn = false) {
    this.#check(this.#c.zp_web_start(this.#web, goOn ? 1 : 0));
    this.nodes = this.#c.zp_web_nodes(this.#web);
    this.halves = this.#c.zp_web_halves(this.#web);
    for (const name of Object.values(kinds)) this[name] = this.#c[`zp_web_${name}`](this.#web);
  }

  /** Has the scenario, a network, waveforms or controllers that play from the start on, until a voltage is set? */
  get plays() {
    return this.#c.zp_web_plays(this.#web) !== 0;
  }

  setVoltage(voltage) {
    this.#check(this.#c.zp_web_set_voltage(this.#web, voltage));
  }

  /** Run until `time`, s, or until the allowed time is over. => null, or the reason why the solver failed. */
  run(time) {
    return this.#c.zp_web_run(this.#web, time) === 0 ? null : this.#get();
  }

  /** Current value of a signal of signals.def. */
  signal(name) {
    this.#put(name);
    return this.#c.zp_web_signal(this.#web);
  }

  /** Current values of the signals in these columns, as a row: its mean current counts from the previous row. */
  read(columns) {
    const row = this.#doubles(this.#c.zp_web_read(this.#web), this.#columns.size);
    return columns.map((name) => row[this.#columns.get(name)]);
  }

  zipTime() {
    return this.#c.zp_web_zip_time(this.#web);
  }

  /** Numbers of a part, as `ofPart` names them. Valid until the next call. */
  part(kind, k) {
    return this.#doubles(this.#c[`zp_web_${kind}`](this.#web, k), ofPart[kind].length);
  }

  /** Pull at the load, or at body `body` of a network, with a force to the right and up, N. */
  pull({body, right, up}) {
    this.#check(this.#c.zp_web_pull(this.#web, body, right, up));
  }

  /** Insulator faces: x, y [members 2 nodes], upper and lower alternating; gap, lineForce [members nodes]; film and
   * pressure of the liquid [members nodes], empty if there is none, and wetLength [members halves], the length of each
   * modelled half that is wet. Valid until the next call. */
  shape() {
    const c = this.#c, web = this.#web, n = this.members * this.nodes, halves = this.members * Math.max(this.halves, 1);
    const x = c.zp_web_x(web), y = c.zp_web_y(web), gap = c.zp_web_gap(web), force = c.zp_web_line_force(web);
    const film = c.zp_web_film(web), pressure = c.zp_web_pressure(web), wet = c.zp_web_wet_length(web);
    return {
      x: this.#doubles(x, 2 * n),
      y: this.#doubles(y, 2 * n),
      gap: this.#doubles(gap, n),
      lineForce: this.#doubles(force, n),
      film: this.#doubles(film, film ? n : 0),
      pressure: this.#doubles(pressure, film ? n : 0),
      wetLength: this.#doubles(wet, film ? halves : 0),
    };
  }

  // -- studies

  /** Run the scenario in study `name` => its message, whether it completed, notes, the requested scalars, the columns of
   * its table, or those of `wanted`: names, or their ends, as ".opening_m" of each member. */
  study(name, scalars, wanted = null) {
    const c = this.#c, web = this.#web;
    this.#put(name);
    this.#check(c.zp_web_study(web));
    const message = this.#get(), good = c.zp_web_good(c.zp_web_outcome(web)) !== 0;
    const rows = c.zp_web_rows(web), columns = c.zp_web_columns(web);
    const table = this.#doubles(c.zp_web_table(web), rows * columns);
    const column = (k) => Float64Array.from({length: rows}, (_, row) => table[row * columns + k]);
    const names = Array.from({length: columns}, (_, k) => this.#string(c.zp_web_column(web, k)));
    const kept = names.flatMap((name, k) => (!wanted || wanted.some((end) => name === end || (end.startsWith('.') && name.endsWith(end))) ? [[name, column(k)]] : []));
    return {
      message,
      good,
      notes: Array.from({length: c.zp_web_notes(web)}, (_, k) => this.#string(c.zp_web_note(web, k))),
      scalars: Object.fromEntries(scalars.map((name) => {
        this.#put(name);
        return [name, c.zp_web_scalar(web)];
      })),
      columns: Object.fromEntries(kept),
    };
  }
}
