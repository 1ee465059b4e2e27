// What the picture shows, in metres from the middle of the upper platform, y up: the halves of every actuator of a
// frame, platforms, mounts and load.

const clip = 3.5e-3; // length of a clip
const between = 10e-3; // of two actuators side by side
const mostColumns = 5; // equal parallel actuators that are drawn; of more only one

/** How the arrays of a member are laid out: `last`, the station of the left half at the platform, counted from the clip;
 * is the right half modelled, too (`whole`), or is there one ribbon pair on a `hinge` without a platform; lengths, m. */
function layoutOf(frame) {
  const nodes = frame.get('nodes'), whole = frame.get('halves') === 2, hinge = frame.get('halves') === 0;
  const platform = hinge ? 0 : frame.get('platform.length'), ribbon = frame.get('ribbon.length');
  const last = (whole ? nodes / 2 : nodes) - 1, length = hinge ? ribbon : (ribbon - platform) / 2;
  return {nodes, whole, hinge, platform, last, length, l: length / last};
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
 * its points `first` .. `last`. gap, lineForce, film, pressure and field at its stations; `wetStations` and `wetEnd` where a
 * bead ends, as a number of stations and of points, Infinity if nowhere. */
function halfOf(frame, layout, member, right) {
  const {nodes, whole, hinge, platform, last, length, l} = layout;
  const at = Array.from({length: last + 1}, (_, i) => (right && whole ? nodes - 1 - i : i));
  const mirror = right && !whole ? -1 : 1, outward = right ? 1 : -1, first = hinge ? 0 : 1;
  const x = [], y = [];
  for (const r of [0, 1]) {
    x[r] = at.map((i) => mirror * (member.x[2 * i + r] - member.middle));
    y[r] = at.map((i) => member.y[2 * i + r]);
    if (hinge) continue;
    const [a, b] = member.platforms[r];
    x[r] = [x[r][0] + outward * clip, ...x[r], (a.x + b.x) / 2];
    y[r] = [y[r][0], ...y[r], (a.y + b.y) / 2];
  }
  const wet = member.wet[whole && right ? 1 : 0] / l;
  const below = wet > last ? last + ((wet - last) * l) / (platform / 2 || 1) : wet; // as if the platform were one station more
  const take = (of) => Float64Array.from(at, (i) => of[i]);
  const half = {
    x, y, first, last: first + last, length, outward, wetStations: wet, wetEnd: first + below,
    gap: take(member.gap), lineForce: take(member.lineForce), film: take(member.film), pressure: take(member.pressure),
  };
  half.field = fieldOf(frame, member, half);
  return half;
}

/** The upper and the lower platform, each as its left and right end; none on a hinge. */
function platformsOf({whole, hinge, platform, last}, member) {
  if (hinge) return [];
  const point = (r, i) => ({x: member.x[2 * i + r] - member.middle, y: member.y[2 * i + r]});
  return [0, 1].map((r) => {
    const left = point(r, last);
    return [left, whole ? point(r, last + 1) : {x: left.x + platform, y: left.y}];
  });
}

function memberOf(frame, layout, k, bead) {
  const {upperInsulator, lowerInsulator, upperMetal, lowerMetal, wetLength, ...member} = frame.member(k);
  const {hinge, platform, last, length} = layout;
  member.middle = hinge ? length / 2 : member.x[2 * last] + platform / 2;
  member.wet = bead ? wetLength : [Infinity, Infinity];
  member.platforms = platformsOf(layout, member);
  return {
    halves: (hinge ? [false] : [false, true]).map((right) => halfOf(frame, layout, member, right)),
    platforms: member.platforms,
    insulator: [upperInsulator, lowerInsulator],
    metal: [upperMetal, lowerMetal],
    turned: frame.get('stack.distance') > 0 && k > 0,
  };
}

/** Horizontal places of actuators side by side: of each member where they share one floor, of its copies on each floor. */
function placesOf(frame, members, pitch) {
  const parallel = frame.get('stack.parallel'), abreast = members > 1 && frame.get('stack.series') === 1;
  const columns = abreast ? members : parallel <= mostColumns ? parallel : 1;
  const place = (column) => (column - (columns - 1) / 2) * pitch;
  return {abreast, columns, of: (k) => (abreast ? [place(k)] : Array.from({length: columns}, (_, column) => place(column)))};
}

/** The ends of what carries the load: of the lower platform, on a hinge both the end of the lower ribbon. */
function loadedEnds({platforms, halves: [{x, y}]}) {
  const end = {x: x[1].at(-1), y: y[1].at(-1)};
  return platforms[1] ?? [end, end];
}

/** The lowest point of all ribbons, 0 if they are above. */
function lowestOf(members) {
  let lowest = 0;
  for (const {y} of members.flatMap(({halves}) => halves))
    for (const height of y.flat()) lowest = Math.min(lowest, height);
  return lowest;
}

/** (frame, is there a bead?) => all that is drawn of it. */
export function geometryOf(frame, bead) {
  const count = frame.get('members'), layout = layoutOf(frame), {hinge} = layout;
  const distance = frame.get('stack.distance'), opposed = distance > 0;
  const reach = frame.get('ribbon.length') / 2 + (hinge ? 0 : clip), pitch = 2 * reach + between, places = placesOf(frame, count, pitch);
  const members = Array.from({length: count}, (_, k) => ({...memberOf(frame, layout, k, bead), places: places.of(k)}));
  const loaded = members[opposed ? 0 : count - 1], [left, right] = loadedEnds(loaded);
  const middle = {x: (left.x + right.x) / 2, y: (left.y + right.y) / 2}, tilt = Math.atan2(right.y - left.y, right.x - left.x);
  const offset = frame.get('load.offset');
  return {
    members, hinge, opposed, columns: places.columns,
    joined: places.columns > 1 ? {from: places.of(0)[0], to: places.of(count - 1).at(-1)} : null, // rigid links of columns
    reach: reach + ((places.columns - 1) / 2) * pitch,
    bottom: opposed ? Math.min(lowestOf(members), -distance) : lowestOf(members),
    mounts: opposed ? [0, -distance] : [0], // heights
    load: {x: middle.x + offset * Math.cos(tilt), y: middle.y + offset * Math.sin(tilt)},
    gravity: frame.get('mount.tilt'),
    openingAt: right.x + 3e-3,
    focus: places.abreast ? members[0] : loaded, // the member that lens and profiles show, in its left half
  };
}
