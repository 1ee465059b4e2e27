// The page's scenario without a browser: address, undo, ranges.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {test} from 'node:test';
import {digits, fixed, pretty} from '../page/numbers.js';
import {Core} from '../page/core.js';
import * as scenario from '../page/scenario.js';

const module = new WebAssembly.Module(readFileSync(new URL('../build/zipact.wasm', import.meta.url)));

test('the address gives the scenario back', () => {
  const values = new Map([['load.mass', '8 g'], ['ribbon.plane', 'stress'], ['drive.voltage', '9.5 kV']]);
  const core = new Core(module), again = new Core(module), read = scenario.fromAddress(scenario.toAddress(values, 50));
  core.resolve(values);
  again.resolve(read.values);
  for (const name of core.keys.keys()) assert.ok(Object.is(core.value(name), again.value(name)), name);
  assert.equal(read.slow, 50);
});

test('an address that is no scenario comes to the core as it is', () => {
  assert.deepEqual([...scenario.fromAddress('#nonsense').values], [['nonsense', '']]);
  assert.deepEqual([...scenario.fromAddress('#load.mass=%zz').values], [['load.mass', '%zz']]);
  assert.equal(scenario.fromAddress('#slow=20').values, scenario.beginning);
  assert.throws(() => new Core(module).resolve(scenario.fromAddress('#nonsense').values), /unknown key/);
});

test('every slider stays within what the core allows, at both ends alone and together', () => {
  const core = new Core(module);
  for (const {key, min, max} of scenario.sliders) {
    const unit = core.keys.get(key).shown;
    for (const end of [min, max]) core.resolve(new Map([[key, `${end} ${unit}`.trim()]]));
  }
  for (const end of ['min', 'max'])
    core.resolve(new Map(scenario.sliders.map((s) => [s.key, `${s[end]} ${core.keys.get(s.key).shown}`.trim()])));
});

test('every preset runs', () => {
  const core = new Core(module);
  for (const {name, values} of scenario.presets) {
    core.resolve(new Map([...scenario.beginning, ...Object.entries(values)]));
    core.start();
    assert.equal(core.run(0.2), null, name);
  }
});

test('undo and redo; a drag is one change', () => {
  const history = new scenario.History('a');
  history.add('b', 'load.mass');
  history.add('c', 'load.mass');
  history.close();
  history.add('d', 'load.mass');
  assert.equal(history.undo(), 'c');
  assert.equal(history.undo(), 'a');
  assert.equal(history.canUndo, false);
  assert.equal(history.undo(), 'a');
  assert.equal(history.redo(), 'c');
  history.add('e');
  assert.equal(history.canRedo, false);
  assert.equal(history.undo(), 'c');
});

test('numbers as people read them', () => {
  assert.equal(digits(78.72), '78.7');
  assert.equal(digits(5624.5), '5620');
  assert.equal(digits(0.8553), '0.855');
  assert.equal(digits(NaN), '–');
  assert.equal(fixed(-1e-9, 2), '0.00');
  assert.equal(fixed(-1.234, 1), '−1.2');
  assert.equal(pretty('50 um'), '50 µm');
});
