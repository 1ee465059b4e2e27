// The form: sliders and presets made from lists, each within the range of its key.
import {digits, pretty} from './numbers.js';

/** "0.1 m" in the unit of the key, "mm": the number of the slider. */
function inShown(core, name, value) {
  return Number.parseFloat(core.print(name, value));
}

export class Sliders {
  #core;
  #rows = new Map();
  #changed;

  /** `changed` gets (key, text) during a drag, `done` is called at its end. */
  constructor(place, core, list, changed, done) {
    this.#core = core;
    this.#changed = changed;
    for (const spec of list) this.#rows.set(spec.key, this.#row(place, spec, done));
  }

  #row(place, spec, done) {
    const key = this.#core.keys.get(spec.key), id = spec.key.replace('.', '-');
    const row = document.createElement('div'), label = document.createElement('label');
    const input = document.createElement('input'), output = document.createElement('output');
    row.className = 'slider';
    label.htmlFor = input.id = id;
    label.textContent = spec.label;
    row.title = `${spec.key}: ${key.help}`;
    output.htmlFor = id;
    Object.assign(input, {type: 'range', step: spec.log ? 'any' : spec.step});
    const number = () => (spec.log ? Number((10 ** input.value).toPrecision(3)) : Number(input.value));
    const text = () => (key.shown ? `${number()} ${key.shown}` : `${number()}`);
    input.addEventListener('input', () => this.#changed(spec.key, text()));
    input.addEventListener('change', done);
    row.append(label, output, input);
    const auto = Number.isNaN(key.default) ? this.#auto(spec, done) : null;
    if (auto) output.before(auto);
    place.append(row);
    return {spec, key, row, input, output, auto};
  }

  /** The button that sets a key back to auto. */
  #auto(spec, done) {
    const button = document.createElement('button');
    Object.assign(button, {type: 'button', className: 'auto', textContent: 'auto', title: `${spec.label}: auto, the default`});
    button.addEventListener('click', () => {
      this.#changed(spec.key, 'auto');
      done();
    });
    return button;
  }

  /** Show the scenario of the core: auto with the value that it means. A value outside the usual range extends the
   * range. */
  show() {
    for (const {spec, key, row, input, output, auto} of this.#rows.values()) {
      row.hidden = spec.acts ? !spec.acts(this.#core) : false;
      const value = this.#core.effective(spec.key), number = inShown(this.#core, spec.key, value);
      const given = !Number.isNaN(this.#core.value(spec.key));
      const least = Math.max(Math.min(spec.min, number), inShown(this.#core, spec.key, key.min));
      const most = Math.min(Math.max(spec.max, number), inShown(this.#core, spec.key, key.max));
      const at = (v) => (spec.log ? Math.log10(v) : v);
      input.min = at(least);
      input.max = at(most);
      input.step = Number.isInteger(Math.round((1e6 * (number - least)) / spec.step) / 1e6) ? spec.step : 'any';
      input.value = at(number);
      if (auto) auto.hidden = !given;
      const words = pretty(this.#core.print(spec.key, value)), text = given ? words : `auto (${words})`;
      if (output.textContent === text) continue;
      output.textContent = text;
      input.setAttribute('aria-valuetext', text);
    }
  }
}

/** A list of the words of a key, with a line of help for the chosen one. */
export class Choice {
  #core;
  #key;
  #select = document.createElement('select');
  #line = document.createElement('p');

  /** spec: {key, label, words}; `choose` gets the chosen word. */
  constructor(place, core, {key, label, words = {}}, choose) {
    this.#core = core;
    this.#key = core.keys.get(key);
    const row = document.createElement('div'), name = document.createElement('label');
    row.className = 'choice';
    row.title = `${key}: ${this.#key.help}`;
    name.textContent = label;
    name.htmlFor = this.#select.id = key.replace('.', '-');
    for (const {word} of this.#key.choices) this.#select.append(new Option((words[word] ?? word).replaceAll('_', ' '), word));
    this.#select.addEventListener('change', () => choose(this.#select.value));
    row.append(name, this.#select, this.#line);
    place.append(row);
  }

  /** `more`: a text in addition to the help of the word; null: none. */
  show(more = null) {
    const chosen = this.#key.choices[this.#core.value(this.#key.name)];
    this.#select.value = chosen.word;
    this.#line.textContent = more ?? chosen.help;
  }
}

/** Buttons, one per preset, grouped by topic; `choose` gets the values of the preset. */
export function makePresets(place, presets, choose) {
  const rows = new Map();
  for (const {of, name, help, values} of presets) {
    if (!rows.has(of)) rows.set(of, presetRow(place, of));
    const button = document.createElement('button');
    Object.assign(button, {type: 'button', textContent: name, title: help});
    button.addEventListener('click', () => choose(new Map(Object.entries(values))));
    rows.get(of).append(button);
  }
}

function presetRow(place, of) {
  const row = document.createElement('div'), words = document.createElement('p');
  row.setAttribute('role', 'group');
  row.setAttribute('aria-label', words.textContent = of);
  place.append(words, row);
  return row;
}

/** Slow motion: a slider over a list of round factors. */
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

  /** `pace`: fraction of that speed that this machine reaches. */
  show(pace) {
    const text = pace > 0.9 ? `${this.factor}×` : `≈ ${digits(this.factor / pace, 2)}×`;
    if (this.output.textContent === text) return;
    this.output.textContent = text;
    this.output.title = pace > 0.9 ? '' : 'as fast as this machine computes';
    this.input.setAttribute('aria-valuetext', `${this.factor} times slower`);
  }
}
