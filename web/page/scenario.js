// The scenario of the page: which keys have sliders, presets, text for the command, the address after #, undo.

/** Where the page starts: at the command's defaults. */
export const beginning = new Map();

/** Sliders in their order: range and step in the key's own unit, within the key's own range. */
export const sliders = [
  {key: 'drive.voltage', label: 'Voltage', min: 0, max: 12, step: 0.1},
  {key: 'load.mass', label: 'Load', min: 0, max: 100, step: 0.5},
  {key: 'ribbon.thickness', label: 'Steel thickness', min: 20, max: 200, step: 1},
  {key: 'ribbon.length', label: 'Length', min: 40, max: 200, step: 1},
  {key: 'ribbon.width', label: 'Width', min: 4, max: 40, step: 0.1},
  {key: 'insulator.thickness', label: 'Insulator thickness', min: 10, max: 400, step: 5},
  {key: 'insulator.permittivity', label: 'Insulator permittivity', min: 1, max: 12, step: 0.01},
  {key: 'medium.permittivity', label: 'Liquid permittivity', min: 1, max: 10, step: 0.05},
  {key: 'medium.breakdown_field', label: 'Liquid breakdown', min: 1, max: 60, step: 0.5},
  {key: 'damping.internal', label: 'Damping', min: 0, max: 1000, step: 10},
];

/** Values in the sliders' own order of keys. A preset replaces the whole scenario. */
export const presets = [
  {name: 'The paper’s', help: '50 µm steel lifts 8 g', values: {}},
  {name: 'Thin and far', help: '20 µm steel: the largest stroke', values: {'ribbon.thickness': '20 um', 'load.mass': '1 g', 'drive.voltage': '8 kV'}},
  {name: 'Thick and strong', help: '200 µm steel lifts 100 g, by 2 mm', values: {'ribbon.thickness': '200 um', 'load.mass': '100 g'}},
  {name: 'Too heavy', help: '30 g: it does not close', values: {'load.mass': '30 g'}},
  {name: 'In air', help: 'no liquid: a sixth of the breakdown field', values: {'medium.permittivity': '1', 'medium.breakdown_field': '3 MV/m'}},
];

const usualFactor = 10; // of slow motion

/** => "#load.mass=8g&…&slow=20"; the blank between number and unit is left out. */
export function toAddress(values, slow) {
  const pairs = [...values].map(([key, text]) => `${key}=${encodeURIComponent(text.replace(' ', ''))}`);
  return `#${[...pairs, ...(slow === usualFactor ? [] : [`slow=${slow}`])].join('&')}`;
}

/** The other way; without a scenario that of the beginning. What is no key=value is left for the core to refuse. */
export function fromAddress(hash) {
  const values = new Map(hash.replace(/^#/, '').split('&').filter(Boolean).map((pair) => {
    const [key, ...text] = pair.split('=').map(decode);
    return [key, text.join('=')];
  }));
  const slow = Number(values.get('slow') ?? usualFactor);
  values.delete('slow');
  return {values: values.size ? values : beginning, slow};
}

/** As it was typed, where it is not encoded. */
function decode(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** Keys of the resolved scenario that are not the command's defaults => [[key, text]]. */
export function changed(core) {
  return [...core.keys.values()]
    .filter(({name, default: def}) => !Object.is(core.value(name), def))
    .map(({name}) => [name, core.print(name, core.value(name))]);
}

/** The scenario for a command line. */
export function toCommand(core) {
  const settings = changed(core).map(([key, text]) => `  --set "${key}=${text}"`);
  return ['zipact actuate', ...settings].join(' \\\n');
}

/** What to do about a computation that was stopped after `seconds`, having `moved` the actuator for so many seconds of its time. */
export function tooLong(core, {seconds, moved}) {
  const after = `Stopped after ${seconds} s of computing${moved ? `, which gave only ${brief(moved)} of motion` : ''}`;
  const unusual = changed(core).filter(([key]) => !/^(study|preset)$/.test(key)).map(([key, text]) => `${key}=${text}`);
  if (!unusual.length) return `${after}.`;
  const shown = unusual.slice(0, 6).join(', ') + (unusual.length > 6 ? ' and more' : '');
  return `${after}. Asked for: ${shown}. Change one of these, or choose a preset.`;
}

/** s => "3.1 us" */
function brief(time) {
  const [unit, size] = [['ms', 1e-3], ['us', 1e-6], ['ns', 1e-9], ['ps', 1e-12]].find(([, s]) => time >= s) ?? ['fs', 1e-15];
  return `${Number((time / size).toPrecision(2))} ${unit}`;
}

/** A list of states with a present one. Changes of the same kind that follow each other are one. */
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

  /** `kind` says what the change belongs to, such as one drag of a slider; null: to nothing. */
  add(state, kind = null) {
    const joins = kind !== null && kind === this.#kind;
    if (!joins) this.#at++;
    this.#states.length = this.#at;
    this.#states[this.#at] = state;
    this.#kind = kind;
  }

  /** The change under way is over: the next one is another. */
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
