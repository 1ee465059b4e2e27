// Engines behind the page: one question at a time, in workers that the test speaks for, with a clock that it turns.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {register} from 'node:module';
import {test} from 'node:test';
import {Core} from '../page/core.js';
import {Engine, limits} from '../page/engine.js';
import {Frame, mostSamples, sampled, write} from '../page/frame.js';
import * as scenario from '../page/scenario.js';

const module = new WebAssembly.Module(readFileSync(new URL('../build/zipact.wasm', import.meta.url)));
const dry = [['liquid.model', 'none'], ['mesh.nodes', '9']];

const workers = [], looks = []; // all that were made; what looks at the clock
globalThis.Worker = class {
  asked = [];

  constructor() {
    workers.push(this);
  }

  postMessage(question) {
    if (!question.module) this.asked.push(question);
  }

  terminate() {
    this.ended = true;
  }

  say(data) {
    this.onmessage({data});
  }
};
globalThis.setInterval = (look) => looks.push(look);
const turn = (ms) => {
  for (let k = 0; k < ms / 250; k++) looks.at(-1)();
};

register(`data:text/javascript,${encodeURIComponent(`export const resolve = (name, context, next) =>
  name.startsWith('worker:') ? {url: 'data:text/javascript,export default ""', shortCircuit: true} : next(name, context);`)}`);
const {Remote} = await import('../page/remote.js');
const {Live} = await import('../page/live.js');
const {Study} = await import('../page/studies.js');

const unlimited = {study: Infinity, start: Infinity, frame: Infinity};

test('a hanging state that is not found in time: stopped, and the next scenario starts', () => {
  const engine = new Engine(module, {study: 0, start: 0, frame: 8}), core = new Core(module);
  const values = new Map([['ribbon.model', 'mass_spring'], ['mass_spring.shear_coefficient', '0']]); // straight, it is a mechanism
  const {stopped, failure, frame} = engine.answer({values, voltage: 0, restart: true, span: 0});
  assert.deepEqual({stopped, failure}, {stopped: {seconds: 0, moved: 0}, failure: null});
  core.resolve(values);
  assert.equal(scenario.tooLong(core, stopped),
    'Stopped after 0 s of computing. Keys that differ from the defaults: ribbon.model=mass_spring, mass_spring.shear_coefficient=0 N/m. Change one of these, or choose a preset.');
  assert.deepEqual(engine.answer({span: 1e-3, frame}).stopped, stopped, 'it stays so');
  assert.equal(engine.answer({values: new Map(), voltage: 0, span: 1e-3, frame}).stopped, null);
  assert.ok(engine.answer({span: 1e-3, frame}).frame[0] > 0, 'it moves on');
});

test('a study is stopped when its time is over, and says so', () => {
  const {result, stopped} = new Engine(module, {...unlimited, study: 0})
    .answer({study: 'actuate', values: new Map(dry), scalars: [], columns: []});
  assert.deepEqual(stopped, {seconds: 0});
  assert.equal(result.good, false);
});

test('a button that is pressed together with a change counts as pressed: the clock of the plots starts there', () => {
  const engine = new Engine(module, unlimited);
  engine.answer({values: new Map(dry), voltage: 1e3, restart: true, span: 0});
  const before = new Frame(engine.answer({span: 2e-3}).frame);
  const {frame} = engine.answer({values: new Map([...dry, ['load.mass', '9 g']]), voltage: 2e3, pressed: true, span: 1e-3}), after = new Frame(frame);
  assert.equal(after.get('marks'), before.get('marks') + 1);
  assert.ok(Math.abs(after.get('since') - 1e-3) < 1e-15 && Math.abs(after.get('time') - 3e-3) < 1e-15);
  assert.equal(after.get('voltage'), 2e3);
});

test('a change after a failure starts from hanging', () => {
  const engine = new Engine(module, unlimited), fresh = new Engine(module, unlimited);
  engine.answer({values: new Map(dry), voltage: 1e3, restart: true, span: 0});
  engine.answer({span: 2e-3});
  assert.match(engine.answer({values: new Map([...dry, ['solver.max_steps', '3']]), voltage: 5e3, span: 20e-3}).failure, /solver.max_steps/);
  fresh.answer({values: new Map(dry), voltage: 1e3, restart: true, span: 0});
  const again = new Frame(engine.answer({values: new Map(dry), voltage: 1e3, span: 1e-3}).frame), first = new Frame(fresh.answer({span: 1e-3}).frame);
  for (const name of ['time', 'since', 'stroke', 'voltage']) assert.equal(again.get(name), first.get(name), name);
});

/** A Motion that has moved along a known line, `count` samples since the last frame. */
function moved(from, count) {
  const zeros = (n) => new Float64Array(n), at = (k) => [1e-3 * k, 2e-6 * k, k, k, 1e-9 * k];
  const core = {
    members: 1, bodies: 0, springs: 0, joints: 0, nodes: 2, halves: 1, part: () => [], read: (columns) => columns.map(() => 0), effective: () => 0, value: () => 0,
    shape: () => ({x: zeros(4), y: zeros(4), gap: zeros(2), lineForce: zeros(2), film: zeros(0), pressure: zeros(0), wetLength: zeros(0)}),
  };
  return {core, time: 0, zero: 0, marks: 1, samples: Array.from({length: count}, (_, k) => at(from + k)).flat()};
}

test('a long trace keeps every second sample, from its beginning to its end', () => {
  const live = new Live(module), worker = workers.at(-1);
  live.restart(new Map(dry), 1e3);
  for (let from = 0; from < 4000; from += 50) {
    live.advance(1e-3);
    worker.say({frame: write(null, moved(from, 50), 50e-3), failure: null, stopped: null});
  }
  assert.equal(live.trace.time.length, 2000);
  live.trace.time.forEach((time, k) => assert.ok(Math.abs(time - 2e-3 * k) < 1e-12, `sample ${k} at ${time}`));
  assert.deepEqual([live.trace.stroke, live.trace.voltage, live.trace.command, live.trace.current].map((list) => list[1000]), [4e-3, 2000, 2000, 1e-9 * 2000]);
  assert.ok(mostSamples >= 50 && sampled.length === 5);
});

test('the curves of a network: openings, voltages and heights since a button, and anew for other parts', () => {
  const live = new Live(module), worker = workers.at(-1), engine = new Engine(module, limits.worker);
  const hands = (count) => new Map([['mesh.nodes', '9'], ['liquid.model', 'none'], ...Array.from({length: count}, (_, k) => k + 1)
    .flatMap((k) => [[`body_${k}.mass`, `${2 * k} g`], [`member_${k}.upper`, '0'], [`member_${k}.lower`, `${k}`]])]);
  const go = (question) => {
    live.advance(2e-3);
    worker.say(engine.answer({span: 2e-3, ...question}));
  };
  live.restart(hands(2), 3e3);
  go({values: hands(2), voltage: 3e3, restart: true});
  go({});
  const {time, openings, voltages, bodies} = live.parts;
  assert.deepEqual([time.length, openings.length, voltages.map((of) => of.at(-1)), bodies.length], [2, 2, [3e3, 3e3], 2]);
  openings.forEach((of, k) => of.forEach((opening, at) => assert.ok(Math.abs(opening + bodies[k][at]) < 1e-9, 'each hangs on its member')));
  assert.ok(openings[1][0] > openings[0][0]);
  live.restart(hands(3), 0);
  go({values: hands(3), voltage: 0, restart: true});
  assert.deepEqual([live.parts.time.length, live.parts.openings.length, live.parts.voltages[2]], [1, 3, [0]]);
});

test('of scenarios that come while a study is busy, the newest is answered', () => {
  const answers = [], study = new Study(module, 'equilibrium', [], [], (answer) => answers.push(answer)), worker = workers.at(-1);
  worker.say({ready: true});
  for (const mass of ['1 g', '2 g', '3 g']) study.ask(new Map([['load.mass', mass]]));
  assert.deepEqual(worker.asked.map(({values}) => values.get('load.mass')), ['1 g']);
  worker.say({result: 'of 1 g'});
  assert.deepEqual(worker.asked.map(({values}) => values.get('load.mass')), ['1 g', '3 g']);
  assert.ok(study.due);
  worker.say({result: 'of 3 g'});
  assert.deepEqual(answers, [{result: 'of 1 g'}, {result: 'of 3 g'}]);
  assert.ok(!study.due);
});

test('a study that takes long is given up for a newer scenario', () => {
  const study = new Study(module, 'equilibrium', [], [], () => {}), first = workers.at(-1);
  first.say({ready: true});
  study.ask(new Map([['load.mass', '1 g']]));
  turn(1000);
  study.ask(new Map([['load.mass', '2 g']]));
  assert.ok(first.ended && workers.at(-1) !== first);
  assert.deepEqual(workers.at(-1).asked.map(({values}) => values.get('load.mass')), ['2 g']);
});

test('a worker that is silent is ended; the simulation starts again in another', () => {
  const live = new Live(module), first = workers.at(-1), values = new Map(dry);
  first.say({ready: true});
  live.restart(values, 1e3);
  live.advance(1e-3);
  turn(10.5e3);
  assert.ok(first.ended);
  assert.deepEqual(live.end, {stopped: {seconds: 10}});
  live.switchTo(2e3);
  live.advance(1e-3);
  const [question] = workers.at(-1).asked;
  assert.deepEqual([question.values, question.restart, question.voltage], [values, true, 2e3]);
});

test('where no worker starts, the page answers the question that was asked', async () => { // the last test: it stays so
  let heard;
  const answer = new Promise((resolve) => (heard = resolve)), remote = new Remote(module, heard), worker = workers.at(-1);
  remote.ask({values: new Map(dry), voltage: 0, restart: true, span: 0});
  worker.onerror({message: 'not from a file'});
  assert.ok(worker.ended && Remote.local === 'not from a file');
  const {frame, failure} = await Promise.race([answer, new Promise((_, reject) => setTimeout(() => reject(new Error('no answer')), 20e3).unref())]);
  assert.equal(failure, null);
  assert.equal(new Frame(frame).get('nodes'), 9);
});
