// The core as WebAssembly beside the native command: the same numbers, the same words.
import assert from 'node:assert/strict';
import {execFileSync, spawnSync} from 'node:child_process';
import {mkdtempSync, readdirSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {after, test} from 'node:test';
import {Core, Refused} from '../page/core.js';
import * as scenario from '../page/scenario.js';

const command = process.env.ZIPACT ?? new URL('../../build/zipact', import.meta.url).pathname;
const module = new WebAssembly.Module(readFileSync(new URL('../build/zipact.wasm', import.meta.url)));
const folder = mkdtempSync(join(tmpdir(), 'zipact-web-'));
after(() => rmSync(folder, {recursive: true}));

function settings(values) {
  return [...values].flatMap(([key, text]) => ['--set', `${key}=${text}`]);
}

function native(study, values) {
  const all = [study, ...settings(values), '-o', folder, '--json', '--quiet', '--no-plots'];
  return JSON.parse(execFileSync(command, all, {encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore']}));
}

function table() {
  const [head, ...rows] = readFileSync(join(folder, 'table.csv'), 'utf8').trim().split('\n').map((line) => line.split(','));
  return Object.fromEntries(head.map((name, k) => [name, rows.map((row) => (row[k] === '' ? NaN : Number(row[k])))]));
}

/** Arrays of doubles of the last shape that the command has written, by their name. */
function lastShape() {
  const shapes = join(folder, 'shapes'), file = readFileSync(join(shapes, readdirSync(shapes).sort().at(-1)));
  const start = file.indexOf('_', file.indexOf('<AppendedData')) + 1;
  const declared = file.subarray(0, start).toString('latin1').matchAll(/type="Float64" Name="(\w+)" .*offset="(\d+)"/g);
  return Object.fromEntries([...declared].map(([, name, offset]) => {
    const at = start + Number(offset), length = Number(file.readBigUInt64LE(at)) / 8;
    return [name, Array.from({length}, (_, k) => file.readDoubleLE(at + 8 + 8 * k))];
  }));
}

/** The largest difference of two columns, over the largest value. */
function difference(a, b) {
  assert.equal(a.length, b.length);
  const most = a.reduce((m, v) => Math.max(m, Math.abs(v) || 0), 0);
  return a.reduce((m, v, k) => Math.max(m, Number.isNaN(v) && Number.isNaN(b[k]) ? 0 : Math.abs(v - b[k])), 0) / (most || 1);
}

/** What an imbalance of energy or a current is measured by: they are small differences of large numbers. */
const derived = {energy_imbalance_J: 'electric_work_J', contact_loss_J: 'electric_work_J', axial_energy_J: 'electric_work_J'};

const fixedSteps = {
  'the default actuator zips': {'liquid.model': 'none'},
  'beads of oil': {'liquid.model': 'bead', 'bead.suction': '0.5', 'solver.end_time': '40 ms'},
  'a supply that cannot sink, in a bath': {
    'liquid.model': 'submerged', 'source.supply': 'converter_10kv', 'source.capacitance': '100 pF', 'solver.end_time': '50 ms',
  },
  'thick steel, heavy load': {
    'liquid.model': 'none',
    'ribbon.thickness': '100 um', 'load.mass': '25 g', 'damping.internal': '1000 us',
  },
  'two in series': {'liquid.model': 'none', 'stack.series': '2', 'mesh.nodes': '31', 'solver.end_time': '20 ms'},
  'a platform that turns': {
    'liquid.model': 'none', 'actuator.symmetry': 'none', 'platform.rotates': 'true', 'platform.electrode': 'false',
    'load.offset': '2 mm', 'mesh.nodes': '31', 'solver.end_time': '20 ms',
  },
  'a fold': {
    'actuator.kind': 'hinge', 'ribbon.length': '40 mm', 'hinge.stiffness': '0.4 mN m/rad', 'hinge.rest_angle': '20 degree',
    'load.mass': '0 g', 'solver.end_time': '20 ms',
  },
  'half a zip in thin steel': {'liquid.model': 'none', 'ribbon.thickness': '30 um', 'drive.voltage': '7 kV', 'solver.end_time': '30 ms'},
};

for (const [name, changes] of Object.entries(fixedSteps)) {
  test(`fixed steps, native and WASM within 1e-9: ${name}`, () => {
    const values = new Map(Object.entries({
      'solver.time_step': '200 us', 'solver.end_time': '60 ms', ...changes,
    }));
    const theirs = native('actuate', values), rows = table();
    const core = new Core(module);
    core.resolve(values);
    const ours = core.study('actuate', ['steps', 'contraction', 'energy_error']);
    assert.equal(ours.scalars.steps, theirs.steps);
    assert.deepEqual(ours.notes, theirs.notes);
    assert.ok(ours.scalars.contraction > 1e-3, 'it moves');
    for (const column of Object.keys(rows)) {
      const scale = derived[column];
      const d = scale
        ? Math.max(...rows[column].map((v, k) => Math.abs(v - ours.columns[column][k]))) / Math.max(...rows[scale].map(Math.abs))
        : difference(rows[column], ours.columns[column]);
      assert.ok(d < 1e-9, `${column} differs by ${d}`);
    }
  });
}

test('sixty in series hang as with the command: their arrays fit, though a pointer has four bytes', () => {
  const values = new Map([['liquid.model', 'none'], ['stack.series', '60'], ['mesh.nodes', '9']]), core = new Core(module);
  const theirs = native('stationary', values);
  core.resolve(values);
  const ours = core.study('stationary', ['opening_m']);
  assert.ok(Math.abs(ours.scalars.opening_m - theirs.opening_m) < 1e-9 * theirs.opening_m, `${ours.scalars.opening_m}, ${theirs.opening_m}`);
});

test('the simulation that runs along ends where the study does, with fixed steps', () => {
  const values = new Map([['liquid.model', 'bead'], ['solver.time_step', '200 us'], ['solver.end_time', '40 ms']]);
  native('actuate', values);
  const rows = table(), core = new Core(module);
  core.resolve(values);
  core.start();
  const columns = Object.keys(rows);
  for (let k = 1; k <= 200; k++) assert.equal(core.run(k * 2e-4), null);
  for (const signal of ['stroke', 'opening', 'contraction', 'force', 'charge', 'capacitance', 'zipped_length', 'insulator_field', 'max_stress']) {
    const column = Object.keys(rows).find((head) => head === signal || head.startsWith(`${signal}_`));
    const wanted = rows[column].at(-1);
    assert.ok(Math.abs(core.signal(signal) - wanted) <= 1e-9 * Math.abs(wanted), `${signal}: ${core.signal(signal)}, ${wanted}`);
  }
  const row = core.read(columns), last = columns.map((name) => rows[name].at(-1));
  for (const name of ['time_s', 'stroke_m', 'film_thickness_m', 'wet_length_m', 'voltage_V', 'command_V']) {
    const k = columns.indexOf(name);
    assert.ok(Math.abs(row[k] - last[k]) <= 1e-9 * Math.abs(last[k]), `${name}: ${row[k]}, ${last[k]}`);
  }
  const {x, y, gap, lineForce} = core.shape(), written = lastShape(), nodes = core.nodes;
  const ribbon = (values, r) => Array.from({length: nodes}, (_, i) => values[2 * i + r]);
  const points = (axis) => written.Points.filter((_, k) => k % 3 === axis);
  for (const [ours, theirs] of [[x, points(0)], [y, points(1)]])
    assert.ok(difference([...ribbon(ours, 0), ...ribbon(ours, 1)], theirs) < 1e-9);
  for (const [ours, theirs] of [[gap, written.gap], [lineForce, written.line_force]])
    assert.ok(difference([...ours, ...ours], theirs) < 1e-9);
});

test('pull-in and release are those of the command', () => {
  const values = scenario.beginning;
  const theirs = native('equilibrium', values), core = new Core(module);
  core.resolve(values);
  const {scalars} = core.study('equilibrium', ['pull_in_voltage_V', 'release_voltage_V']);
  for (const [name, value] of Object.entries(scalars)) assert.ok(Math.abs(value / theirs[name] - 1) < 1e-6, `${name}: ${value}, ${theirs[name]}`);
});

const refused = [
  ['ribbon.length', '20'], ['ribbon.lenght', '1'], ['ribbon.length', '5 kg'], ['ribbon.length', 'abc'], ['ribbon.length', ''],
  ['mesh.nodes', '7.5'], ['contact.model', 'seq'], ['platform.length', '95 mm'], ['load.mass', '-1 g'], ['ribbon.density', '0'],
  ['drive.rise_time', '1 ms'], ['segment_1.length', '60 mm'], ['electro.breakdown_cap', 'maybe'],
];

for (const [key, text] of refused) {
  test(`refused in the command's words: ${key}=${text}`, () => {
    const values = new Map([[key, text]]);
    const {status, stderr} = spawnSync(command, ['actuate', ...settings(values), '-o', folder, '--quiet'], {encoding: 'utf8'});
    const core = new Core(module);
    if (status !== 2) assert.fail(`the command takes it: ${stderr}`);
    assert.throws(() => core.resolve(values), (error) => {
      assert.ok(error instanceof Refused);
      assert.equal(stderr.trim().replace('zipact: ', '').replace('--set ', ''), error.message);
      return true;
    });
  });
}

test('a study is refused in the command’s words', () => {
  const values = new Map([['ribbon.plasticity', 'true'], ['mesh.nodes', '9']]), core = new Core(module);
  const {stderr} = spawnSync(command, ['equilibrium', ...settings(values), '-o', folder, '--quiet'], {encoding: 'utf8'});
  core.resolve(values);
  assert.throws(() => core.study('equilibrium', []), (error) => error instanceof Refused && stderr.trim() === `zipact: ${error.message}` && error.message !== '');
});

test('after a refusal the scenario is what it was', () => {
  const core = new Core(module);
  core.resolve(new Map([['load.mass', '20 g']]));
  assert.throws(() => core.resolve(new Map([['platform.length', '95 mm']])), Refused);
  assert.equal(core.value('load.mass'), 0.02);
});

const leftOut = [
  {'electro.model': 'field'}, {'electro.edges': 'true'}, {'actuator.kind': 'ribbon'}, {study: 'modes'},
  {'drive.waveform': 'sine'}, {'initial.state': 'checkpoint'},
  {'solver.integrator': 'explicit', 'contact.model': 'sequential'},
];

for (const values of leftOut) {
  test(`what the page leaves out is refused: ${Object.keys(values)}`, () => {
    const core = new Core(module);
    assert.throws(() => core.resolve(new Map(Object.entries(values))), /this page|this build/);
    core.resolve(new Map()); // nothing of it stays
  });
}

test('the page has the keys of the command, with their ranges', () => {
  const list = JSON.parse(execFileSync(command, ['keys', '--json'], {encoding: 'utf8'})), core = new Core(module);
  assert.deepEqual([...core.keys.keys()], list.map(({key}) => key));
  const words = (choices) => (choices ?? []).map(({word}) => word).filter((word) => word !== 'profile'); // a study that the page leaves out
  for (const {key, choices} of list) assert.deepEqual(words(core.keys.get(key).choices), words(choices), key);
  for (const {key, unit, min, max} of list.filter(({min}) => typeof min === 'number')) {
    assert.equal(core.keys.get(key).min, min, `${key} in ${unit}`);
    assert.equal(core.keys.get(key).max, max, `${key} in ${unit}`);
  }
});

test('units of the page are those of the command: defaults and ranges as a starter scenario has them', () => {
  const core = new Core(module), lines = execFileSync(command, ['keys', '--yaml'], {encoding: 'utf8'}).split('\n');
  const path = [];
  let seen = 0;
  for (const line of lines) {
    const [, indent, name, text] = /^( *)([a-z_0-9.]+):(?: +([^#]*?))?(?: +#.*)?$/.exec(line) ?? [];
    if (!name) continue;
    path.splice(indent.length / 2, Infinity, name);
    const key = core.keys.get(path.join('.'));
    if (!key?.shown || !text) continue;
    seen++;
    assert.equal(core.print(key.name, key.default), text, key.name);
    const [least, most] = [key.min, key.max].map((value) => core.print(key.name, value));
    assert.ok(line.includes(`(${least} to ${most}`), `${least} to ${most}: ${line}`);
  }
  assert.ok(seen > 60, `${seen} keys seen`);
});

test('the page begins with the command’s default of every key (its internal damping was 1000 us, the command’s 10 us)', () => {
  const list = JSON.parse(execFileSync(command, ['keys', '--json'], {encoding: 'utf8'})), core = new Core(module);
  const number = {real: (v) => v, int: (v) => v, bool: Number, real_auto: (v) => typeof v === 'number' ? v : NaN, text: () => NaN};
  core.resolve(scenario.beginning);
  for (const {key, type, default: def, choices} of list) {
    const wanted = type === 'enum' ? choices.findIndex(({word}) => word === def) : number[type](def);
    assert.ok(Object.is(core.value(key), wanted), `${key}: ${core.value(key)}, the command has ${def}`);
  }
  for (const {key, default: def} of list.filter(({type, default: def}) => type === 'real_auto' && typeof def === 'string')) assert.equal(core.print(key, core.value(key)), def, key);
  const values = new Map([['solver.end_time', '1 ms']]);
  native('actuate', values);
  const written = readFileSync(join(folder, 'scenario.yaml'), 'utf8');
  assert.match(written, /internal: auto/);
  assert.equal(scenario.toCommand(core), 'zipact actuate');
});

test('what auto stands for', () => {
  const core = new Core(module), effective = (name, ...pairs) => {
    core.resolve(new Map(pairs));
    return core.effective(name);
  };
  assert.equal(effective('damping.internal'), 10e-6);
  assert.equal(effective('damping.internal', ['ribbon.model', 'mass_spring']), 0);
  assert.equal(effective('damping.internal', ['damping.internal', '70 us']), 70e-6);
  assert.ok(Math.abs(effective('electro.insulator_offset') - (2 * 130e-6 * 2.75) / 4.62) < 1e-18);
  assert.ok(effective('mass_spring.shear_coefficient') > 0);
  assert.ok(Number.isNaN(effective('solver.time_step')), 'chosen from step to step');
  assert.equal(effective('load.mass'), 8e-3);
});

test('a call is stopped when its time is over, and the next continues from there', () => {
  const core = new Core(module);
  core.resolve(new Map());
  core.start();
  core.allow(0);
  assert.equal(core.run(0.05), null);
  assert.ok(core.expired);
  const reached = core.signal('time');
  assert.ok(reached > 0 && reached < 0.05, String(reached));
  core.allow(60e3);
  assert.equal(core.run(0.05), null);
  assert.ok(!core.expired);
  assert.equal(core.signal('time'), 0.05);
});

test('the command line that the page shows gives the page’s scenario', () => {
  const core = new Core(module);
  core.resolve(new Map([...scenario.beginning, ['load.mass', '12.5 g'], ['ribbon.thickness', '60 um'], ['solver.time_step', '1 ms']]));
  const words = [...scenario.toCommand(core).matchAll(/--set "([^"]*)"/g)].map((found) => found[1].split('='));
  native('actuate', new Map([...words, ['solver.end_time', '10 ms']]));
  const written = readFileSync(join(folder, 'scenario.yaml'), 'utf8');
  for (const [, text] of words) assert.ok(written.includes(text), `${text} in scenario.yaml`);
  const again = new Core(module);
  again.resolve(new Map(words));
  for (const name of core.keys.keys()) assert.ok(Object.is(again.value(name), core.value(name)), name);
});

test('a light ribbon whose bead draws it hangs and moves, and the next scenario runs', () => {
  const core = new Core(module);
  // from a state that did not hang, this run left all bounds
  core.resolve(new Map([['ribbon.length', '97.19 mm'], ['ribbon.width', '24.51 mm'], ['ribbon.thickness', '10.45 um'], ['ribbon.young_modulus', '4.5 GPa'],
    ['ribbon.poisson_ratio', '0.38'], ['ribbon.density', '1390 kg/m3'], ['platform.length', '9.719 mm'], ['insulator.thickness', '74.25 um'],
    ['medium.kinematic_viscosity', '1034 mm2/s'], ['bead.volume', '40.33 uL'], ['bead.suction', '0.6637'], ['load.mass', '0 g'], ['mesh.nodes', '21'],
    ['electro.breakdown_cap', 'false'], ['drive.voltage', '4.925 kV'], ['source.model', 'amplifier'], ['source.supply', 'pocket_6kv'],
    ['source.slew_rate', '0.1 kV/ms']]));
  core.start();
  assert.equal(core.run(0.01), null);
  assert.ok(Math.abs(core.signal('opening') - 0.130647e-3) < 3e-9); // 1.3e-9 measured
  core.resolve(new Map());
  core.start();
  assert.equal(core.run(0.01), null);
});

test('a change while it runs continues from where it was', () => {
  const core = new Core(module);
  core.resolve(scenario.beginning);
  core.start();
  core.run(0.05);
  const before = {stroke: core.signal('stroke'), speed: core.signal('end_velocity')};
  core.resolve(new Map([...scenario.beginning, ['load.mass', '20 g']]));
  core.start(true);
  assert.equal(core.signal('stroke'), before.stroke);
  assert.equal(core.signal('end_velocity'), before.speed);
  assert.equal(core.signal('voltage'), 10e3);
  assert.equal(core.run(0.3), null);
});
