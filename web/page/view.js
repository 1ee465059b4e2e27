// What is seen of the actuator: picture, numbers, plots; now, and what the two studies say of the whole scenario.
import {digits, fixed, pretty, Tiles} from './numbers.js';
import {Picture} from './picture.js';
import {profilePlot, timePlot, voltagePlot} from './plots.js';

const tiles = {
  voltage: {label: 'Voltage', unit: 'kV', title: 'between the electrodes, now'},
  stroke: {label: 'Stroke', unit: 'mm', title: 'height of the clip over the lower platform'},
  opening: {label: 'Opening', unit: 'mm', title: 'distance of the platforms’ faces'},
  contraction: {label: 'Contraction', unit: '%', title: '1 − opening / opening when hanging without voltage'},
  zipped: {label: 'Zipped', unit: 'mm', title: 'closed length from the clip, one half'},
  force: {label: 'Attraction', unit: 'N', title: 'electric attraction of the ribbons, vertical'},
  field: {label: 'Largest field', unit: 'MV/m', title: 'in the liquid; at most its breakdown field where electro.breakdown_cap is true'},
  capacitance: {label: 'Capacitance', unit: 'pF', title: 'of the electrodes'},
  time: {label: 'Time', unit: 'ms', title: 'simulated, since the last button'},
  zip: {label: 'Zip time', unit: 'ms', title: 'from hanging to 99 % contraction at the voltage of Step', study: true},
  pullin: {label: 'Pull-in', unit: 'kV', title: 'voltage at which it zips, raised slowly', study: true},
  letgo: {label: 'Opens at', unit: 'kV', title: 'voltage at which it opens again, lowered slowly', study: true},
};

const $ = (id) => document.getElementById(id);
const largest = (values) => values.reduce((a, b) => Math.max(a, b), 0);

export class View {
  hanging = NaN; // m, opening without voltage
  release = NaN; // V, where it opens again
  #time; // what the plots show
  #rest;
  #profile = {length: 1, force: new Float64Array(2), field: new Float64Array(2), largest: 1};
  #plots;
  #next = 0; // plot to draw

  /** `highest`: voltage to which the states of rest are followed, V. */
  constructor(core, live, highest) {
    this.core = core;
    this.live = live;
    this.picture = new Picture($('picture'));
    this.tiles = new Tiles($('numbers'), tiles);
    this.#time = {run: null, trace: live.trace};
    this.#rest = {rest: null, highest, now: {voltage: 0, stroke: 0}};
    this.#plots = [
      timePlot($('plot-time'), this.#time),
      voltagePlot($('plot-voltage'), this.#rest),
      profilePlot($('plot-profile'), this.#profile),
    ];
  }

  /** The answer of study actuate. */
  showRun({result, refused}) {
    const columns = result?.columns;
    this.#time.run = columns ? {time: columns.time_s, stroke: columns.stroke_m} : null;
    this.hanging = columns?.opening_m[0] ?? NaN;
    this.tiles.show('zip', digits(1e3 * (result?.scalars.zip_time_s ?? NaN)));
    $('time-note').textContent = refused ?? result.message;
    $('warnings').replaceChildren(...(result?.notes ?? []).map((words) => {
      const item = document.createElement('li');
      item.textContent = words;
      return item;
    }));
  }

  /** The answer of study equilibrium. */
  showRest({result, refused}) {
    const columns = result?.columns;
    this.#rest.rest = columns
      ? {voltage: columns.voltage_V, stroke: columns.stroke_m, stable: columns.stable, branch: columns.branch}
      : null;
    this.release = result?.scalars.release_voltage_V ?? NaN;
    this.tiles.show('pullin', digits((result?.scalars.pull_in_voltage_V ?? NaN) / 1e3));
    this.tiles.show('letgo', digits(this.release / 1e3));
    $('voltage-note').textContent = refused ?? result.message;
  }

  /** The legend of the field's colours. */
  showLegend() {
    const strongest = this.core.value('medium.breakdown_field') / 1e6;
    $('legend-middle').textContent = `${strongest / 4}`; // half way, for shades go by the square root
    $('legend-end').textContent = `${strongest} MV/m`;
  }

  /** The present instant. `still`: nothing moves but the actuator. */
  draw(still) {
    const scene = this.#scene();
    this.picture.draw(scene, still);
    this.#time.trace = this.live.trace;
    this.#rest.now = {voltage: this.live.voltage, stroke: this.core.signal('stroke')};
    this.#plots[this.#next++ % this.#plots.length].update(); // one plot a frame: each 20 times a second
    this.#numbers(scene);
  }

  /** Field in the liquid at each station by the plates law, V/m. */
  #field(gap) {
    const {core} = this, voltage = core.value('electro.voltage_share') * this.live.voltage;
    const most = core.value('electro.breakdown_cap') ? core.value('medium.breakdown_field') : Infinity;
    return Float64Array.from(gap, (g) => Math.min(voltage / (Math.max(g, 0) + core.insulatorOffset), most));
  }

  #scene() {
    const {core} = this, platform = core.value('platform.length'), length = (core.value('ribbon.length') - platform) / 2;
    const opening = core.signal('opening'), mass = core.value('load.mass'), strongest = core.value('medium.breakdown_field');
    const texts = {mass: pretty(core.print('load.mass', mass)), opening: `${fixed(1e3 * opening, 1)} mm`};
    const shape = core.shape(), field = this.#field(shape.gap);
    Object.assign(this.#profile, {length, field, force: Float64Array.from(shape.lineForce), largest: strongest});
    return {
      shape, field, platform, opening, mass, texts,
      nodes: core.nodes,
      centre: length + platform / 2,
      largest: strongest,
      electrode: core.value('platform.electrode') !== 0,
      metal: core.value('ribbon.thickness'),
      insulator: core.value('insulator.thickness'),
      hanging: this.hanging,
    };
  }

  #numbers({field, opening}) {
    const {core, live, tiles: shown} = this;
    shown.show('voltage', fixed(live.voltage / 1e3, 2));
    shown.show('stroke', fixed(1e3 * core.signal('stroke'), 2));
    shown.show('opening', fixed(1e3 * opening, 2));
    shown.show('contraction', fixed(100 * core.signal('contraction'), 1));
    shown.show('zipped', fixed(1e3 * core.signal('zipped_length'), 1));
    shown.show('force', fixed(core.signal('force'), 2));
    shown.show('field', fixed(largest(field) / 1e6, 1));
    shown.show('capacitance', fixed(1e12 * core.signal('capacitance'), 0));
    shown.show('time', fixed(1e3 * (live.time - live.zero), 1));
  }

  /** The same in words, for who does not see it. */
  describe() {
    const {core, live} = this;
    $('picture').setAttribute('aria-label', `Two ribbons, ${fixed(1e3 * core.signal('opening'), 1)} millimetres open, ` +
      `${fixed(1e3 * core.signal('zipped_length'), 1)} millimetres of each half zipped, at ${fixed(live.voltage / 1e3, 2)} kilovolts`);
    $('plot-time').setAttribute('aria-label', `Stroke over time. ${$('time-note').textContent}`);
    $('plot-voltage').setAttribute('aria-label', `Stroke over voltage, all states of rest. ${$('voltage-note').textContent}`);
    $('plot-profile').setAttribute('aria-label', 'Attraction per length and field in the liquid along the ribbon');
  }
}
