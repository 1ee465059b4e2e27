// The plots. uPlot makes axes and scales; curves are drawn here, because branches turn back in voltage.
import uPlot from 'uplot';
import {axisEnds} from './numbers.js';
import {colours, theme} from './theme.js';

/** Draw xs, ys over scale `y` of `plot`, with gaps at NaN. */
function curve(plot, xs, ys, {colour, width = 2, dash = [], y = 'y'}) {
  const context = plot.ctx, ratio = devicePixelRatio;
  context.save();
  context.strokeStyle = theme.colour[colour];
  context.lineWidth = width * ratio;
  context.lineJoin = 'round';
  context.setLineDash(dash.map((length) => length * ratio));
  context.beginPath();
  for (let k = 0, on = false; k < xs.length; on = !Number.isNaN(ys[k++])) {
    if (Number.isNaN(ys[k])) continue;
    const to = [plot.valToPos(xs[k], 'x', true), plot.valToPos(ys[k], y, true)];
    if (on) context.lineTo(...to);
    else context.moveTo(...to);
  }
  context.stroke();
  context.restore();
}

function dot(plot, x, y, colour) {
  const context = plot.ctx, ratio = devicePixelRatio;
  context.save();
  context.fillStyle = theme.colour[colour];
  context.strokeStyle = theme.colour.panel;
  context.lineWidth = 2 * ratio;
  context.beginPath();
  context.arc(plot.valToPos(x, 'x', true), plot.valToPos(y, 'y', true), 5.5 * ratio, 0, 2 * Math.PI);
  context.fill();
  context.stroke();
  context.restore();
}

/** Numbers beside an axis, short enough for the margin. */
const ticks = (values) => values.map((v) => (v === null ? '' : Math.abs(v) < 1e6 ? String(Number(v.toPrecision(6))) : v.toExponential()));

const axis = (label, more = {}) => ({
  label,
  labelSize: 20,
  labelFont: '12px system-ui, sans-serif',
  font: '12px system-ui, sans-serif',
  stroke: () => theme.colour.soft,
  grid: {stroke: () => theme.colour.line, width: 1},
  ticks: {show: false},
  values: (_, values) => ticks(values),
  ...more,
});

/** A plot in `place`: `ends` gives both ends of each scale, of which some are `logarithmic`; `paint` draws its curves. */
class Plot {
  #plot;
  #data;

  constructor(place, axes, ends, paint, logarithmic = []) {
    const scales = Object.keys(axes);
    this.place = place;
    this.#data = scales.map(() => [0, 1]);
    this.#plot = new uPlot({
      ...this.#size({width: 0, height: 0}), // until the observer knows it: to ask the page here would lay it out once a plot
      legend: {show: false},
      cursor: {show: false},
      padding: [8, 18, 0, 0],
      scales: Object.fromEntries(scales.map((name) => [name, {time: false, range: () => ends()[name], ...(logarithmic.includes(name) ? {distr: 3} : {})}])),
      series: scales.map((name) => (name === 'x' ? {} : {scale: name, paths: () => null, points: {show: false}})),
      axes: scales.map((name) => ({...axes[name], scale: name})),
      hooks: {draw: [paint]},
    }, this.#data, place);
    new ResizeObserver(([{contentRect}]) => this.#plot.setSize(this.#size(contentRect))).observe(place);
  }

  #size({width, height}) {
    return {width: Math.max(width, 200), height: Math.max(height, 60)};
  }

  update() {
    if (!this.place.clientHeight) return; // not shown
    this.#plot.setData(this.#data);
  }
}

const scaled = (values, factor) => Array.from(values, (value) => value * factor);

/** How curve k of several is drawn, and its item in a legend. */
export const styleOf = (k, several = true) => (several ? {colour: `part-${k % colours}`, dash: [[], [7, 4], [2, 3]][Math.floor(k / colours) % 3]} : {colour: 'accent'});

/** Values over time, of the live simulation and in `run`, if there is one, of study actuate: each a list `of` curves over
 * `time`. `label` and `factor`, from SI, are of the y axis. */
export function timePlot(place, data) {
  const all = () => [...(data.run?.of ?? []), ...data.live.of].map((of) => scaled(of, data.factor));
  const ends = () => ({x: axisEnds([data.run, data.live].map((c) => 1e3 * (c?.time.at(-1) ?? 0)), [10]), y: axisEnds(...all(), [data.least])});
  return new Plot(place, {x: axis('time / ms', {size: 34}), y: axis(() => data.label, {size: 44})}, ends, (plot) => {
    const {run, live, factor} = data, several = live.of.length > 1, x = scaled(live.time, 1e3);
    run?.of.forEach((of, k) => curve(plot, scaled(run.time, 1e3), scaled(of, factor), {...styleOf(k, several), ...(several ? {} : {colour: 'soft'}), width: 1, dash: [5, 4]}));
    live.of.forEach((of, k) => {
      curve(plot, x, scaled(of, factor), {...styleOf(k, several), width: several ? 2 : 2.5});
      if (x.length) dot(plot, x.at(-1), factor * of.at(-1), styleOf(k, several).colour);
    });
  });
}

/** Consecutive points of one branch with the same stability; each piece includes the first point of the next one. */
export function pieces({branch, stable}) {
  const found = [];
  for (let k = 0, start = 0; k < branch.length; k++) {
    const ends = k + 1 === branch.length || branch[k + 1] !== branch[k];
    if (!ends && stable[k + 1] === stable[k]) continue;
    found.push({from: start, to: ends ? k + 1 : k + 2, stable: stable[k] !== 0});
    start = k + 1;
  }
  return found;
}

/** Stroke, or openings of members, over voltage: all equilibria, and the current state. */
export function voltagePlot(place, data) {
  const ends = () => ({
    x: axisEnds([data.highest / 1e3]),
    y: axisEnds(...[...(data.rest?.of ?? []), ...data.live.of].map((of) => scaled(of, 1e3)), [1e-3]),
  });
  return new Plot(place, {x: axis('voltage / kV', {size: 34}), y: axis(() => data.label, {size: 44})}, ends, (plot) => {
    const {rest, live, now} = data, several = live.of.length > 1;
    rest?.of.forEach((of, k) => {
      const x = scaled(rest.voltage, 1e-3), y = scaled(of, 1e3), {colour} = styleOf(k);
      for (const {from, to, stable} of pieces(rest))
        curve(plot, x.slice(from, to), y.slice(from, to),
          stable ? {colour: several ? colour : 'ink'} : {colour: several ? colour : 'warm', width: several ? 1 : 1.5, dash: [4, 4]});
    });
    live.of.forEach((of, k) => dot(plot, now / 1e3, 1e3 * of.at(-1), styleOf(k, several).colour));
  });
}

/** The design chart: the largest load that closes, over voltage, dashed for an older scenario; and the point of the scenario. */
export function chartPlot(place, data) {
  const ends = () => ({x: axisEnds([data.volts.at(-1) / 1e3]), y: axisEnds(scaled(data.y, 1e3).filter((v) => v > 0), [1e3 * data.mass, 1e-3])});
  return new Plot(place, {x: axis('voltage / kV', {size: 34}), y: axis('load / g', {size: 44})}, ends, (plot) => {
    const x = scaled(data.volts, 1e-3), fresh = data.y.map((load, k) => (data.fresh(k) ? 1e3 * load : NaN));
    if (fresh.some(Number.isNaN)) curve(plot, x, scaled(data.y, 1e3), {colour: 'soft', width: 1.5, dash: [5, 4]});
    curve(plot, x, fresh, {colour: 'accent', width: 2.5});
    dot(plot, data.voltage / 1e3, 1e3 * data.mass, 'warm');
  });
}

/** Powers of ten around all values above 0. */
function decades(values) {
  const there = values.filter((v) => v > 0), log = (v) => Math.log10(v);
  if (!there.length) return [1, 10];
  const low = Math.floor(log(Math.min(...there)) + 1e-9), high = Math.ceil(log(Math.max(...there)) - 1e-9);
  return [10 ** low, 10 ** Math.max(high, low + 1)];
}

/** Current out of the source, voltage of the electrodes, and command to the source. */
export function currentPlot(place, data) {
  const ends = () => ({
    x: axisEnds([1e3 * (data.trace.time.at(-1) ?? 0), 10]),
    current: axisEnds(scaled(data.trace.current, 1e6), [1]),
    voltage: axisEnds(scaled(data.trace.voltage, 1e-3), scaled(data.trace.command, 1e-3), [1]),
  });
  const axes = {
    x: axis('time / ms', {size: 34}),
    current: axis('current / µA', {size: 50, stroke: () => theme.colour.accent}),
    voltage: axis('voltage / kV', {side: 1, grid: {show: false}, size: 40, stroke: () => theme.colour.warm}),
  };
  return new Plot(place, axes, ends, (plot) => {
    const x = scaled(data.trace.time, 1e3);
    curve(plot, x, scaled(data.trace.command, 1e-3), {colour: 'soft', width: 1.5, dash: [5, 4], y: 'voltage'});
    curve(plot, x, scaled(data.trace.voltage, 1e-3), {colour: 'warm', width: 2, y: 'voltage'});
    curve(plot, x, scaled(data.trace.current, 1e6), {colour: 'accent', width: 2, y: 'current'});
  });
}

/** Pressure and thickness of the film of liquid, from the clip to where it ends. */
export function liquidPlot(place, data) {
  const ends = () => ({
    x: axisEnds([1e3 * data.length]),
    pressure: axisEnds(scaled(data.pressure, 1e-3), [0.1]),
    film: decades(scaled(data.film, 1e6)),
  });
  const axes = {
    x: axis('from the clip / mm', {size: 34}),
    pressure: axis('pressure / kPa', {size: 50, stroke: () => theme.colour.accent}),
    film: axis('film / µm', {side: 1, grid: {show: false}, size: 46, stroke: () => theme.colour.warm}),
  };
  return new Plot(place, axes, ends, (plot) => {
    const n = data.film.length, x = Array.from({length: n}, (_, i) => (1e3 * data.length * i) / (n - 1));
    const there = (values) => Array.from(values, (value, i) => (data.film[i] > 0 ? value : NaN));
    curve(plot, x, there(scaled(data.film, 1e6)), {colour: 'warm', width: 2, y: 'film'});
    curve(plot, x, there(scaled(data.pressure, 1e-3)), {colour: 'accent', width: 2.5, y: 'pressure'});
  }, ['film']);
}

/** Attraction per length and field in the liquid, from the clip to the platform. */
export function profilePlot(place, data) {
  const ends = () => ({x: axisEnds([1e3 * data.length]), force: axisEnds(data.force, [1]), field: axisEnds(scaled(data.field, 1e-6), [data.largest / 1e6])});
  const right = {side: 1, grid: {show: false}, size: 40, stroke: () => theme.colour.warm};
  const axes = {
    x: axis('from the clip / mm', {size: 34}),
    force: axis('attraction / N/m', {size: 44, stroke: () => theme.colour.accent}),
    field: axis('field / MV/m', right),
  };
  return new Plot(place, axes, ends, (plot) => {
    const n = data.force.length, x = Array.from({length: n}, (_, i) => (1e3 * data.length * i) / (n - 1));
    curve(plot, x, scaled(data.field, 1e-6), {colour: 'warm', width: 2, y: 'field'});
    curve(plot, x, Array.from(data.force), {colour: 'accent', width: 2.5, y: 'force'});
  });
}
