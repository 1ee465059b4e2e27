// The page's scenario without a browser: address, undo, ranges.
import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {test} from 'node:test';
import {axisEnds, digits, fixed, pretty} from '../page/numbers.js';
import {Core} from '../page/core.js';
import {Engine} from '../page/engine.js';
import {Frame} from '../page/frame.js';
import {geometryOf} from '../page/geometry.js';
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
  const core = new Core(module), all = [...scenario.sliders, ...scenario.liquidSliders, ...scenario.supplySliders];
  const acting = new Map([['liquid.model', 'bead'], ['source.model', 'amplifier']]);
  for (const {key, min, max} of all) {
    const unit = core.keys.get(key).shown;
    for (const end of [min, max]) core.resolve(new Map([...acting, [key, `${end} ${unit}`.trim()]]));
  }
  for (const end of ['min', 'max'])
    core.resolve(new Map([...acting, ...all.map((s) => [s.key, `${s[end]} ${core.keys.get(s.key).shown}`.trim()])]));
});

test('sliders are there where their keys do something', () => {
  const core = new Core(module), shown = (...pairs) => {
    core.resolve(new Map(pairs));
    return [...scenario.liquidSliders, ...scenario.supplySliders].filter(({acts}) => acts(core)).map(({key}) => key);
  };
  assert.deepEqual(shown(['liquid.model', 'none']), []);
  assert.deepEqual(shown(['liquid.model', 'submerged']), ['medium.kinematic_viscosity']);
  assert.deepEqual(shown(['liquid.model', 'bead'], ['source.supply', 'open_5kv'], ['drive.voltage', '5 kV']),
    ['medium.kinematic_viscosity', 'bead.volume', 'bead.suction', 'source.resistance']);
});

test('every supply can be chosen, from any other: the drive is no higher than it can be, and what it can do is said', () => {
  const core = new Core(module), words = core.keys.get('source.supply').choices.map(({word}) => word);
  let values = new Map([['drive.voltage', '12 kV'], ['source.model', 'amplifier'], ['source.resistance', '5 Mohm']]), lines = new Map();
  for (const word of [...words, ...words]) {
    core.resolve(values);
    values = scenario.withSupply(core, values, word);
    core.resolve(values);
    assert.ok(!(core.value('drive.voltage') > core.value('source.voltage_limit')), word);
    lines.set(word, scenario.supplyWords(core));
    core.resolve(new Map([...scenario.atRest(values), ['drive.voltage', '12 kV']]));
  }
  assert.equal(lines.get('none'), 'ideal: the electrodes have the voltage of the buttons at once, with unlimited current');
  assert.match(lines.get('converter_10kv'), /^slew rate unlimited, current 0\.3.mA, sink none \(it cannot sink current\), bleeder 500.MΩ, voltage limit 10.kV$/);
  assert.match(lines.get('pocket_6kv'), /^slew rate 0.1.V\/µs, current unlimited, sink as current, bandwidth 35.Hz/);
});

test('one drives an actuator through a supply, with and without liquid, from one scenario to the next', () => {
  const engine = new Engine(module, {study: Infinity, start: Infinity, frame: Infinity}), frames = [];
  const go = (values, more) => {
    const {frame, ...rest} = engine.answer({values: new Map(values), voltage: 5e3, span: 2e-3, ...more});
    assert.deepEqual(rest, {failure: null, stopped: null});
    frames.push(new Frame(frame));
    return frames.at(-1);
  };
  const supply = ['source.supply', 'open_5kv'], low = ['drive.voltage', '5 kV'];
  go([low, ['liquid.model', 'none']], {restart: true});
  const dry = go([low, ['liquid.model', 'none']]), fed = go([low, supply, ['liquid.model', 'none']]), bead = go([low, supply, ['liquid.model', 'bead']]);
  const bath = go([low, ['liquid.model', 'submerged']]);
  assert.deepEqual(frames.map((frame) => frame.get('liquid')), [0, 0, 0, 2, 1]);
  for (const frame of [dry, fed, bead, bath]) assert.ok(Math.abs(frame.get('voltage') / 5e3 - 1) < 0.02, `${frame.get('voltage')} V`);
  const {film, pressure, wetLength: [reach]} = bead.member(0), l = 45e-3 / 60;
  assert.ok(reach > 5e-3 && reach < 40e-3, String(reach));
  film.forEach((thickness, i) => assert.equal(thickness > 0, i * l <= reach, `station ${i}`));
  assert.ok(pressure.some((p) => p !== 0) && pressure.every((p, i) => film[i] > 0 || p === 0));
  assert.ok(bath.member(0).film.every((thickness) => thickness > 0));
});

/** Volume of the bead of a half of member k from the thickness of its film, m3. */
function volumeOf(frame, k, right) {
  const {gap, wetLength, length, platform} = frame.member(k), n = gap.length, last = (frame.get('halves') === 2 ? n / 2 : n) - 1;
  const l = (length - platform) / 2 / last, reach = wetLength[Number(right)] / l;
  const film = (i) => gap[right ? n - 1 - i : i] + 2e-6; // the roughness
  let area = 0;
  for (let i = 0; i < reach; i++) {
    const part = Math.min(1, reach - i), end = film(i) + part * (film(i + 1) - film(i));
    area += ((film(i) + end) / 2) * part * l;
  }
  return area * 12.7e-3;
}

test('each member and each half has its own bead, which has its volume', () => {
  const bead = {'liquid.model': 'bead', 'mesh.nodes': '21'}, filled = (frame, k, right) => {
    const volume = volumeOf(frame, k, right); // the ribbon is 0.1 % longer than its straight half
    assert.ok(Math.abs(volume / 300e-9 - 1) < 2e-3, `member ${k}: ${volume}`);
  };
  const {frame: series} = geometryAt({...bead, 'stack.series': '2'}), {frame: whole} = geometryAt({...bead, 'actuator.symmetry': 'none'});
  for (const k of [0, 1]) filled(series, k, false);
  assert.ok(series.member(0).wetLength[0] < 0.98 * series.member(1).wetLength[0], 'the upper one is wider open');
  for (const side of [false, true]) filled(whole, 0, side);
});

test('the field in a bead is that of liquid on insulators, beyond it that of air', () => {
  const {engine} = geometryAt({'liquid.model': 'bead', 'mesh.nodes': '21'}), frame = new Frame(engine.answer({voltage: 3e3, pressed: true, span: 1e-4}).frame);
  const [{field, gap, wetStations}] = geometryOf(frame, true).members[0].halves;
  assert.ok(wetStations > 4 && wetStations < 10, String(wetStations));
  field.forEach((E, i) => {
    const insulators = 2 * 130e-6 * (i <= wetStations ? 2.75 : 1) / 4.62; // as thick as so much liquid, or air
    assert.ok(Math.abs(E * (gap[i] + insulators) / 3e3 - 1) < 1e-12, `station ${i}: ${E} V/m`);
  });
});

test('at rest the liquid has no pressure; in a closing gap it has one; the film is that of the signal', () => {
  const values = {'liquid.model': 'submerged', 'mesh.nodes': '9'}, {engine, frame} = geometryAt(values), {film, pressure} = frame.member(0);
  near(film[0], 2e-6); // the roughness, at the clip
  near(film[2], frame.get('film_thickness')); // a quarter of the length
  assert.ok(pressure.every((p) => Math.abs(p) < 1e-6), pressure.join());
  const closing = new Frame(engine.answer({voltage: 10e3, pressed: true, span: 5e-3}).frame).member(0).pressure;
  assert.ok(Math.max(...closing) > 10, closing.join());
});

test('a jump of an ideal source has no current to show, a supply’s has', () => {
  const engine = new Engine(module, {study: Infinity, start: Infinity, frame: Infinity});
  const currents = (values) => {
    engine.answer({values: new Map(values), voltage: 5e3, restart: true, span: 0});
    const seen = [];
    new Frame(engine.answer({span: 3e-3}).frame).eachSample((time, stroke, voltage, command, current) => seen.push(current));
    return seen;
  };
  const ideal = currents([['liquid.model', 'none']]), fed = currents([['liquid.model', 'none'], ['source.supply', 'open_5kv'], ['drive.voltage', '5 kV']]);
  assert.deepEqual(ideal.map(Number.isNaN), [true, false, false]);
  assert.ok(fed[0] > 10 * Math.abs(ideal[1]) && fed.every(Number.isFinite), fed.join());
});

/** The picture of a scenario at rest without voltage, and its engine. */
function geometryAt(values) {
  const engine = new Engine(module, {study: Infinity, start: Infinity, frame: Infinity});
  const {frame, failure} = engine.answer({values: new Map(Object.entries(values)), voltage: 0, restart: true, span: 0});
  assert.equal(failure, null);
  return {engine, frame: new Frame(frame), ...geometryOf(new Frame(frame), false)};
}
const presetOf = (wanted) => scenario.presets.find(({name}) => name === wanted).values;
const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-9, `${a}, ${b}`);
const dry = {'liquid.model': 'none', 'mesh.nodes': '21'};

test('a series: each member hangs on the one above, and the load on the lowest', () => {
  const {members, frame, loads: [load], supports, box: {bottom}} = geometryAt({...dry, 'stack.series': '3'});
  assert.equal(members.length, 3);
  members.slice(1).forEach(({platforms: [upper]}, k) => near(upper[0].y, members[k].platforms[1][0].y));
  near(load.y, -frame.get('opening'));
  near(bottom, load.y);
  assert.deepEqual(supports.map(({y}) => y), [0]);
  for (const {halves: [left, right]} of members) {
    left.x[0].forEach((x, i) => near(x, -right.x[0][i]));
    near(left.x[0].at(-1), 0);
  }
});

test('antagonists: the lower one is upside down on its mount, and the load is between both', () => {
  const {members: [upper, lower], frame, loads: [load], supports, focus} = geometryAt({...dry, 'stack.series': '2', 'stack.distance': '20 mm', 'stack.lower_voltage': '2 kV', 'load.mass': '0.5 g'});
  near(lower.platforms[0][0].y, -20e-3);
  near(lower.platforms[1][0].y, upper.platforms[1][0].y);
  near(load.y, upper.platforms[1][0].y);
  assert.equal(focus, upper, 'lens and profiles show the one that carries it');
  assert.ok(lower.turned && !upper.turned);
  assert.deepEqual(supports.map(({y}) => y), [0, -20e-3]);
  assert.equal(frame.member(1).voltage, 2e3);
  assert.ok(lower.halves[0].field[0] > 1e6 && upper.halves[0].field[0] === 0);
});

test('a whole actuator: its right half is not the mirror image; a platform that turns is drawn so', () => {
  const {members: [{halves: [left, right], platforms: [, [a, b]]}], loads: [load]} = geometryAt({...dry, 'actuator.symmetry': 'none', 'platform.rotates': 'true', 'platform.electrode': 'false', 'load.offset': '2 mm'});
  assert.ok(b.y < a.y - 1e-4, 'the right end is lower');
  near(Math.hypot(b.x - a.x, b.y - a.y), 10e-3);
  near(left.x[1].at(-1), right.x[1].at(-1));
  near(left.y[1].at(-1), right.y[1].at(-1));
  near(load.x - (a.x + b.x) / 2, (2 / 10) * (b.x - a.x));
  assert.ok(left.x[0][0] < left.x[0][1] && right.x[0][0] > right.x[0][1]);
  assert.ok(right.x[0][1] > 45e-3 && left.x[0][1] < -45e-3, 'each begins at its clip');
  assert.ok(right.y[1].at(-2) < left.y[1].at(-2) - 1e-4, 'its end of the platform is lower');
  assert.equal(left.gap.length, 21);
});

test('side by side: equal ones are copies, unequal ones have their own strips; a fold has one half and no clip', () => {
  const equal = geometryAt({...dry, 'stack.parallel': '3'}), unequal = geometryAt({...dry, 'stack.parallel': '3', 'member_2.ribbon.thickness': '80 um'});
  assert.deepEqual([equal.members.length, equal.members[0].places.length, unequal.members.length], [1, 3, 3]);
  assert.deepEqual(unequal.members.map(({metal}) => metal[0]), [50e-6, 80e-6, 50e-6]);
  assert.deepEqual(equal.members[0].places, unequal.members.map(({places}) => places[0]));
  const floors = geometryAt({...dry, 'stack.parallel': '2', 'stack.series': '2'}); // they were drawn side by side
  floors.members.forEach(({places}) => assert.equal(places.length, 2));
  const fold = geometryAt({'actuator.kind': 'hinge', 'mesh.nodes': '21', 'lower.insulator.thickness': '50 um'}), [{halves, platforms, insulator}] = fold.members;
  assert.deepEqual([halves.length, platforms.length, halves[0].x[0].length], [1, 0, 21]);
  assert.deepEqual(insulator, [130e-6, 50e-6]);
});

test('a pouch hangs: its films mirror each other, its electrodes attract, the load is at its lower end', () => {
  const {engine, members: [before]} = geometryAt({...presetOf('Pouch'), 'mesh.nodes': '41'}), wide = ({halves: [{x}]}) => Math.max(...x[0]);
  for (let k = 0; k < 10; k++) engine.answer({span: 5e-3, voltage: 6e3, pressed: true});
  const {members: [{halves: [half], along, electrodes, platforms, angle}], loads: [load], supports} = geometryOf(new Frame(engine.answer({span: 1e-3}).frame), false);
  assert.deepEqual([along, electrodes, platforms.length, angle, supports.map((support) => support.angle)], [true, 20, 0, -Math.PI / 2, [0]]);
  half.x[0].forEach((x, i) => near(x, -half.x[1][i]));
  half.y[0].forEach((y, i) => near(y, half.y[1][i]));
  near(load.y, half.y[1].at(-1));
  near(load.x, 0);
  assert.ok(load.y < -18e-3 && load.y > before.halves[0].y[0].at(-1) + 1e-4, 'it is lifted');
  assert.ok(Math.max(...half.x[0]) > wide(before) + 1e-4, 'liquid is squeezed down');
  assert.ok(half.field[1] > 1e8 && half.field[20] > 0 && half.field[21] === 0, 'between the electrodes alone');
});

test('a network: members where their bodies are, each with its voltage; a body that is pulled moves that way', () => {
  const tree = presetOf('Tree'), {members, bodies, loads, supports, frame} = geometryAt({...tree, 'mesh.nodes': '9', 'member_3.drive.voltage': '5 kV'});
  assert.equal(frame.get('bodies'), 4);
  assert.deepEqual(members.map(({platforms: [, [a, b]]}) => Math.round(500 * (a.x + b.x))), [0, -110, 110]); // mm
  members.forEach(({platforms, bodies: [upper, lower]}) => platforms.forEach(([a], r) => near(a.y, bodies.find(({body}) => body === [upper, lower][r])?.y ?? 0)));
  assert.deepEqual([supports.length, loads.map(({hangs}) => hangs)], [1, [false, true, true]]);

  const keys = {...presetOf('Joint'), 'mesh.nodes': '9', 'joint_1.first': '1', 'joint_1.second': '0'}, joint = geometryAt(keys), [{x, y, from, to}] = joint.joints;
  assert.ok(Math.hypot(x, y - 6e-3) < 1e-8, `a joint gives way a little: ${y}`);
  assert.deepEqual([to, from, joint.loads[0].aside, joint.supports.length], [0, 1, true, 3]);
  const go = (question) => new Frame(joint.engine.answer({span: 10e-3, ...question}).frame), turned = () => go({}).part('body', 1).angle;
  const [left, right] = go({voltage: 4e3, pressed: true}).parts('member').map(({voltage}) => voltage);
  assert.deepEqual([left, right], [4e3, 0]);
  joint.engine.answer({values: new Map(Object.entries(keys)), voltage: 0, restart: true, span: 0});
  const still = turned();
  assert.ok(Math.abs(still) < 1e-9, `it hangs straight: ${still}`);
  const pulled = go({pull: {body: 1, right: 0.1, up: 0}}).part('body', 1).angle;
  assert.ok(pulled > 1e-4, `below its pin, it turns anticlockwise: ${pulled}`);

  const {springs, bodies: fingers} = geometryAt({...presetOf('Gripper'), 'mesh.nodes': '9'});
  near(springs[0][0].x, -springs[1][1].x);
  near(springs[0][0].y, springs[1][1].y);
  for (const [{x, y}, k] of [[springs[1][0], 0], [springs[0][1], 1]]) near(Math.hypot(x - fingers[k].x, y - fingers[k].y), Math.hypot(40e-3, 70e-3));
});

test('the inchworm of the presets walks: Step plays its channels, its pads grip and slide', () => {
  const {engine} = geometryAt({...presetOf('Inchworm'), 'mesh.nodes': '13'}), go = (question) => new Frame(engine.answer({span: 50e-3, ...question}).frame);
  const pads = (frame) => [2, 4].map((k) => frame.part('body', k).x);
  const from = pads(go({voltage: 8e3, restart: true}));
  let to;
  for (let k = 0; k < 18; k++) to = pads(go({}));
  assert.ok(to[0] - from[0] > 5e-3, `the rear pad has moved by ${to[0] - from[0]} m`);
  assert.ok(Math.abs(to[1] - from[1]) < 1e-3, `the front pad holds: ${to[1] - from[1]} m`);
});

test('Step plays the waveforms and controllers of channels; release ends waveforms; a change begins again', () => {
  const two = {'mesh.nodes': '9', 'liquid.model': 'none', 'body_1.mass': '4 g', 'body_2.mass': '4 g', 'member_1.upper': '0', 'member_1.lower': '1', 'member_2.upper': '0', 'member_2.lower': '2'};
  const waves = {...two, 'drive.voltage': '6 kV', 'member_2.drive.waveform': 'ramp', 'member_2.drive.rise_time': '100 ms'};
  const {engine} = geometryAt(waves), go = (question) => new Frame(engine.answer({span: 10e-3, ...question}).frame).parts('member').map(({voltage}) => voltage);
  go({voltage: 6e3, restart: true});
  const [first, second] = go({});
  near(first, 6e3);
  near(second, 600);
  assert.deepEqual(go({voltage: 0, pressed: true}), [0, 0]);
  const again = new Frame(engine.answer({values: new Map(Object.entries({...waves, 'ribbon.thickness': '60 um'})), voltage: 6e3, span: 10e-3}).frame);
  near(again.get('time'), 10e-3);
  near(again.part('member', 1).voltage, 600);
  const held = new Engine(module, {study: Infinity, start: Infinity, frame: Infinity}), controlled = new Map(Object.entries({...two, 'drive.voltage': '8 kV', 'member_2.control.kind': 'pi', 'member_2.control.proportional': '1 kV/mm', 'member_2.control.integral': '0 kV/mm/s', 'member_2.setpoint.value': '8 mm'}));
  held.answer({values: controlled, voltage: 8e3, restart: true, span: 0});
  const [, {voltage}] = new Frame(held.answer({span: 10e-3}).frame).parts('member');
  assert.ok(voltage > 1e3 && voltage < 8e3, `${voltage} V`);
  assert.match(held.answer({voltage: 0, pressed: true, span: 1e-3}).refused, /a controller sets that of a channel/);
});

test('studies of a network give the openings of its members', () => {
  const core = new Core(module), values = new Map(Object.entries({...presetOf('Tree'), 'mesh.nodes': '9', 'liquid.model': 'none', 'output.errors': 'false'}));
  core.resolve(values);
  const {columns} = core.study('equilibrium', [], ['voltage_V', '.opening_m']);
  assert.deepEqual(Object.keys(columns), ['voltage_V', 'member_1.opening_m', 'member_2.opening_m', 'member_3.opening_m']);
  assert.ok(columns['member_3.opening_m'][0] > columns['member_2.opening_m'][0]);
});

test('a load that is pulled down opens further, and says why if it may not', () => {
  const {engine} = geometryAt(dry), go = (question) => new Frame(engine.answer({span: 5e-3, ...question}).frame).get('opening'), before = go({});
  assert.ok(go({pull: {body: 0, right: 0, up: -0.05}}) > before + 1e-5);
  assert.match(engine.answer({pull: {body: 0, right: 0, up: -1e9}, span: 0}).refused, /load/);
});

test('a stack continues when the load changes, and starts again when it becomes another one', () => {
  const {engine} = geometryAt({...dry, 'stack.series': '2'});
  const go = (values) => new Frame(engine.answer({values: values && new Map(Object.entries({...dry, ...values})), voltage: 5e3, span: 2e-3}).frame);
  go({'stack.series': '2'});
  const later = go(), heavier = go({'stack.series': '2', 'load.mass': '10 g'}), other = go({'stack.series': '3'});
  near(later.get('time'), 4e-3);
  near(heavier.get('time'), 6e-3);
  near(other.get('time'), 2e-3);
  assert.equal(other.get('members'), 3);
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
  assert.equal(history.undo(), 'a');
  history.add('f'); // what was undone is gone
  assert.equal(history.canRedo, false);
  assert.equal(history.undo(), 'a');
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

test('the curve of equilibria in pieces: of a branch each reaches the first point of the next, and none the next branch', async () => {
  Object.assign(globalThis, {document: {}, getComputedStyle: () => ({getPropertyValue: () => ''}), matchMedia: () => ({addEventListener() {}})}); // of a browser
  const {pieces} = await import('../page/plots.js');
  assert.deepEqual(pieces({branch: [0, 0, 0, 0, 1, 1], stable: [1, 1, 0, 0, 1, 1]}), [
    {from: 0, to: 3, stable: true}, {from: 2, to: 4, stable: false}, {from: 4, to: 6, stable: true},
  ]);
});

test('an axis shows values below 0, too: a stroke has a sign', () => {
  assert.deepEqual(axisEnds([3, 10.4]), [0, 12]);
  assert.deepEqual(axisEnds([10.4, -1.9], [2]), [-2, 12]);
  assert.deepEqual(axisEnds([-7]), [-8, 0]);
  assert.deepEqual(axisEnds([10, -1e-9]), [0, 10]);
  assert.deepEqual(axisEnds([0], []), [0, 1]);
  for (const odd of [NaN, Infinity, -Infinity, 1e-320]) assert.deepEqual(axisEnds([odd]), [0, 1], String(odd));
});

test('a frame has what the core has, in an array that goes to and fro', () => {
  const core = new Core(module), engine = new Engine(module, {study: Infinity, start: Infinity, frame: Infinity});
  const values = new Map([['solver.time_step', '100 us'], ['mesh.nodes', '31']]);
  core.resolve(values);
  core.start();
  const first = engine.answer({values, voltage: 10e3, restart: true, span: 0}), {frame: data} = first;
  assert.equal(new Frame(data).get('advanced'), 0);
  const {frame} = engine.answer({span: 5e-3, frame: data}), seen = new Frame(frame);
  assert.equal(frame, data, 'filled again, no other');
  for (let k = 1; k <= 5; k++) core.run(seen.get('time') * (k / 5));
  for (const name of ['stroke', 'opening', 'contraction', 'force', 'capacitance', 'insulator_field', 'max_stress'])
    assert.ok(Math.abs(seen.get(name) / core.signal(name) - 1) < 1e-9, `${name}: ${seen.get(name)}, ${core.signal(name)}`);
  assert.equal(seen.get('advanced'), 5e-3);
  assert.equal(seen.get('nodes'), 31);
  assert.equal(seen.member(0).upperMetal, 50e-6);
  const {x, y, gap, lineForce} = seen.member(0), shape = core.shape();
  assert.deepEqual([x.length, y.length, gap.length, lineForce.length], [62, 62, 31, 31]);
  for (let i = 0; i < 62; i++) assert.ok(Math.abs(y[i] - shape.y[i]) < 1e-9 && Math.abs(x[i] - shape.x[i]) < 1e-9);
  const samples = [];
  seen.eachSample((...sample) => samples.push(sample));
  assert.equal(samples.length, 5);
  assert.deepEqual(samples.at(-1).slice(0, 4), [seen.get('since'), seen.get('stroke'), seen.get('voltage'), 10e3]);
});
