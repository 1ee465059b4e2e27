// The page: one scenario, a running simulation of it, two studies that follow its changes, and the controls.
import wasm from '../build/zipact.wasm';
import {Choice, makePresets, Sliders, SlowMotion} from './controls.js';
import {Core, Refused} from './core.js';
import {Live} from './live.js';
import {fixed, pretty} from './numbers.js';
import {Remote} from './remote.js';
import * as scenario from './scenario.js';
import {Chart, Study} from './studies.js';
import {Tour} from './tour.js';
import {View} from './view.js';

const $ = (id) => document.getElementById(id);
const highest = 1e3 * scenario.sliders[0].max; // V, highest voltage of the equilibria
const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;

/** The page starts in short tasks, between which the browser responds to the user. */
const breath = () => new Promise((done) => setTimeout(done));

const module = await WebAssembly.compile(wasm); // in another thread
const core = new Core(module); // of the scenario; engines compute with it
const live = new Live(module);
const volts = Array.from({length: 11}, (_, k) => highest * (k + 1.2) / 11.2); // of the design chart
const chart = new Chart(module, 'limits', 'max_load_kg', volts, () => view.showChart());
const view = new View(core, live, highest, chart);
await view.makePlots(breath);

// -- messages

let refusal = null; // of the last change: the message of the core
let field = null; // the control of that change; null: the address

const broken = (words) => `The computation failed: ${words}. Please report it, with the link.`;

/** The reason why nothing moves; null if it does. */
function standstill() {
  if (!live.end) return null;
  const {failure, stopped, refused, broken: words} = live.end;
  if (failure) return `The solver failed: ${failure}. Change a value to continue.`;
  return refused ?? (stopped ? scenario.tooLong(core, stopped) : broken(words));
}

/** A refusal is shown beside its control, and the reason of a standstill above the picture. */
function showAlert() {
  const beside = refusal !== null && field !== null, text = beside ? standstill() : refusal ?? standstill();
  if (beside && $('refusal').previousElementSibling !== field) field.after($('refusal'));
  $('refusal').hidden = !beside;
  if (beside && $('refusal').textContent !== refusal) $('refusal').textContent = refusal;
  $('alert').hidden = !text;
  if (text && $('alert').textContent !== text) $('alert').textContent = text;
}

/** For screen readers. */
function say(text) {
  $('status').textContent = text;
}

/** Make `values` the scenario. If the core refuses them, the scenario is unchanged and the page shows the reason. => true if accepted */
function take(values) {
  try {
    core.resolve(values);
    refusal = null;
  } catch (error) {
    if (!(error instanceof Refused)) throw error;
    refusal = error.message;
  }
  showAlert();
  return refusal === null;
}

// -- the voltage: three buttons, one of which is active

let pressed = 'release';
let held = 0; // V, of hold
let paused = false;

function voltage() {
  return {step: core.value('drive.voltage'), hold: held, release: 0}[pressed];
}

/** A voltage that keeps it closed with some reserve, V; NaN if that is not known. */
function holdingVoltage() {
  return Math.ceil((1.25 * view.release) / 10) * 10;
}

/** Step starts again from hanging, as the command does; hold and release change the voltage of the current state. */
function press(button) {
  pressed = button;
  if (button === 'hold') held = holdingVoltage();
  refusal = null;
  if (button === 'step') live.restart(history.present, voltage());
  else live.switchTo(voltage());
  say(`${$(button).firstChild.textContent}: ${fixed(voltage() / 1e3, 2)} kilovolts`);
  pause(false);
  showButtons();
}

function showButtons() {
  const known = Number.isFinite(view.release);
  for (const button of ['step', 'hold', 'release']) $(button).setAttribute('aria-pressed', String(pressed === button));
  $('step').lastChild.textContent = pretty(core.print('drive.voltage', core.value('drive.voltage')));
  $('hold').disabled = !known;
  $('hold').lastChild.textContent = known ? `${fixed((pressed === 'hold' ? held : holdingVoltage()) / 1e3, 2)} kV` : '–';
  $('hold').title = known ? '25 % above the voltage at which it opens again' : 'There is no voltage at which it opens again';
}

function pause(now) {
  paused = now;
  $('pause').setAttribute('aria-pressed', String(now));
  $('pause').textContent = now ? 'Resume' : 'Pause';
}

// -- studies

/** The message of a study. */
function ending({result, refused, stopped, broken: words}) {
  if (words) return broken(words);
  return refused ?? (stopped ? scenario.tooLong(core, stopped) : result.message);
}

const runColumns = ['time_s', 'stroke_m', '.opening_m'], restColumns = ['voltage_V', 'stroke_m', 'stable', 'branch', '.opening_m'];
const runStudy = new Study(module, 'actuate', ['zip_time_s', 'closed_from_s', 'max_stress_Pa', 'yield_margin', 'breakdown_margin', 'allowed_voltage_V'], runColumns, (answer) => view.showRun(answer, ending(answer)));
const restStudy = new Study(module, 'equilibrium', ['pull_in_voltage_V', 'release_voltage_V'], restColumns, (answer) => {
  view.showRest(answer, ending(answer));
  showButtons();
});

const kept = [['output.samples', '1000'], ['output.shapes', '2']]; // the plots need only few samples and shapes

function askStudies(values) {
  runStudy.ask(new Map([...values, ...kept]));
  const rest = scenario.atRest(values);
  restStudy.ask(new Map([...rest, ...kept, ['drive.voltage', `${highest} V`]]));
  chart.ask(new Map([['mesh.nodes', '31'], ...rest, ...kept, ['output.errors', 'false']]));
}

// -- the scenario

const given = scenario.fromAddress(location.hash);
let history = new scenario.History(scenario.beginning);

/** Make `values` the scenario of core, simulation and studies, unless they are refused. */
function apply(values) {
  const done = take(values);
  if (done) {
    live.change(values, voltage());
    askStudies(values);
  }
  show();
  return done;
}

/** Changes of the same `kind` in a row, such as one drag of a slider, are undone together. */
function change(values, kind = null) {
  if (!apply(values)) return false;
  history.add(values, kind);
  remember();
  return true;
}

/** A change by the control in `row`: a refusal is shown beside it. */
function by(row, act) {
  field = row;
  const done = act();
  if (!done) show();
  return done;
}

const rowOf = (key) => $(key.replace('.', '-')).parentElement;

/** The name of a material, or a text for none. */
const materialWords = ({key}) => (core.value(key) === 0 ? 'the values of the other keys' : null);

function set(key, text, kind = null) {
  if (key === 'drive.voltage') pressed = 'step';
  return change(new Map([...history.present, [key, text]]), kind);
}

function show() {
  for (const list of sliders) list.show();
  liquidChoice.show();
  supplyChoice.show(scenario.supplyWords(core));
  for (const [i, choice] of materialChoices.entries()) choice.show(materialWords(scenario.materials[i]));
  view.showLegend();
  view.showChart();
  showButtons();
  $('undo').disabled = !history.canUndo;
  $('redo').disabled = !history.canRedo;
  $('command').textContent = scenario.toCommand(core);
}

let writing = 0;

/** The address contains the scenario. It is written at the end of a drag, because browsers limit such writes. */
function remember() {
  show();
  clearTimeout(writing);
  writing = setTimeout(() => window.history.replaceState(null, '', scenario.toAddress(history.present, slow.factor)), 200);
}

// -- frame by frame

const cost = {mean: 0, worst: 0}; // ms of work a frame
let before = performance.now(), described = -Infinity, wasZipped = false;

/** A ribbon that arrives with a swing may bounce off again: it is open only when it has left the closed state for good. */
function announceZip() {
  const contraction = live.frame.get('contraction'), zipped = contraction > (wasZipped ? 0.9 : 0.99);
  if (zipped && !wasZipped) say(`Closed after ${fixed(1e3 * live.frame.get('since'), 1)} milliseconds`);
  if (!zipped && wasZipped) say('Opens again');
  wasZipped = zipped;
}

function work(passed) {
  live.advance(paused ? 0 : passed / slow.factor);
  showAlert();
  view.showDue({run: runStudy.due, rest: restStudy.due, chart: chart.due});
  if (!live.frame) return;
  view.draw(calm);
  announceZip();
  slow.show(live.end ? 1 : live.pace);
}

/** Updates once per second. */
function describe() {
  if (live.frame) view.describe();
  if (Remote.local !== null) view.notice(`This browser does not start a worker for this page (${Remote.local}), so the page computes between frames, which is slower.`);
  $('frame').textContent = `A frame takes ${fixed(cost.mean, 1)} ms, ${fixed(cost.worst, 1)} ms at most.`;
  cost.worst = 0;
}

function frame(now) {
  const begin = performance.now();
  work(Math.min((now - before) / 1e3, 1 / 30));
  before = now;
  const spent = performance.now() - begin;
  cost.mean += 0.05 * (spent - cost.mean);
  cost.worst = Math.max(cost.worst, spent);
  document.documentElement.dataset.frame = spent; // for the tests
  if (now - described > 1000) {
    described = now;
    describe();
  }
  requestAnimationFrame(frame);
}

// -- controls

const slow = new SlowMotion($('slow'), $('slow-value'), given.slow, remember);
const liquidChoice = new Choice($('liquid'), core, scenario.liquidChoice, (word) => by(rowOf('liquid.model'), () => set('liquid.model', word)));
const supplyChoice = new Choice($('supply'), core, scenario.supplyChoice,
  (word) => by(rowOf('source.supply'), () => change(scenario.withSupply(core, history.present, word))));
const materialChoices = scenario.materials.map((spec) => new Choice($('materials'), core, spec,
  (word) => by(rowOf(spec.key), () => change(scenario.withMaterial(history.present, spec, word)))));
const sliders = [['sliders', scenario.sliders], ['liquid', scenario.liquidSliders], ['supply', scenario.supplySliders]]
  .map(([place, list]) => new Sliders($(place), core, list, (key, text) => by(rowOf(key), () => set(key, text, key)), () => history.close()));
makePresets($('presets'), scenario.presets, (values) => {
  if (change(new Map([...scenario.beginning, ...values]))) press('step');
});
for (const button of ['step', 'hold', 'release']) $(button).addEventListener('click', () => press(button));
$('pause').addEventListener('click', () => pause(!paused));

// -- the pointer pulls at a load

let grip = null;
const picture = $('picture');
const offset = (event) => [event.offsetX, event.offsetY];

function pullTo(force) {
  view.pull = force;
  live.pull(force);
}

function letGo() {
  if (!grip) return;
  pullTo(grip.pull(...grip.from));
  grip = view.pull = null;
}

picture.addEventListener('pointerdown', (event) => {
  const found = view.picture.grip(...offset(event));
  if (!found) return;
  event.preventDefault();
  grip = {...found, from: offset(event)};
  picture.setPointerCapture(event.pointerId);
});
picture.addEventListener('pointermove', (event) => {
  if (grip) pullTo(grip.pull(...offset(event)));
  else picture.classList.toggle('loaded', view.picture.grip(...offset(event)) !== null);
});
for (const kind of ['pointerup', 'pointercancel', 'lostpointercapture']) picture.addEventListener(kind, letGo);

const undo = () => apply(history.undo()) && remember();
const redo = () => apply(history.redo()) && remember();
$('undo').addEventListener('click', undo);
$('redo').addEventListener('click', redo);
document.addEventListener('keydown', (event) => {
  if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== 'z' || event.target.id === 'any-key') return;
  event.preventDefault();
  (event.shiftKey ? redo : undo)();
});

for (const {name, help} of core.keys.values()) $('all-keys').append(new Option(help, `${name}=`));
$('controls').addEventListener('submit', (event) => {
  event.preventDefault();
  const [key, ...text] = $('any-key').value.split('=');
  if (by($('any-key').parentElement, () => set(key.trim(), text.join('=').trim()))) $('any-key').value = '';
});
window.addEventListener('hashchange', () => {
  field = null;
  change(scenario.fromAddress(location.hash).values);
});
new Tour($('tour'), $('guide'), (values, button) => {
  field = null;
  if (change(new Map([...scenario.beginning, ...Object.entries(values)]))) press(button);
});

/** Copy, and confirm on the button. If copying is forbidden, the text is in the address or on the page. */
async function copy(button, text) {
  const words = button.textContent;
  const done = await navigator.clipboard?.writeText(text).then(() => true, () => false);
  button.textContent = done ? 'Copied' : 'Not allowed here';
  say(button.textContent);
  setTimeout(() => (button.textContent = words), 1500);
}
$('share').addEventListener('click', ({target}) => copy(target, location.href));
$('copy').addEventListener('click', ({target}) => copy(target, $('command').textContent));

// -- start: the scenario of the address; if it is refused, the default one with the message

await breath();
take(scenario.beginning);
live.restart(scenario.beginning, 0);
if (apply(given.values)) {
  history = new scenario.History(given.values);
  if (!calm) press('step');
} else {
  askStudies(scenario.beginning);
}
requestAnimationFrame(frame);
