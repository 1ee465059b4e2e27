// The page: one scenario, one simulation that runs along, two studies that follow, and what is seen of them.
import wasm from '../build/zipact.wasm';
import {makePresets, Sliders, SlowMotion} from './controls.js';
import {Core, Refused} from './core.js';
import {Live} from './live.js';
import {digits, fixed, pretty, Tiles} from './numbers.js';
import {Picture} from './picture.js';
import {profilePlot, timePlot, voltagePlot} from './plots.js';
import * as scenario from './scenario.js';
import {Study} from './studies.js';
import './theme.js';

const $ = (id) => document.getElementById(id);
const module = new WebAssembly.Module(wasm);
const core = new Core(module);
const live = new Live(core);
const picture = new Picture($('picture'));
const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
const highest = 1e3 * scenario.sliders[0].max; // V, to which the states of rest are followed

// -- what is known besides the simulation: the answers of the studies

const run = {time: null, zipTime: NaN, hanging: NaN};
const rest = {release: NaN, pullIn: NaN};
const seen = {run: null, trace: live.trace}; // of the plots
const states = {rest: null, highest, now: {voltage: 0, stroke: 0}};
const profile = {length: 1, force: new Float64Array(2), field: new Float64Array(2), largest: 1};

const tiles = new Tiles($('numbers'), {
  voltage: {label: 'Voltage', unit: 'kV', title: 'between the electrodes, now'},
  stroke: {label: 'Stroke', unit: 'mm', title: 'height of the clip over the lower platform'},
  opening: {label: 'Opening', unit: 'mm', title: 'distance of the platforms’ faces'},
  contraction: {label: 'Contraction', unit: '%', title: '1 − opening / opening when hanging without voltage'},
  zipped: {label: 'Zipped', unit: 'mm', title: 'closed length from the clip, one half'},
  force: {label: 'Attraction', unit: 'N', title: 'electric attraction of the ribbons, vertical'},
  field: {label: 'Largest field', unit: 'MV/m', title: 'in the liquid; never more than its breakdown field where electro.breakdown_cap is true'},
  capacitance: {label: 'Capacitance', unit: 'pF', title: 'of the electrodes'},
  time: {label: 'Time', unit: 'ms', title: 'simulated, since the last button'},
  zip: {label: 'Zip time', unit: 'ms', title: 'from hanging to 99 % contraction at this voltage; without the drag of the liquid, so no prediction', study: true},
  pullin: {label: 'Pull-in', unit: 'kV', title: 'voltage at which it zips, raised slowly', study: true},
  letgo: {label: 'Lets go', unit: 'kV', title: 'voltage at which it opens again, lowered slowly', study: true},
});

// -- the voltage

let mode = 'release'; // the button that holds
let held = 0; // V, of hold

function targetVoltage() {
  return {step: core.value('drive.voltage'), hold: held, release: 0}[mode];
}

/** What keeps it closed with some reserve, V; NaN where that is not known. */
function holdingVoltage() {
  return Math.ceil((1.25 * rest.release) / 10) * 10;
}

function press(button) {
  mode = button;
  if (mode === 'hold') held = holdingVoltage();
  guarded(() => (mode === 'step' ? live.restart(targetVoltage()) : live.switchTo(targetVoltage())));
  say(`${$(button).firstChild.textContent}: ${fixed(targetVoltage() / 1e3, 2)} kV`);
  wasZipped = false;
  if (paused && mode === 'step') pause(false);
  showButtons();
}

function showButtons() {
  for (const button of ['step', 'hold', 'release']) $(button).setAttribute('aria-pressed', String(mode === button));
  $('step').lastChild.textContent = pretty(core.print('drive.voltage', core.value('drive.voltage')));
  const known = Number.isFinite(rest.release);
  $('hold').disabled = !known;
  $('hold').lastChild.textContent = known ? `${fixed((mode === 'hold' ? held : holdingVoltage()) / 1e3, 2)} kV` : '–';
  $('hold').title = known ? 'A quarter more than the voltage at which it lets go' : 'There is no voltage at which it lets go';
}

let paused = false;

function pause(now) {
  paused = now;
  $('pause').setAttribute('aria-pressed', String(now));
  $('pause').textContent = now ? 'Go on' : 'Pause';
}

// -- messages

let refusal = null;

function showAlert() {
  const text = refusal ?? (live.failure && `The numerics ended: ${live.failure}. Change something to go on.`);
  $('alert').hidden = !text;
  if (text && $('alert').textContent !== text) $('alert').textContent = text;
}

function say(text) {
  $('status').textContent = text;
}

/** Do what the core may refuse, and say so in its words. => was it done? */
function guarded(action) {
  try {
    action();
    refusal = null;
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    refusal = error.message;
  }
  showAlert();
  return refusal === null;
}

// -- the scenario

let history = null;

/** Make `values` the scenario of core, simulation, studies and form; false if it is refused. */
function apply(values) {
  const before = history?.present;
  const done = guarded(() => {
    core.resolve(scenario.assignments(values));
    live.change(targetVoltage());
  });
  if (!done && before) core.resolve(scenario.assignments(before));
  show();
  if (done) askStudies(values);
  return done;
}

function change(values, kind = null) {
  if (!apply(values)) return false;
  history.add(values, kind);
  remember();
  return true;
}

function set(key, text, kind = null) {
  if (key === 'drive.voltage' && mode !== 'step') mode = 'step';
  return change(new Map([...history.present, [key, text]]), kind);
}

function show() {
  sliders.show();
  const strongest = core.value('medium.breakdown_field') / 1e6;
  $('legend-middle').textContent = String(strongest / 4);
  $('legend-end').textContent = `${strongest} MV/m`;
  showButtons();
  $('undo').disabled = !history?.canUndo;
  $('redo').disabled = !history?.canRedo;
  $('command').textContent = scenario.toCommand(core);
}

/** The address keeps the scenario; it is written when a drag is over, for browsers count such writes. */
function remember() {
  show();
  clearTimeout(remember.timer);
  remember.timer = setTimeout(() => {
    const slowly = slow.factor === 10 ? [] : [`slow=${slow.factor}`];
    window.history.replaceState(null, '', `#${[scenario.toAddress(history.present), ...slowly].join('&')}`);
  }, 200);
}

// -- studies

const runStudy = new Study(module, 'actuate', ['zip_time_s'], ({result, refused}) => {
  if (result) {
    seen.run = {time: result.columns.time_s, stroke: result.columns.stroke_m};
    run.zipTime = result.scalars.zip_time_s;
    run.hanging = result.columns.opening_m[0];
  } else {
    seen.run = null;
    run.zipTime = run.hanging = NaN;
  }
  $('time-note').textContent = refused ?? result.message;
  $('warnings').replaceChildren(...(result?.warnings ?? []).map((words) => {
    const item = document.createElement('li');
    item.textContent = words;
    return item;
  }));
  tiles.show('zip', digits(1e3 * run.zipTime));
});

const restStudy = new Study(module, 'equilibrium', ['pull_in_voltage_V', 'release_voltage_V'], ({result, refused}) => {
  const columns = result?.columns;
  states.rest = columns && {voltage: columns.voltage_V, stroke: columns.stroke_m, stable: columns.stable, branch: columns.branch};
  rest.pullIn = result?.scalars.pull_in_voltage_V ?? NaN;
  rest.release = result?.scalars.release_voltage_V ?? NaN;
  $('voltage-note').textContent = refused ?? result.message;
  tiles.show('pullin', digits(rest.pullIn / 1e3));
  tiles.show('letgo', digits(rest.release / 1e3));
  showButtons();
});

function askStudies(values) {
  const all = scenario.assignments(values);
  runStudy.ask(all);
  restStudy.ask(new Map([...all, ['drive.voltage', `${highest} V`]]));
}

// -- what is seen, frame by frame

/** Field in the liquid at each station by the plates law, V/m. */
function fieldOf(gap) {
  const voltage = core.value('electro.voltage_share') * live.voltage, offset = core.insulatorOffset;
  const most = core.value('electro.breakdown_cap') ? core.value('medium.breakdown_field') : Infinity;
  return Float64Array.from(gap, (g) => Math.min(voltage / (Math.max(g, 0) + offset), most));
}

function scene() {
  const shape = core.shape(), nodes = core.nodes, platform = core.value('platform.length');
  const length = (core.value('ribbon.length') - platform) / 2;
  const field = fieldOf(shape.gap), opening = core.signal('opening'), mass = core.value('load.mass');
  Object.assign(profile, {length, field, force: Float64Array.from(shape.lineForce), largest: core.value('medium.breakdown_field')});
  return {
    shape: core.shape(), nodes, field, platform, opening, mass,
    centre: length + platform / 2,
    largest: profile.largest,
    electrode: core.value('platform.electrode') !== 0,
    metal: core.value('ribbon.thickness'),
    insulator: core.value('insulator.thickness'),
    hanging: run.hanging,
    texts: {mass: pretty(core.print('load.mass', mass)), opening: `${fixed(1e3 * opening, 1)} mm`},
  };
}

let wasZipped = false;

function showNumbers(now) {
  const {field, opening} = now, contraction = core.signal('contraction');
  tiles.show('voltage', fixed(live.voltage / 1e3, 2));
  tiles.show('stroke', fixed(1e3 * core.signal('stroke'), 2));
  tiles.show('opening', fixed(1e3 * opening, 2));
  tiles.show('contraction', fixed(100 * contraction, 1));
  tiles.show('zipped', fixed(1e3 * core.signal('zipped_length'), 1));
  tiles.show('force', fixed(core.signal('force'), 2));
  tiles.show('field', fixed(field.reduce((a, b) => Math.max(a, b), 0) / 1e6, 1));
  tiles.show('capacitance', fixed(1e12 * core.signal('capacitance'), 0));
  tiles.show('time', fixed(1e3 * (live.time - live.zero), 1));
  const zipped = contraction > 0.99;
  if (zipped && !wasZipped) say(`Closed after ${fixed(1e3 * (live.time - live.zero), 1)} milliseconds`);
  if (!zipped && wasZipped) say('Opens again');
  wasZipped = zipped;
}

const plots = [];
const cost = {mean: 0, worst: 0}; // ms of work a frame

function describePicture({opening}) {
  const text = `Two ribbons, ${fixed(1e3 * opening, 1)} millimetres open, ` +
    `${fixed(1e3 * core.signal('zipped_length'), 1)} millimetres of each half zipped, at ${fixed(live.voltage / 1e3, 2)} kilovolts`;
  $('picture').setAttribute('aria-label', text);
  $('plot-time').setAttribute('aria-label', `Stroke over time. ${$('time-note').textContent}`);
  $('plot-voltage').setAttribute('aria-label', `Stroke over voltage, all states of rest. ${$('voltage-note').textContent}`);
  $('plot-profile').setAttribute('aria-label', 'Attraction per length and field in the liquid along the ribbon');
  $('frame').textContent = `A frame takes ${fixed(cost.mean, 1)} ms, ${fixed(cost.worst, 1)} ms at most.`;
  cost.worst = 0;
}

let before = performance.now(), described = 0, count = 0;

function frame(now) {
  const begin = performance.now(), passed = Math.min((now - before) / 1e3, 1 / 30);
  before = now;
  if (!paused && !live.failure) live.advance(passed / slow.factor);
  showAlert();
  const picked = scene();
  picture.draw(picked, calm);
  seen.trace = live.trace;
  states.now = {voltage: live.voltage, stroke: core.signal('stroke')};
  plots[count++ % plots.length].update(); // one plot a frame: each 20 times a second
  showNumbers(picked);
  slow.show(live.pace);
  $('time-note').classList.toggle('due', runStudy.due);
  $('voltage-note').classList.toggle('due', restStudy.due);
  const spent = performance.now() - begin;
  cost.mean += 0.05 * (spent - cost.mean);
  cost.worst = Math.max(cost.worst, spent);
  document.documentElement.dataset.frame = spent;
  if (now - described > 1000) {
    described = now;
    describePicture(picked);
  }
  requestAnimationFrame(frame);
}

// -- beginning

function read(address) {
  const values = scenario.fromAddress(address), factor = Number(values.get('slow') ?? 10);
  values.delete('slow');
  return {values: values.size ? values : scenario.beginning, factor};
}

const given = read(location.hash);
const slow = new SlowMotion($('slow'), $('slow-value'), given.factor, remember);
const sliders = new Sliders($('sliders'), core, scenario.sliders, (key, text) => set(key, text, key), () => history.close());
makePresets($('presets'), scenario.presets, (values) => {
  if (change(new Map([...scenario.beginning, ...values]))) press('step');
});

/** The scenario of the address; where that is refused, the page's own beside the refusal. */
function begin() {
  core.resolve(scenario.assignments(scenario.beginning));
  live.restart(0);
  const taken = apply(given.values), why = refusal;
  if (!taken) apply(scenario.beginning);
  refusal = why;
  history = new scenario.History(taken ? given.values : scenario.beginning);
  show();
  showAlert();
}

for (const button of ['step', 'hold', 'release']) $(button).addEventListener('click', () => press(button));
$('pause').addEventListener('click', () => pause(!paused));
const undo = () => apply(history.undo()) && remember();
const redo = () => apply(history.redo()) && remember();
$('undo').addEventListener('click', undo);
$('redo').addEventListener('click', redo);
document.addEventListener('keydown', (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== 'z' || event.target.id === 'any-key') return;
  event.preventDefault();
  (event.shiftKey ? redo : undo)();
});

/** Copy, and say so on the button; the scenario stands in the address and on the page, too, where copying is forbidden. */
async function copy(button, text) {
  const words = button.textContent;
  const done = await navigator.clipboard?.writeText(text).then(() => true, () => false);
  button.textContent = done ? 'Copied' : 'Not allowed here';
  say(button.textContent);
  setTimeout(() => (button.textContent = words), 1500);
}
$('share').addEventListener('click', ({target}) => copy(target, location.href));
$('copy').addEventListener('click', ({target}) => copy(target, $('command').textContent));

for (const name of core.keys.keys()) $('all-keys').append(new Option(core.keys.get(name).help, `${name}=`));
$('controls').addEventListener('submit', (event) => {
  event.preventDefault();
  const [key, ...rest] = $('any-key').value.split('=');
  if (set(key.trim(), rest.join('=').trim())) $('any-key').value = '';
});
window.addEventListener('hashchange', () => change(read(location.hash).values));

begin();
plots.push(timePlot($('plot-time'), seen), voltagePlot($('plot-voltage'), states), profilePlot($('plot-profile'), profile));
if (!calm && !refusal) press('step');
requestAnimationFrame(frame);
