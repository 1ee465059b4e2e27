// Colours of style.css for the canvas, and the colour scale of the field.

export const colours = 6; // of curves of several parts
const parts = Array.from({length: colours}, (_, k) => `part-${k}`);
const names = ['paper', 'panel', 'ink', 'soft', 'line', 'accent', 'warm', 'metal', 'insulator', 'load', 'bath', ...parts];
const shades = 256;

function parse(colour) {
  return [1, 3, 5].map((at) => parseInt(colour.slice(at, at + 2), 16));
}

/** stops "#rrggbb" => `shades` colours between them. */
function ramp(stops) {
  return Array.from({length: shades}, (_, k) => {
    const place = (k / (shades - 1)) * (stops.length - 1), at = Math.min(Math.floor(place), stops.length - 2);
    const [from, to] = [parse(stops[at]), parse(stops[at + 1])];
    const mixed = from.map((c, i) => Math.round(c + (to[i] - c) * (place - at)));
    return `rgb(${mixed.join(' ')})`;
  });
}

export const theme = {colour: {}, shades: []};

function read() {
  const style = getComputedStyle(document.documentElement);
  const get = (name) => style.getPropertyValue(`--${name}`).trim();
  for (const name of names) theme.colour[name] = get(name);
  theme.shades = ramp([0, 1, 2, 3, 4].map((k) => get(`field-${k}`)));
}

read();
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', read);

/** share of the largest field, 0 .. 1 => colour; by its square root, so that weak fields show, too */
export function shade(share) {
  return theme.shades[Math.round(Math.sqrt(Math.min(Math.max(share, 0), 1)) * (shades - 1))];
}
