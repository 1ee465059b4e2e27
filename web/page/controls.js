// The form: sliders and presets made from lists, each within what the core allows.
import {digits, pretty} from './numbers.js';

/** "0.1 m" in the key's own unit, "mm": the number that a slider stands at. */
function inShown(core, name, value) {
  return Number.parseFloat(core.print(name, value));
}

export class Sliders {
  #core;
  #rows = new Map();

  /** `changed` gets (key, text) while one drags, `done` comes when the drag is over. */
  constructor(place, core, list, changed, done) {
    this.#core = core;
    for (const spec of list) this.#rows.set(spec.key, this.#row(place, spec, changed, done));
  }

  #row(place, spec, changed, done) {
    const key = this.#core.keys.get(spec.key), id = spec.key.replace('.', '-');
    const row = document.createElement('div'), label = document.createElement('label');
    const input = document.createElement('input'), output = document.createElement('output');
    row.className = 'slider';
    label.htmlFor = input.id = id;
    label.textContent = spec.label;
    row.title = `${spec.key}: ${key.help}`;
    output.htmlFor = id;
    Object.assign(input, {type: 'range', step: spec.step});
    const text = () => (key.shown ? `${Number(input.value)} ${key.shown}` : `${Number(input.value)}`);
    input.addEventListener('input', () => changed(spec.key, text()));
    input.addEventListener('change', done);
    row.append(label, output, input);
    place.append(row);
    return {spec, key, input, output};
  }

  /** Show the scenario as the core has it. A value beyond the usual range widens it. */
  show() {
    for (const {spec, key, input, output} of this.#rows.values()) {
      const value = this.#core.value(spec.key), number = inShown(this.#core, spec.key, value);
      input.min = Math.max(Math.min(spec.min, number), inShown(this.#core, spec.key, key.min));
      input.max = Math.min(Math.max(spec.max, number), inShown(this.#core, spec.key, key.max));
      input.step = Number.isInteger(Math.round((1e6 * (number - input.min)) / spec.step) / 1e6) ? spec.step : 'any';
      input.value = number;
      const text = pretty(this.#core.print(spec.key, value));
      if (output.textContent === text) continue;
      output.textContent = text;
      input.setAttribute('aria-valuetext', text);
    }
  }
}

/** Buttons, one per preset; `choose` gets its values. */
export function makePresets(place, presets, choose) {
  const row = document.createElement('div');
  for (const {name, help, values} of presets) {
    const button = document.createElement('button');
    Object.assign(button, {type: 'button', textContent: name, title: help});
    button.addEventListener('click', () => choose(new Map(Object.entries(values))));
    row.append(button);
  }
  place.append(row);
}

/** How many times slower than life: a list of round factors on a slider. */
export class SlowMotion {
  static factors = [1, 2, 5, 10, 20, 50, 100, 200, 500];

  constructor(input, output, factor, changed) {
    this.input = input;
    this.output = output;
    input.value = Math.max(SlowMotion.factors.findIndex((f) => f >= factor), 0);
    input.addEventListener('input', () => {
      this.show(1);
      changed();
    });
    this.show(1);
  }

  get factor() {
    return SlowMotion.factors[this.input.value];
  }

  /** `pace`: share of that speed that this machine keeps up. */
  show(pace) {
    const text = pace > 0.9 ? `${this.factor}×` : `≈ ${digits(this.factor / pace, 2)}×`;
    if (this.output.textContent === text) return;
    this.output.textContent = text;
    this.output.title = pace > 0.9 ? '' : 'as fast as this machine computes';
    this.input.setAttribute('aria-valuetext', `${this.factor} times slower`);
  }
}
