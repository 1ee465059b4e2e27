// The scenario of the page: which keys have sliders, presets, text for the command, the address after #, undo.

import {pretty} from './numbers.js';

/** The initial scenario: the defaults of the command. */
export const beginning = new Map();

/** Sliders in their order: range and step in the unit of the key, within its range. */
export const sliders = [
  {key: 'drive.voltage', label: 'Voltage', min: 0, max: 12, step: 0.1},
  {key: 'load.mass', label: 'Load', min: 0, max: 100, step: 0.5, acts: (core) => !isNetwork(core)},
  {key: 'ribbon.thickness', label: 'Steel thickness', min: 20, max: 200, step: 1},
  {key: 'ribbon.length', label: 'Length', min: 40, max: 200, step: 1},
  {key: 'ribbon.width', label: 'Width', min: 4, max: 40, step: 0.1},
  {key: 'insulator.thickness', label: 'Insulator thickness', min: 10, max: 400, step: 5},
  {key: 'insulator.permittivity', label: 'Insulator permittivity', min: 1, max: 12, step: 0.01},
  {key: 'medium.permittivity', label: 'Liquid permittivity', min: 1, max: 10, step: 0.05},
  {key: 'medium.breakdown_field', label: 'Liquid breakdown', min: 1, max: 60, step: 0.5},
  {key: 'damping.internal', label: 'Damping', min: 0, max: 1000, step: 10},
];

/** The liquid model, with auto resolved. */
const liquid = (core) => {
  const {choices} = core.keys.get('liquid.model');
  return choices[core.effective('liquid.model')].word;
};
/** Is it a network, whose bodies have masses of their own and no single stroke? */
export const isNetwork = (core) => core.settings().some(({name}) => name.startsWith('body_'));
const isWet = (core) => liquid(core) !== 'none', isBead = (core) => liquid(core) === 'bead';
const isFed = (core) => core.value('source.model') !== 0;

/** Sliders of the liquid and of the supply, shown if their keys have an effect (`acts`); `log`: logarithmic. */
export const liquidSliders = [
  {key: 'medium.kinematic_viscosity', label: 'Viscosity', min: 0.5, max: 5000, log: true, acts: isWet},
  {key: 'bead.volume', label: 'Bead volume', min: 5, max: 500, log: true, acts: isBead},
  {key: 'bead.suction', label: 'Bead suction', min: 0, max: 1, step: 0.05, acts: isBead},
];
export const supplySliders = [{key: 'source.resistance', label: 'Series resistance', min: 0, max: 2000, step: 10, acts: isFed}];

/** Choices: keys that take a word. `words`: the text in the list for a word of the key. */
export const liquidChoice = {key: 'liquid.model', label: 'Liquid'};
export const supplyChoice = {key: 'source.supply', label: 'Supply', words: {none: 'ideal'}};

/** Materials: keys whose word sets other keys, and these keys. */
export const materials = [
  {key: 'ribbon.material', label: 'Strip', fills: ['young_modulus', 'poisson_ratio', 'density', 'yield_stress'], words: {none: 'as set'}},
  {key: 'insulator.material', label: 'Insulator', fills: ['permittivity', 'density', 'young_modulus', 'breakdown_field'], words: {none: 'as set'}},
  {key: 'medium.material', label: 'Liquid', fills: ['permittivity', 'breakdown_field', 'kinematic_viscosity', 'density', 'surface_tension'], words: {none: 'as set'}},
];

/** Another material: the keys that it sets are no longer given. */
export function withMaterial(values, {key, fills}, word) {
  const group = key.split('.')[0];
  const others = new Map([...values].filter(([name]) => name !== key && !fills.some((filled) => name === `${group}.${filled}`)));
  return word === 'none' ? others : others.set(key, word);
}

/** Another supply: the values of the old one are removed, and the drive is limited to its largest voltage. */
export function withSupply(core, values, word) {
  const others = new Map([...values].filter(([key]) => !key.startsWith('source.')));
  if (word === 'none') return others;
  core.resolve(new Map([['source.supply', word], ['drive.voltage', '0 V']]));
  const most = core.value('source.voltage_limit');
  core.resolve(values);
  if (core.value('drive.voltage') > most) others.set('drive.voltage', core.print('drive.voltage', most));
  return others.set('source.supply', word);
}

/** The limits of the supply in one line, and its other keys that are given. */
export function supplyWords(core) {
  if (!isFed(core)) return 'ideal: the electrodes have the voltage of the buttons at once, with unlimited current';
  const shown = (key) => pretty(core.print(key, core.value(key)));
  const sink = core.value('source.sink_limit') === 0 ? 'none (it cannot sink current)' : shown('source.sink_limit').replace('auto', 'as current');
  const three = [`slew rate ${shown('source.slew_rate').replace('none', 'unlimited')}`,
                 `current ${shown('source.current_limit').replace('none', 'unlimited')}`, `sink ${sink}`];
  const told = ['source.model', 'source.supply', 'source.slew_rate', 'source.current_limit', 'source.sink_limit', 'source.resistance'];
  const others = changed(core).filter(([key]) => key.startsWith('source.') && !told.includes(key));
  return [...three, ...others.map(([key, text]) => `${key.slice('source.'.length).replaceAll('_', ' ')} ${pretty(text)}`)].join(', ');
}

/** The same actuator for studies of equilibria, which apply drive.voltage to the electrodes without a supply. */
export const atRest = (values) => new Map([...values].filter(([key]) => !key.startsWith('source.')));

// Keys of the parts of a network; body 0 is the frame.
const named = (part, k, keys) => Object.fromEntries(Object.entries(keys).map(([key, text]) => [`${part}_${k}.${key}`, text]));
const body = (k, keys) => named('body', k, keys);
const member = (k, upper, lower, keys = {}) => named('member', k, {upper: `${upper}`, lower: `${lower}`, ...keys});
const joint = (k, first, second, x, y) => named('joint', k, {first: `${first}`, second: `${second}`, 'at.x': `${x} mm`, 'at.y': `${y} mm`});
const plane = {moves: 'plane'};
const diagonal = (k, from, to) => named('spring', k, {first: '1', second: '2', 'from_at.x': '40 mm', 'from_at.y': `${from} mm`, 'to_at.x': '-40 mm', 'to_at.y': `${to} mm`, stiffness: '60 N/m', rest: '22.6 mm', kind: 'push'});

// An inchworm: feet 1 and 3 with pads 2 and 4, as in examples/inchworm.yaml.
const point = (key, x, y) => ({[`${key}.x`]: `${x} mm`, [`${key}.y`]: `${y} mm`});
const foot = (k, x) => body(k, {...plane, mass: '4 g', inertia: '4000 g mm2', ...point('at', x, 45)});
const pad = (k, x) => body(k, {...plane, mass: '1 g', inertia: '200 g mm2', ...point('at', x, -8), angle: '90 degree'});
const slide = (k, first, second, x) => ({...joint(k, first, second, x, 0), [`joint_${k}.type`]: 'slide'});
const lift = (k, on, x, keys = {}) => member(k, on, on + 1, {...point('upper_at', x, -45), 'lower_at.x': '5 mm', 'ribbon.width': '25.4 mm', ...keys});
const press = (k, on, x) => named('spring', k, {first: `${on}`, second: `${on + 1}`, ...point('from_at', x, -45), direction: '-90 degree', stiffness: '30 N/m', rest: '19 mm', kind: 'push'});
const grip = (k, on) => named('spring', k, {first: '0', second: `${on}`, ...point('from_at', 0, -8), direction: '90 degree', stiffness: '5000 N/m', kind: 'push', friction: '1'});
const across = (k, stiffness, rest) => named('spring', k, {first: '1', second: '3', ...point('from_at', 40, 20), ...point('to_at', -40, 20), direction: '0', stiffness, rest, kind: 'push'});
const inchworm = {
  ...foot(1, -40), ...pad(2, -62), ...foot(3, 57), ...pad(4, 79),
  ...slide(1, 0, 1, -62), ...slide(2, 0, 3, 79), ...slide(3, 2, 1, -62), ...slide(4, 4, 3, 79),
  ...lift(1, 1, -22, {'drive.delay': '0.5 s'}), ...lift(2, 3, 22),
  ...member(3, 1, 3, {...point('upper_at', 40, 20), ...point('lower_at', -40, 20), angle: '90 degree', 'drive.voltage': '5.5 kV', 'drive.rise_time': '50 ms', 'drive.duty': '0.5', 'drive.delay': '0.56 s'}),
  ...press(1, 1, -22), ...press(2, 3, 22), ...grip(3, 2), ...grip(4, 4), ...across(5, '4 N/m', '33 mm'), ...across(6, '30 N/m', '7 mm'),
  'drive.waveform': 'square', 'drive.voltage': '8 kV', 'drive.frequency': '1 Hz', 'drive.duty': '0.45', 'drive.rise_time': '20 ms', 'damping.drag': '0.02 N s2/m2', 'mesh.nodes': '21',
};

/** Presets by topic, with their values in the order of the sliders. A preset replaces the whole scenario. */
export const presets = [
  {of: 'Actuators', name: 'The paper’s', help: '50 µm steel lifts 8 g', values: {}},
  {of: 'Actuators', name: 'Thin and far', help: '20 µm steel: the largest stroke', values: {'ribbon.thickness': '20 um', 'load.mass': '1 g', 'drive.voltage': '8 kV'}},
  {of: 'Actuators', name: 'Thick and strong', help: '200 µm steel lifts 60 g by 2.5 mm, in a bath', values: {'ribbon.thickness': '200 um', 'load.mass': '60 g', 'liquid.model': 'submerged'}},
  {of: 'Actuators', name: 'Too heavy', help: '30 g: it does not close', values: {'load.mass': '30 g'}},
  {of: 'Liquids', name: 'In air', help: 'no liquid: air breaks down at a sixth of the field of the oil', values: {'liquid.model': 'none', 'medium.permittivity': '1', 'medium.breakdown_field': '3 MV/m'}},
  {of: 'Liquids', name: 'In a bath', help: 'submerged ribbons: a film of oil between them, and oil that they move outside', values: {'liquid.model': 'submerged'}},
  {of: 'Liquids', name: 'With beads', help: 'a bead of oil at each zip front, air beyond', values: {'liquid.model': 'bead'}},
  {of: 'Materials', name: 'Kapton on spring steel', help: 'a thin polyimide film withstands a high field: more force at a lower voltage', values: {'drive.voltage': '6 kV', 'ribbon.material': 'steel_1.4310', 'insulator.thickness': '50 um', 'insulator.material': 'kapton'}},
  {of: 'Materials', name: 'Mylar in ester', help: 'polyester film in a natural ester: a higher permittivity, a more viscous liquid', values: {'drive.voltage': '8 kV', 'insulator.thickness': '100 um', 'insulator.material': 'mylar', 'medium.material': 'fr3'}},
  {of: 'Materials', name: 'Tape on brass', help: 'brass is half as stiff as steel and yields earlier', values: {'load.mass': '5 g', 'ribbon.material': 'brass', 'insulator.material': 'pvc_tape'}},
  {of: 'Supplies', name: 'Pocket, 6 kV', help: '0.1 V/µs: reaches 6 kV after 60 ms; lifts 4 g', values: {'drive.voltage': '6 kV', 'load.mass': '4 g', 'source.supply': 'pocket_6kv'}},
  {of: 'Supplies', name: 'Open hardware, 5 kV', help: '15 V/µs; lifts 4 g', values: {'drive.voltage': '5 kV', 'load.mass': '4 g', 'source.supply': 'open_5kv'}},
  {of: 'Supplies', name: 'Laboratory, 10 kV', help: '700 V/µs and 10 mA: nearly ideal', values: {'source.supply': 'laboratory_10kv'}},
  {of: 'Supplies', name: 'Converter, 10 kV', help: '0.3 mA, and a bleeder of 500 MΩ through which it discharges', values: {'source.supply': 'converter_10kv'}},
  {of: 'Arrangements', name: 'Three in series', help: 'the lowest carries least and zips first; the strokes add up', values: {'stack.series': '3', 'mesh.nodes': '31'}},
  {of: 'Arrangements', name: 'Three side by side', help: 'they share 24 g; the strip of the middle one is thicker and carries most', values: {'stack.parallel': '3', 'member_2.ribbon.thickness': '80 um', 'load.mass': '24 g', 'mesh.nodes': '31'}},
  {of: 'Arrangements', name: 'Antagonists', help: 'the upper one lifts the load against the lower one, which has 2 kV', values: {'stack.series': '2', 'stack.distance': '20 mm', 'stack.lower_voltage': '2 kV', 'load.mass': '0.5 g', 'liquid.model': 'submerged', 'mesh.nodes': '31'}},
  {of: 'Arrangements', name: 'Off the centre', help: 'a load 2 mm right of the centre of a platform that may turn', values: {'actuator.symmetry': 'none', 'platform.rotates': 'true', 'platform.electrode': 'false', 'load.offset': '2 mm', 'liquid.model': 'none', 'mesh.nodes': '31'}},
  {of: 'Arrangements', name: 'Leaning', help: 'gravity points 60 degrees to the right of downwards; a spring opens the actuator', values: {'actuator.symmetry': 'none', 'mount.tilt': '60 degree', 'load.mass': '4 g', 'load.stiffness': '5 N/m', 'load.rest_opening': '20 mm', 'drive.voltage': '8 kV', 'liquid.model': 'none', 'mesh.nodes': '31'}},
  {of: 'Arrangements', name: 'Fold', help: 'electro-origami: a strip zips onto a plate about a hinge with a spring', values: {'actuator.kind': 'hinge', 'ribbon.length': '40 mm', 'ribbon.thickness': '1 mm', 'lower.ribbon.thickness': '100 um', 'hinge.stiffness': '0.4 mN m/rad', 'hinge.rest_angle': '20 degree', 'load.mass': '0 g', 'drive.voltage': '8 kV'}},
  {of: 'Arrangements', name: 'Curved electrode', help: 'a strip in a bath zips onto a cam, from its clamp on', values: {'actuator.kind': 'curved', 'liquid.model': 'submerged', 'drive.voltage': '3 kV'}},
  {of: 'Arrangements', name: 'Plate', help: 'a rigid plate on a spring pulls in to a stop, as in micromechanics, but large enough to see', values: {'actuator.kind': 'plate', 'ribbon.length': '60 mm', 'ribbon.width': '20 mm', 'ribbon.thickness': '0.5 mm', 'insulator.thickness': '50 um', 'medium.material': 'silicone_oil_5cst', 'plate.gap': '2 mm', 'plate.stop_gap': '0.2 mm', 'plate.stiffness': '20 N/m', 'drive.voltage': '2 kV'}},
  {of: 'Arrangements', name: 'Pouch', help: 'Peano-HASEL: electrodes that zip together squeeze liquid down and pull the load up', values: {'actuator.kind': 'pouch', 'mesh.nodes': '101'}},
  {of: 'Arrangements', name: 'Pre-opened', help: 'ribbons bowed apart near the clips are open without a load', values: {'segment_1.length': '20 mm', 'segment_1.curvature': '5 1/m', 'load.mass': '2 g', 'liquid.model': 'none'}},
  {of: 'Arrangements', name: 'Curling layers', help: 'a layer near the clips curls the ribbons apart with the voltage, 20 ms later: they open first, and then zip', values: {'segment_1.length': '20 mm', 'segment_1.curvature_per_volt': '0.001 1/m/V', 'segment_1.curvature_lag': '20 ms', 'load.mass': '2 g', 'drive.voltage': '8 kV', 'liquid.model': 'none'}},
  {of: 'Networks', name: 'Tree', help: 'a bar, and on it two hands of 6 g and 8 g: each actuator lifts all below it', values: {...body(1, {mass: '4 g'}), ...body(2, {mass: '6 g', 'at.x': '-110 mm'}), ...body(3, {mass: '8 g', 'at.x': '110 mm'}), ...member(1, 0, 1, {'ribbon.width': '40 mm'}), ...member(2, 1, 2), ...member(3, 1, 3), 'mesh.nodes': '31'}},
  {of: 'Networks', name: 'Joint', help: 'antagonists turn a forearm on its pivot: the left one has 5 kV, the right one nothing', values: {...body(1, {...plane, mass: '12 g', inertia: '2000 g mm2', 'at.y': '-8 mm'}), ...joint(1, 0, 1, 0, 6), ...member(1, 0, 1, {'upper_at.x': '-60 mm', 'lower_at.x': '-60 mm'}), ...member(2, 0, 1, {'upper_at.x': '60 mm', 'lower_at.x': '60 mm', 'drive.voltage': '0 kV'}), 'drive.voltage': '5 kV', 'damping.drag': '0.02 N s2/m2', 'mesh.nodes': '31'}},
  {of: 'Networks', name: 'Gripper', help: 'actuators lift two fingers on pins, which close on a soft block', values: {...body(1, {...plane, mass: '5 g', inertia: '6000 g mm2', 'at.x': '-50 mm', 'at.y': '-8 mm'}), ...body(2, {...plane, mass: '5 g', inertia: '6000 g mm2', 'at.x': '50 mm', 'at.y': '-8 mm'}), ...joint(1, 0, 1, -110, -8), ...joint(2, 0, 2, 110, -8), ...member(1, 0, 1, {'upper_at.x': '-55 mm', 'lower_at.x': '-5 mm'}), ...member(2, 0, 2, {'upper_at.x': '55 mm', 'lower_at.x': '5 mm'}), ...diagonal(1, -54, -70), ...diagonal(2, -70, -54), 'drive.voltage': '5 kV', 'damping.drag': '0.02 N s2/m2', 'mesh.nodes': '31'}},
  {of: 'Networks', name: 'Inchworm', help: 'Step plays three channels: pads grip the floor in turn while the body contracts and extends', values: inchworm},
];

const usualFactor = 10; // of slow motion

/** => "#load.mass=8g&…&slow=20"; without the blank between number and unit. */
export function toAddress(values, slow) {
  const pairs = [...values].map(([key, text]) => `${key}=${encodeURIComponent(text.replace(' ', ''))}`);
  return `#${[...pairs, ...(slow === usualFactor ? [] : [`slow=${slow}`])].join('&')}`;
}

/** The reverse; without a scenario the initial one. The core refuses text that is not key=value. */
export function fromAddress(hash) {
  const values = new Map(hash.replace(/^#/, '').split('&').filter(Boolean).map((pair) => {
    const [key, ...text] = pair.split('=').map(decode);
    return [key, text.join('=')];
  }));
  const slow = Number(values.get('slow') ?? usualFactor);
  values.delete('slow');
  return {values: values.size ? values : beginning, slow};
}

/** The text as typed, if it is not encoded. */
function decode(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** Keys of the resolved scenario that differ from the defaults of the command => [[key, text]]. */
export function changed(core) {
  return core.settings().filter(({value, default: def}) => !Object.is(value, def)).map(({name, text}) => [name, text]);
}

/** The scenario for a command line. */
export function toCommand(core) {
  const settings = changed(core).map(([key, text]) => `  --set "${key}=${text}"`);
  return ['zipact actuate', ...settings].join(' \\\n');
}

/** The message about a computation that was stopped after `seconds`, in which it simulated `moved` seconds. */
export function tooLong(core, {seconds, moved}) {
  const after = `Stopped after ${seconds} s of computing${moved ? `, which simulated only ${brief(moved)}` : ''}`;
  const unusual = changed(core).filter(([key]) => !/^(study|preset)$/.test(key)).map(([key, text]) => `${key}=${text}`);
  if (!unusual.length) return `${after}.`;
  const shown = unusual.slice(0, 6).join(', ') + (unusual.length > 6 ? ' and more' : '');
  return `${after}. Keys that differ from the defaults: ${shown}. Change one of these, or choose a preset.`;
}

/** s => "3.1 us" */
function brief(time) {
  const [unit, size] = [['ms', 1e-3], ['us', 1e-6], ['ns', 1e-9], ['ps', 1e-12]].find(([, s]) => time >= s) ?? ['fs', 1e-15];
  return `${Number((time / size).toPrecision(2))} ${unit}`;
}

/** A list of states with a current one. Consecutive changes of the same kind count as one. */
export class History {
  #states;
  #at = 0;
  #kind = null;

  constructor(state) {
    this.#states = [state];
  }

  get present() {
    return this.#states[this.#at];
  }

  get canUndo() {
    return this.#at > 0;
  }

  get canRedo() {
    return this.#at + 1 < this.#states.length;
  }

  /** `kind` groups changes, such as those of one drag of a slider; null: none. */
  add(state, kind = null) {
    const joins = kind !== null && kind === this.#kind;
    if (!joins) this.#at++;
    this.#states.length = this.#at;
    this.#states[this.#at] = state;
    this.#kind = kind;
  }

  /** The current change ends: the next one is separate. */
  close() {
    this.#kind = null;
  }

  undo() {
    this.close();
    if (this.canUndo) this.#at--;
    return this.present;
  }

  redo() {
    this.close();
    if (this.canRedo) this.#at++;
    return this.present;
  }
}
