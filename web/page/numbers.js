// Numbers for people, and the tiles that show them.

/** Three significant digits, no exponent: 0.0787 => "0.0787", 78.72 => "78.7", 5624.5 => "5620". */
export function digits(value, count = 3) {
  if (!Number.isFinite(value)) return '–';
  const rounded = Number(value.toPrecision(count));
  const places = Math.max(0, count - 1 - Math.floor(Math.log10(Math.abs(rounded) || 1)));
  return rounded.toFixed(Math.min(places, count + 2)).replace('-', '−');
}

/** A fixed number of decimals, so that moving numbers do not jump. */
export function fixed(value, places) {
  if (!Number.isFinite(value)) return '–';
  const text = value.toFixed(places);
  return (Number(text) === 0 ? (0).toFixed(places) : text).replace('-', '−');
}

/** The next round number, at least `value`; 0 for NaN and values that are not positive. */
function roundUp(value) {
  if (!(value > 1e-300 && value < Infinity)) return 0;
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].find((step) => step * power >= value * (1 - 1e-9));
}

/** Round ends of an axis for 0 and all values of the lists, so that it does not jump; values below 0 count if they exceed a
 * hundredth of those above. */
export function axisEnds(...lists) {
  let least = 0, most = 0;
  for (const list of lists)
    for (const value of list) { // NaN is neither
      if (value < least) least = value;
      if (value > most) most = value;
    }
  const top = roundUp(most), bottom = -least > most / 100 ? -roundUp(-least) : 0;
  return top > bottom ? [bottom, top] : [0, 1];
}

/** "8 g" in the form of the command => in the form for people: "8 g", "50 µm", "50 mm²/s", "5 MΩ". */
export function pretty(text) {
  return text.replace(/ohm\b/, 'Ω').replace(/\bmm2\b/, 'mm²').replace(/\bu(?=[a-zA-Z])/, 'µ').replace(/ (?=\S)/, ' ').replace('-', '−');
}

/** Tiles of a description list: name => {label, unit, title, study: the name of a study, if not of this instant}. */
export class Tiles {
  #values = new Map();
  #studies = []; // [name, tile]

  constructor(list, tiles) {
    for (const [name, {unit, label, title, study}] of Object.entries(tiles)) {
      const tile = document.createElement('div'), term = document.createElement('dt'), value = document.createElement('dd');
      const number = document.createElement('span'), small = document.createElement('small');
      term.textContent = label;
      tile.title = title;
      tile.classList.toggle('study', Boolean(study));
      if (study) this.#studies.push([study, tile]);
      number.id = `n-${name}`;
      number.textContent = '–';
      small.textContent = ` ${unit}`;
      value.append(number, small);
      tile.append(term, value);
      list.append(tile);
      this.#values.set(name, number);
    }
  }

  /** Are the numbers of a study those of an older scenario? */
  setDue(study, due) {
    for (const [name, tile] of this.#studies) if (name === study) tile.classList.toggle('due', due);
  }

  /** Is there no such number? */
  hide(name, hidden) {
    this.#values.get(name).closest('div').hidden = hidden;
  }

  show(name, text) {
    const number = this.#values.get(name);
    if (number.textContent !== text) number.textContent = text;
  }
}
