// The view of the actuator: picture, numbers and plots of the current instant, and the results of the two studies.
import {geometryOf} from './geometry.js';
import {digits, fixed, pretty, Tiles} from './numbers.js';
import {Picture} from './picture.js';

const tiles = {
  voltage: {label: 'Voltage', unit: 'kV', title: 'voltage between the electrodes'},
  stroke: {label: 'Stroke', unit: 'mm', title: 'height of the clip over the lower platform'},
  opening: {label: 'Opening', unit: 'mm', title: 'distance of the platforms’ faces'},
  contraction: {label: 'Contraction', unit: '%', title: '1 − opening / (opening when hanging without voltage)'},
  zipped: {label: 'Zipped', unit: 'mm', title: 'closed length of one half, from the clip'},
  force: {label: 'Attraction', unit: 'N', title: 'electric attraction of the ribbons, vertical'},
  field: {label: 'Largest field', unit: 'MV/m', title: 'largest field in the liquid; with electro.breakdown_cap at most its breakdown field'},
  inside: {label: 'Insulator field', unit: 'MV/m', title: 'largest field in the insulators'},
  capacitance: {label: 'Capacitance', unit: 'pF', title: 'capacitance of the electrodes'},
  bent: {label: 'Stress', unit: 'MPa', title: 'largest stress of the metal, from bending and tension'},
  time: {label: 'Time', unit: 'ms', title: 'simulated time since the last button was pressed'},
  zip: {label: 'Zip time', unit: 'ms', title: 'from hanging to 99 % contraction at the voltage of Step', study: 'run'},
  closed: {label: 'Stays closed from', unit: 'ms', title: 'the contraction stays at or above 99 % from then to the end of the run; a dash if it ends open', study: 'run'},
  stress: {label: 'Largest stress', unit: 'MPa', title: 'largest stress of the metal from hanging to closed, at the voltage of Step', study: 'run'},
  yields: {label: 'Yield margin', unit: '', title: 'ribbon.yield_stress over the largest stress: below 1 the metal bends permanently', study: 'run'},
  breaks: {label: 'Breakdown margin', unit: '', title: 'insulator.breakdown_field over the field in the insulators at the voltage of Step: below 1 they break down', study: 'run'},
  allowed: {label: 'Allowed voltage', unit: 'kV', title: 'voltage at which the breakdown margin is 1', study: 'run'},
  pullin: {label: 'Pull-in', unit: 'kV', title: 'voltage at which the actuator pulls in as the voltage rises slowly', study: 'rest'},
  letgo: {label: 'Opens at', unit: 'kV', title: 'voltage at which the actuator opens again as the voltage falls slowly', study: 'rest'},
};

const $ = (id) => document.getElementById(id);

/** Sentences as items of a list. */
function list(place, sentences) {
  place.replaceChildren(...sentences.map((words) => {
    const item = document.createElement('li');
    item.textContent = words;
    return item;
  }));
}
/** Text for liquid.model beside the picture. */
const wetWords = {bead: 'a bead of oil at each clip, air beyond', submerged: 'in a bath of oil'};
/** Of a table: the openings of the members of a network, or the stroke. */
function curvesOf(columns) {
  const openings = Object.entries(columns).filter(([name]) => name.endsWith('.opening_m')).map(([, column]) => column);
  return openings.length ? openings : [columns.stroke_m];
}

const mostNamed = 12; // parts in a legend
const ofNetwork = ['stroke', 'opening', 'contraction', 'zipped']; // tiles that a network has no single number for
const largest = (values) => values.reduce((a, b) => Math.max(a, b), 0);

export class View {
  release = NaN; // V, where it opens again
  pull = null; // the force with which the pointer pulls at a load: {body, right, up}, N
  #time; // what the plots show
  #rest;
  #profile = {length: 1, force: new Float64Array(2), field: new Float64Array(2), largest: 1};
  #current; // trace
  #voltages = {live: {time: [], of: []}, run: null, label: 'voltage / kV', factor: 1e-3, least: 1}; // of the members of a network
  #bodies = {live: {time: [], of: []}, run: null, label: '', factor: 1, least: 1e-3};
  #chart; // volts, y, and the scenario's voltage and mass
  #liquid = {length: 1, film: new Float64Array(2), pressure: new Float64Array(2)};
  #notes = [];
  #notice = null;
  #plots = [];
  #next = 0; // plot to draw
  #styleOf; // of a curve
  #named = ''; // what the legends name

  /** `highest`: highest voltage of the equilibria, V; `chart`: {volts, y, fresh} of the design chart. */
  constructor(core, live, highest, chart) {
    this.core = core;
    this.live = live;
    this.picture = new Picture($('picture'));
    this.tiles = new Tiles($('numbers'), tiles);
    this.#time = {run: null, live: {time: [], of: []}, label: '', factor: 1e3, least: 1e-3};
    this.#rest = {rest: null, highest, live: {of: []}, label: '', now: 0};
    this.#current = {trace: live.trace};
    this.#chart = {volts: chart.volts, y: chart.y, fresh: (k) => chart.fresh(k), voltage: 0, mass: 0};
  }

  /** One plot per task: each draws its axes at once. Loading their library is a separate task. */
  async makePlots(breath) {
    await breath();
    const plots = await import('./plots.js');
    this.#styleOf = plots.styleOf;
    const all = [
      [plots.timePlot, 'time', this.#time],
      [plots.voltagePlot, 'voltage', this.#rest],
      [plots.chartPlot, 'chart', this.#chart],
      [plots.profilePlot, 'profile', this.#profile],
      [plots.currentPlot, 'current', this.#current],
      [plots.liquidPlot, 'liquid', this.#liquid],
      [plots.timePlot, 'voltages', this.#voltages],
      [plots.timePlot, 'bodies', this.#bodies],
    ];
    for (const [make, place, data] of all) {
      await breath();
      this.#plots.push(make($(`plot-${place}`), data));
    }
  }

  /** `words`: a note that applies as long as the page is open. */
  notice(words) {
    if (words === this.#notice) return;
    this.#notice = words;
    this.#showNotes();
  }

  #showNotes() {
    list($('notes'), this.#notice ? [this.#notice, ...this.#notes] : this.#notes);
  }

  /** The answer of study actuate, with its message `words`. */
  showRun({result}, words) {
    const columns = result?.columns;
    this.#time.run = columns ? {time: columns.time_s, of: curvesOf(columns)} : null;
    const scalars = result?.scalars ?? {};
    this.tiles.show('zip', digits(1e3 * (scalars.zip_time_s ?? NaN)));
    this.tiles.show('closed', digits(1e3 * (scalars.closed_from_s ?? NaN)));
    this.tiles.show('stress', digits((scalars.max_stress_Pa ?? NaN) / 1e6));
    this.tiles.show('yields', digits(scalars.yield_margin ?? NaN));
    this.tiles.show('breaks', digits(scalars.breakdown_margin ?? NaN));
    this.tiles.show('allowed', digits((scalars.allowed_voltage_V ?? NaN) / 1e3));
    $('time-note').textContent = words;
    this.#notes = result?.notes ?? [];
    this.#showNotes();
  }

  /** The answer of study equilibrium, with its message `words`. Its notes refer to the highest voltage of its plot. */
  showRest({result}, words) {
    const columns = result?.columns;
    this.#rest.rest = columns
      ? {voltage: columns.voltage_V, of: curvesOf(columns), stable: columns.stable, branch: columns.branch}
      : null;
    this.release = result?.scalars.release_voltage_V ?? NaN;
    this.tiles.show('pullin', digits((result?.scalars.pull_in_voltage_V ?? NaN) / 1e3));
    this.tiles.show('letgo', digits(this.release / 1e3));
    $('voltage-note').textContent = words;
    list($('voltage-notes'), (result?.notes ?? []).map((words) => `up to ${this.#rest.highest / 1e3} kV: ${words}`));
  }

  /** Which results belong to an older scenario, until the answers arrive: of the run, of the equilibria, of the chart. */
  showDue(due) {
    for (const [study, note] of [['run', 'time'], ['rest', 'voltage'], ['chart', 'chart']]) {
      this.tiles.setDue(study, due[study]);
      $(`${note}-note`).classList.toggle('due', due[study]);
    }
  }

  /** The legend of the field's colours. */
  showLegend() {
    const strongest = this.core.value('medium.breakdown_field') / 1e6;
    $('legend-middle').textContent = `${strongest / 4}`; // half way, because shades follow the square root
    $('legend-end').textContent = `${strongest} MV/m`;
  }

  /** The point of the scenario in the design chart. */
  showChart() {
    this.#chart.voltage = this.core.value('drive.voltage');
    this.#chart.mass = this.core.value('load.mass');
    const most = digits(1e3 * Math.max(...this.#chart.y.filter((v) => v > 0)));
    $('plot-chart').setAttribute('aria-label', `Largest load that closes over voltage: up to ${most} grams at ${this.#chart.volts.at(-1) / 1e3} kilovolts`);
  }

  /** Show the newest frame. `still`: only the actuator moves, not the view. */
  draw(still) {
    const {frame} = this.live, scene = this.#scene(frame);
    this.picture.draw(scene, still);
    const {trace, parts} = this.live, {network} = scene.geometry, {time} = network ? parts : trace;
    this.#time.live = this.#rest.live = {time, of: network ? parts.openings : [trace.stroke]};
    Object.assign(this.#voltages.live, {time, of: parts.voltages});
    Object.assign(this.#bodies.live, {time, of: parts.bodies});
    this.#current.trace = trace;
    this.#rest.now = frame.get('voltage');
    this.#plots[this.#next++ % this.#plots.length].update(); // one plot a frame: each 20 times a second
    this.#numbers(frame, scene);
  }

  /** The word of the liquid's model. */
  #liquidWord(frame) {
    return this.core.keys.get('liquid.model').choices[frame.get('liquid')].word;
  }

  /** Texts of the picture. */
  #texts(frame, geometry, word) {
    const parallel = frame.get('stack.parallel'), many = geometry.members.length > 1 && !geometry.joined && !geometry.opposed && !geometry.network;
    const pouches = geometry.focus.along ? frame.get('pouch.count') : 0;
    const unseen = parallel > 1 && geometry.columns === 1 ? `one of ${parallel} side by side` : pouches > 1 ? `one of ${pouches} pouches in a row` : null;
    return {
      masses: new Map(geometry.loads.map(({body, mass}) => [body, (geometry.network ? `body ${body}, ` : '') + pretty(this.core.print('load.mass', mass))])),
      voltages: geometry.members.map(({voltage}, k) => `${k + 1}: ${fixed(voltage / 1e3, 2)} kV`),
      pull: this.pull ? `${fixed(1e3 * Math.hypot(this.pull.right, this.pull.up), 0)} mN` : '',
      opening: `${fixed(1e3 * frame.get('opening'), 1)} mm`,
      wet: word !== 'none',
      where: [geometry.focus.along ? 'liquid within, air outside' : wetWords[word], unseen].filter(Boolean),
      front: many ? 'lowest zip front' : geometry.network ? 'zip front of member 1' : 'zip front',
    };
  }

  #scene(frame) {
    const strongest = frame.get('medium.breakdown_field'), word = this.#liquidWord(frame);
    const geometry = geometryOf(frame, word === 'bead'), [{length, field, lineForce, film, pressure}] = geometry.focus.halves;
    Object.assign(this.#liquid, {length, film, pressure});
    $('of-liquid').hidden = word === 'none';
    this.#showParts(frame, geometry);
    Object.assign(this.#profile, {length, field, force: lineForce, largest: strongest});
    return {
      geometry,
      texts: this.#texts(frame, geometry, word),
      opening: frame.get('opening'),
      bath: word === 'submerged' && !geometry.focus.along,
      largest: strongest,
      pull: this.pull,
      hanging: frame.get('opening') / (1 - frame.get('contraction')), // by the definition of the contraction
    };
  }

  /** What the plots show of a network, which has no single stroke or load, and their legends. */
  #showParts(frame, {network, members, bodies}) {
    const {inPlane} = frame, word = network ? 'opening' : 'stroke', named = JSON.stringify([network && members.length, bodies.map(({body}) => body), inPlane]);
    if (named === this.#named) return;
    this.#named = named;
    $('plots').classList.toggle('network', network);
    $('of-chart').hidden = network;
    $('of-voltages').hidden = $('of-bodies').hidden = !network;
    $('time-title').textContent = network ? 'Openings over time' : 'Stroke over time';
    $('voltage-title').textContent = network ? 'Openings over voltage' : 'Stroke over voltage';
    $('bodies-title').textContent = inPlane ? 'Angles of the bodies' : 'Heights of the bodies';
    $('profile-title').textContent = network ? 'Along the ribbon of member 1, now' : 'Along the ribbon, now';
    $('liquid-title').textContent = network ? 'The liquid of member 1, now' : 'The liquid, now';
    $('electrodes').textContent = network ? 'electrodes of member 1' : 'electrodes';
    this.#time.label = this.#rest.label = `${word} / mm`;
    Object.assign(this.#bodies, inPlane ? {label: 'angle / degree', factor: 180 / Math.PI, least: 0.1} : {label: 'height / mm', factor: 1e3, least: 1e-3});
    for (const name of ofNetwork) this.tiles.hide(name, network);
    const of = {member: network ? members.map((_, k) => k + 1) : [], body: network ? bodies.map(({body}) => body) : []};
    for (const [place, kind] of [['plot-time', 'member'], ['plot-voltages', 'member'], ['plot-bodies', 'body']])
      this.#legend($(place).parentElement.querySelector('.parts'), of[kind].map((number) => `${kind} ${number}`));
  }

  #legend(place, words) {
    list(place, words.length > mostNamed ? [...words.slice(0, mostNamed), `and ${words.length - mostNamed} more`] : words);
    [...place.children].forEach((item, k) => {
      const {colour, dash} = this.#styleOf(k, words.length > 1);
      item.style.setProperty('--part', `var(--${colour})`);
      if (k < mostNamed) item.classList.add(`dash-${dash ? [0, 7, 2].indexOf(dash[0] ?? 0) : 0}`);
      else item.classList.add('more');
    });
  }

  #numbers(frame, {geometry, opening}) {
    const {tiles: shown} = this, fields = geometry.members.flatMap(({halves}) => halves.map(({field}) => largest(field)));
    shown.show('voltage', fixed(frame.get('voltage') / 1e3, 2));
    shown.show('stroke', fixed(1e3 * frame.get('stroke'), 2));
    shown.show('opening', fixed(1e3 * opening, 2));
    shown.show('contraction', fixed(100 * frame.get('contraction'), 1));
    shown.show('zipped', fixed(1e3 * frame.get('zipped_length'), 1));
    shown.show('force', fixed(frame.get('force'), 2));
    shown.show('field', fixed(largest(fields) / 1e6, 1));
    shown.show('inside', fixed(frame.get('insulator_field') / 1e6, 1));
    shown.show('bent', fixed(frame.get('max_stress') / 1e6, 0));
    shown.show('capacitance', fixed(1e12 * frame.get('capacitance'), 0));
    shown.show('time', fixed(1e3 * frame.get('since'), 1));
  }

  /** The same in words, for screen readers. */
  describe() {
    const {frame} = this.live;
    const {openings, voltages, bodies} = this.live.parts, {inPlane} = frame;
    const now = (of, factor, places) => of.map((values, k) => `${k + 1}: ${fixed(factor * values.at(-1), places)}`).join(', '), at = now(openings, 1e3, 1);
    $('plot-voltages').setAttribute('aria-label', `Voltages of the members over time, now ${now(voltages, 1e-3, 2)} kilovolts`);
    $('plot-bodies').setAttribute('aria-label', inPlane ? `Angles of the bodies over time, now ${now(bodies, 180 / Math.PI, 2)} degrees`
      : `Heights of the bodies over time, now ${now(bodies, 1e3, 1)} millimetres`);
    if (frame.get('bodies') > 0)
      $('picture').setAttribute('aria-label', `A network of ${openings.length} actuators, open by ${at} millimetres`);
    else $('picture').setAttribute('aria-label', `Two ribbons, ${fixed(1e3 * frame.get('opening'), 1)} millimetres open, ` +
      `${fixed(1e3 * frame.get('zipped_length'), 1)} millimetres of each half zipped, at ${fixed(frame.get('voltage') / 1e3, 2)} kilovolts`);
    const film = frame.get('film_thickness'), current = this.live.trace.current.at(-1) ?? NaN;
    $('plot-current').setAttribute('aria-label', `Current of the source over time, now ${fixed(1e6 * current, 1)} microamperes; voltage of the electrodes and command`);
    $('plot-liquid').setAttribute('aria-label', 'Pressure and thickness of the liquid between the faces along the ribbon; ' +
      (film > 0 ? `a film of ${digits(1e6 * film)} micrometres at a quarter of the length` : 'none at a quarter of the length'));
    $('plot-time').setAttribute('aria-label', `${$('time-title').textContent}${openings.length ? `, now ${at} millimetres` : ''}. ${$('time-note').textContent}`);
    $('plot-voltage').setAttribute('aria-label', `${$('voltage-title').textContent}, all equilibria. ${$('voltage-note').textContent}`);
  }
}
