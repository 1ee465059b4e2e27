// What the picture shows, in metres from the middle of the upper platform, y up: the halves of every actuator of a
// frame, platforms, mounts and load.

const clip = 3.5e-3; // length of a clip
const between = 10e-3; // of two actuators side by side
const mostColumns = 5; // equal parallel actuators that are drawn; of more only one

/** The stations of one half of a member, from its clip to its platform: indices into its arrays. */
function stationsOf(nodes, whole, right) {
  const count = whole ? nodes / 2 : nodes;
  return Array.from({length: count}, (_, i) => (right && whole ? nodes - 1 - i : i));
}

/** Field between the faces at each station by the plates law, V/m: in the liquid, beyond a bead in air. */
function fieldOf(frame, member, half) {
  const voltage = frame.get('electro.voltage_share') * member.voltage, {offset} = member;
  const cap = (name) => (frame.get('electro.breakdown_cap') ? frame.get(name) : Infinity);
  const liquid = {offset, most: cap('medium.breakdown_field')};
  const air = {offset: offset / frame.get('medium.permittivity'), most: cap('air.breakdown_field')};
  return Float64Array.from(half.gap, (g, i) => {
    const {offset: other, most} = i <= half.wetStations ? liquid : air;
    return Math.min(Math.abs(voltage) / (Math.max(g, 0) + other), most);
  });
}

/** A half: for ribbon 0 and 1 the points x, y from the outer end of the clip to the middle of the platform; stations are
 * its points `first` .. `last`. gap, lineForce, film, pressure and field at its stations; `wetEnd` where a bead ends, as a
 * number of points, Infinity if nowhere. */
function halfOf(frame, member, right) {
  const nodes = frame.get('nodes'), halves = frame.get('halves'), whole = halves === 2, hinge = halves === 0;
  const at = stationsOf(nodes, whole, right), last = at.length - 1, platform = hinge ? 0 : frame.get('platform.length');
  const length = hinge ? frame.get('ribbon.length') : (frame.get('ribbon.length') - platform) / 2, l = length / last;
  const mirror = right && !whole ? -1 : 1, outward = right ? 1 : -1;
  const other = whole ? (r, of) => (of[2 * at[last] + r] + of[2 * (nodes - 1 - at[last]) + r]) / 2 : null;
  const x = [], y = [];
  for (const r of [0, 1]) {
    x[r] = at.map((i) => mirror * (member.x[2 * i + r] - member.middle));
    y[r] = at.map((i) => member.y[2 * i + r]);
    if (hinge) continue;
    x[r].unshift(x[r][0] + outward * clip);
    y[r].unshift(y[r][0]);
    x[r].push(whole ? other(r, member.x) - member.middle : x[r].at(-1) - outward * (platform / 2));
    y[r].push(whole ? other(r, member.y) : y[r].at(-1));
  }
  const wet = member.wet[whole && right ? 1 : 0] / l, first = hinge ? 0 : 1;
  const beyond = wet > last ? last + ((wet - last) * l) / (platform / 2 || 1) : wet;
  const take = (of) => Float64Array.from(at, (i) => of[i]);
  const half = {
    x, y, first, last: first + last, length, outward, wetStations: wet, wetEnd: first + beyond,
    gap: take(member.gap), lineForce: take(member.lineForce), film: take(member.film), pressure: take(member.pressure),
  };
  half.field = fieldOf(frame, member, half);
  return half;
}

/** Both platforms as pairs of points, left and right; for a hinge only that of the lower ribbon's end. */
function platformsOf(frame, member) {
  const nodes = frame.get('nodes'), halves = frame.get('halves'), size = frame.get('platform.length') / 2;
  if (halves === 0) return [];
  const left = halves === 2 ? nodes / 2 - 1 : nodes - 1;
  const point = (r, i) => ({x: member.x[2 * i + r] - member.middle, y: member.y[2 * i + r]});
  return [0, 1].map((r) => {
    const a = point(r, left), b = halves === 2 ? point(r, left + 1) : {x: a.x + 2 * size, y: a.y};
    return [a, b];
  });
}

function memberOf(frame, k, bead) {
  const {upperInsulator, lowerInsulator, upperMetal, lowerMetal, wetLength, ...member} = frame.member(k);
  const nodes = frame.get('nodes'), halves = frame.get('halves'), platform = frame.get('platform.length');
  const last = halves === 2 ? nodes / 2 - 1 : nodes - 1;
  member.middle = halves === 0 ? frame.get('ribbon.length') / 2 : member.x[2 * last] + platform / 2;
  member.wet = bead ? wetLength : [Infinity, Infinity];
  return {
    halves: (halves === 0 ? [false] : [false, true]).map((right) => halfOf(frame, member, right)),
    platforms: platformsOf(frame, member),
    insulator: [upperInsulator, lowerInsulator],
    metal: [upperMetal, lowerMetal],
    turned: frame.get('stack.distance') > 0 && k > 0,
  };
}

/** Horizontal places of actuators side by side: of each member where they share one floor, of its copies on each floor. */
function placesOf(frame, members, pitch) {
  const parallel = frame.get('stack.parallel'), abreast = members > 1 && parallel === members;
  const columns = abreast ? members : parallel <= mostColumns ? parallel : 1;
  const place = (column) => (column - (columns - 1) / 2) * pitch;
  return {abreast, columns, of: (k) => (abreast ? [place(k)] : Array.from({length: columns}, (_, column) => place(column)))};
}

/** (frame, is there a bead?) => all that is drawn of it. */
export function geometryOf(frame, bead) {
  const count = frame.get('members'), hinge = frame.get('halves') === 0, distance = frame.get('stack.distance');
  const members = Array.from({length: count}, (_, k) => memberOf(frame, k, bead));
  const reach = hinge ? frame.get('ribbon.length') / 2 : frame.get('ribbon.length') / 2 + clip;
  const places = placesOf(frame, count, 2 * reach + between), opposed = distance > 0;
  members.forEach((member, k) => (member.places = places.of(k)));
  const loaded = members[opposed ? 0 : count - 1], lowest = members.flatMap(({halves}) => halves.flatMap(({y}) => [...y[0], ...y[1]]));
  const [left, right] = hinge ? [loaded.halves[0], loaded.halves[0]].map(({x, y}) => ({x: x[1].at(-1), y: y[1].at(-1)})) : loaded.platforms[1];
  const middle = {x: (left.x + right.x) / 2, y: (left.y + right.y) / 2}, tilt = Math.atan2(right.y - left.y, right.x - left.x);
  const offset = frame.get('load.offset') || 0;
  return {
    members, hinge, opposed, columns: places.columns,
    joined: places.columns > 1 ? {from: places.of(0)[0], to: places.of(count - 1).at(-1)} : null, // rigid links of columns
    reach: reach + ((places.columns - 1) / 2) * (2 * reach + between),
    bottom: Math.min(0, ...lowest, opposed ? -distance : 0),
    mounts: opposed ? [0, -distance] : [0], // heights
    load: {x: middle.x + offset * Math.cos(tilt), y: middle.y + offset * Math.sin(tilt)},
    gravity: frame.get('mount.tilt') || 0,
    openingAt: hinge ? middle.x + 3e-3 : right.x + 3e-3,
    focus: places.abreast ? members[0] : loaded, // the member that lens and profiles show, in its left half
  };
}
