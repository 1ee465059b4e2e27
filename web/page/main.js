// The page: one scenario, one simulation that runs along, two studies that follow, and what a person does with them.
import wasm from '../build/zipact.wasm';
import {makePresets, Sliders, SlowMotion} from './controls.js';
import {Core, Refused} from './core.js';
import {Live} from './live.js';
import {fixed, pretty} from './numbers.js';
import * as scenario from './scenario.js';
import {Study} from './studies.js';
import {View} from './view.js';

const $ = (id) => document.getElementById(id);
const highest = 1e3 * scenario.sliders[0].max; // V, to which the states of rest are followed
const calm = matchMedia('(prefers-reduced-motion: reduce)').matches;
const module = new WebAssembly.Module(wasm);
const core = new Core(module);
const live = new Live(core);
const view = new View(core, live, highest);

// -- messages

let refusal = null; // of the last change, in the core's words

function showAlert() {
  const text = refusal ?? (live.failure && `The numerics ended: ${live.failure}. Change something to go on.`);
  $('alert').hidden = !text;
  if (text && $('alert').textContent !== text) $('alert').textContent = text;
}

/** For screen readers. */
function say(text) {
  $('status').textContent = text;
}

/** Do what the core may refuse. => was it done? */
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

// -- the voltage: three buttons, one of which holds

let pressed = 'release';
let held = 0; // V, of hold
let paused = false;

function voltage() {
  return {step: core.value('drive.voltage'), hold: held, release: 0}[pressed];
}

/** What keeps it closed with some reserve, V; NaN where that is not known. */
function holdingVoltage() {
  return Math.ceil((1.25 * view.release) / 10) * 10;
}

/** Step starts again from hanging, as the command does; hold and release change the voltage of what is. */
function press(button) {
  pressed = button;
  if (button === 'hold') held = holdingVoltage();
  guarded(() => (button === 'step' ? live.restart(voltage()) : live.switchTo(voltage())));
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
  $('hold').title = known ? 'A quarter more than the voltage at which it opens again' : 'There is no voltage at which it opens again';
}

function pause(now) {
  paused = now;
  $('pause').setAttribute('aria-pressed', String(now));
  $('pause').textContent = now ? 'Go on' : 'Pause';
}

// -- studies

const runStudy = new Study(module, 'actuate', ['zip_time_s'], (answer) => view.showRun(answer));
const restStudy = new Study(module, 'equilibrium', ['pull_in_voltage_V', 'release_voltage_V'], (answer) => {
  view.showRest(answer);
  showButtons();
});

function askStudies(values) {
  const all = values;
  runStudy.ask(all);
  restStudy.ask(new Map([...all, ['drive.voltage', `${highest} V`]]));
}

// -- the scenario

const given = scenario.fromAddress(location.hash);
let history = new scenario.History(scenario.beginning);

/** Make `values` the scenario of core, simulation and studies. If it is refused, that of history stays. */
function apply(values) {
  const done = guarded(() => {
    core.resolve(values);
    live.change(voltage());
  });
  if (done) askStudies(values);
  else core.resolve(history.present);
  show();
  return done;
}

/** Where `kind` is that of the change before, such as one drag of a slider, they are undone together. */
function change(values, kind = null) {
  if (!apply(values)) return false;
  history.add(values, kind);
  remember();
  return true;
}

function set(key, text, kind = null) {
  if (key === 'drive.voltage') pressed = 'step';
  return change(new Map([...history.present, [key, text]]), kind);
}

function show() {
  sliders.show();
  view.showLegend();
  showButtons();
  $('undo').disabled = !history.canUndo;
  $('redo').disabled = !history.canRedo;
  $('command').textContent = scenario.toCommand(core);
}

let writing = 0;

/** The address keeps the scenario. It is written when a drag is over, for browsers count such writes. */
function remember() {
  show();
  clearTimeout(writing);
  writing = setTimeout(() => window.history.replaceState(null, '', scenario.toAddress(history.present, slow.factor)), 200);
}

// -- frame by frame

const cost = {mean: 0, worst: 0}; // ms of work a frame
let before = performance.now(), described = -Infinity, wasZipped = false;

function announceZip() {
  const zipped = core.signal('contraction') > 0.99;
  if (zipped && !wasZipped) say(`Closed after ${fixed(1e3 * (live.time - live.zero), 1)} milliseconds`);
  if (!zipped && wasZipped) say('Opens again');
  wasZipped = zipped;
}

function work(passed) {
  if (!paused && !live.failure) live.advance(passed / slow.factor);
  showAlert();
  $('time-note').classList.toggle('due', runStudy.due);
  $('voltage-note').classList.toggle('due', restStudy.due);
  if (live.failure) return; // the last good instant stays in sight
  view.draw(calm);
  announceZip();
  slow.show(live.pace);
}

/** Once a second, what need not be at once. */
function describe() {
  view.describe();
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

// -- what a person does

const slow = new SlowMotion($('slow'), $('slow-value'), given.slow, remember);
const sliders = new Sliders($('sliders'), core, scenario.sliders, (key, text) => set(key, text, key), () => history.close());
makePresets($('presets'), scenario.presets, (values) => {
  if (change(new Map([...scenario.beginning, ...values]))) press('step');
});
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

for (const {name, help} of core.keys.values()) $('all-keys').append(new Option(help, `${name}=`));
$('controls').addEventListener('submit', (event) => {
  event.preventDefault();
  const [key, ...text] = $('any-key').value.split('=');
  if (set(key.trim(), text.join('=').trim())) $('any-key').value = '';
});
window.addEventListener('hashchange', () => change(scenario.fromAddress(location.hash).values));

/** Copy, and say so on the button. Where copying is forbidden, the text stands in the address or on the page. */
async function copy(button, text) {
  const words = button.textContent;
  const done = await navigator.clipboard?.writeText(text).then(() => true, () => false);
  button.textContent = done ? 'Copied' : 'Not allowed here';
  say(button.textContent);
  setTimeout(() => (button.textContent = words), 1500);
}
$('share').addEventListener('click', ({target}) => copy(target, location.href));
$('copy').addEventListener('click', ({target}) => copy(target, $('command').textContent));

// -- beginning: the scenario of the address; where that is refused, the page's own beside the refusal

core.resolve(scenario.beginning);
live.restart(0);
if (apply(given.values)) {
  history = new scenario.History(given.values);
  if (!calm) press('step');
} else {
  askStudies(scenario.beginning);
}
requestAnimationFrame(frame);
