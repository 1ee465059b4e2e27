// What the picture shows, in metres from the middle of the upper platform, of a network in those of its drawing, y up:
// the halves of every actuator of a frame, platforms, what holds them, bodies, joints, springs and loads.

const clip = 3.5e-3; // length of a clip
const between = 10e-3; // of two actuators side by side
const mostColumns = 5; // equal parallel actuators that are drawn; of more only one

/** How the arrays of a member are laid out: `last`, the station of the left half at the platform, counted from the clip;
 * is the right half modelled, too (`whole`), or is there one pair of faces on a `hinge` or a clamp, without a platform; lengths, m. */
function layoutOf(frame, {length: ribbon, platform: given}) {
  const nodes = frame.get('nodes'), whole = frame.get('halves') === 2, hinge = frame.get('halves') === 0;
  const platform = hinge ? 0 : given, last = (whole ? nodes / 2 : nodes) - 1, length = hinge ? ribbon : (ribbon - platform) / 2;
  return {nodes, whole, hinge, platform, last, length, l: length / last};
}

/** Field between the faces at each station by the plates law, V/m: in the liquid, beyond a bead in air; none beyond the
 * electrodes. */
function fieldOf(frame, member, half) {
  const side = member.along ? 0.5 : 1; // films that mirror each other: gap, offset and voltage are those to the middle plane
  const voltage = side * frame.get('electro.voltage_share') * member.voltage, {offset} = member;
  const cap = (name) => (frame.get('electro.breakdown_cap') ? frame.get(name) : Infinity);
  const liquid = {offset, most: cap('medium.breakdown_field')};
  const air = {offset: offset / frame.get('medium.permittivity'), most: cap('air.breakdown_field')};
  return Float64Array.from(half.gap, (g, i) => {
    if (i > member.covered * (half.gap.length - 1)) return 0;
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
  const out = {x: outward * clip * Math.cos(member.angle), y: outward * clip * Math.sin(member.angle)};
  const x = [], y = [];
  for (const r of [0, 1]) {
    x[r] = at.map((i) => member.middle + mirror * (member.x[2 * i + r] - member.own));
    y[r] = at.map((i) => member.y[2 * i + r]);
    if (hinge) continue;
    const [a, b] = member.platforms[r];
    x[r] = [x[r][0] + out.x, ...x[r], (a.x + b.x) / 2];
    y[r] = [y[r][0] + out.y, ...y[r], (a.y + b.y) / 2];
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
  const point = (r, i) => ({x: member.middle + member.x[2 * i + r] - member.own, y: member.y[2 * i + r]});
  return [0, 1].map((r) => {
    const left = point(r, last);
    return [left, whole ? point(r, last + 1) : {x: left.x + platform, y: left.y}];
  });
}

/** Member k. `own`: x of its middle in its own frame, `middle`: in the picture; `angle`: of its upper platform, rad. */
function memberOf(frame, k, bead) {
  const {upperInsulator, lowerInsulator, upperMetal, lowerMetal, wetLength, ...member} = frame.member(k);
  const layout = layoutOf(frame, member), {hinge, platform, last, length} = layout;
  member.own = member.along ? 0 : hinge ? length / 2 : member.x[2 * last] + platform / 2;
  const drawn = Number.isNaN(member.middle);
  if (drawn) member.middle = member.own;
  member.wet = bead ? wetLength : [Infinity, Infinity];
  member.platforms = platformsOf(layout, member);
  const [[left, right] = []] = member.platforms;
  member.angle = member.along ? -Math.PI / 2 : hinge ? 0 : Math.atan2(right.y - left.y, right.x - left.x);
  return {
    halves: (hinge ? [false] : [false, true]).map((right) => halfOf(frame, layout, member, right)),
    platforms: member.platforms,
    insulator: [upperInsulator, lowerInsulator],
    metal: [upperMetal, lowerMetal],
    electrode: hinge || member.electrode !== 0,
    along: member.along !== 0, // both films hang, and the load at their ends
    electrodes: member.covered * last, // a place along the ribbons
    angle: member.angle,
    turned: member.turned !== 0,
    drawn, // its shape is in the drawing as it is: it moves in the plane
    voltage: member.voltage,
    bodies: [member.upper, member.lower],
    reach: member.length / 2 + (hinge ? 0 : clip),
  };
}

const middleOf = ([a, b]) => ({x: (a.x + b.x) / 2, y: (a.y + b.y) / 2});

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

/** What encloses all ribbons: left, right, top, bottom. */
function boxOf(members, points = []) {
  const box = {left: Infinity, right: -Infinity, top: -Infinity, bottom: Infinity};
  const enclose = (x, y) => {
    box.left = Math.min(box.left, x);
    box.right = Math.max(box.right, x);
    box.top = Math.max(box.top, y);
    box.bottom = Math.min(box.bottom, y);
  };
  for (const {x, y} of members.flatMap(({halves}) => halves))
    for (const r of [0, 1]) x[r].forEach((at, i) => enclose(at, y[r][i]));
  for (const {x, y} of points) enclose(x, y);
  return box;
}

/** An actuator or a stack: the load is on the last member. */
function stackOf(frame, members) {
  const count = members.length, distance = frame.get('stack.distance'), opposed = distance > 0;
  const reach = members[0].reach, pitch = 2 * reach + between, places = placesOf(frame, count, pitch);
  members.forEach((member, k) => (member.places = places.of(k)));
  const loaded = members[opposed ? 0 : count - 1], [left, right] = loadedEnds(loaded), {top, bottom} = boxOf(members);
  const middle = middleOf([left, right]), tilt = Math.atan2(right.y - left.y, right.x - left.x), offset = frame.get('load.offset');
  const wide = reach + ((places.columns - 1) / 2) * pitch, hinge = members[0].platforms.length === 0;
  const columns = [...new Set(members.flatMap((member) => member.places))];
  return {
    opposed,
    columns: places.columns,
    joined: places.columns > 1 ? {from: places.of(0)[0], to: places.of(count - 1).at(-1)} : null, // rigid links of columns
    box: {left: -wide, right: wide, top: hinge ? Math.max(top, 0) : 0, bottom: Math.min(bottom, opposed ? -distance : 0)},
    supports: hinge
      ? [{x: members[0].halves[0].x[0][0], y: 0, angle: members[0].along ? 0 : Math.PI / 2, half: 4.5e-3}]
      : columns.flatMap((x) => [{x, y: 0, angle: 0, half: 9e-3}, ...(opposed ? [{x, y: -distance, angle: Math.PI, half: 9e-3}] : [])]),
    loads: [{body: 0, mass: frame.get('load.mass'), hangs: !opposed, aside: false,
             x: middle.x + offset * Math.cos(tilt), y: middle.y + offset * Math.sin(tilt)}],
    bodies: [], springs: [], joints: [],
    openingAt: right.x + 3e-3,
    focus: places.abreast ? members[0] : loaded, // the member that lens and profiles show, in its left half
  };
}

/** A network: members and joints where their bodies are; each body as the lines from its place to all that is fixed to it. */
function networkOf(frame, members) {
  const {inPlane} = frame, bodies = frame.parts('body'), springs = frame.parts('spring'), joints = frame.parts('joint');
  const fixed = bodies.map(({x, y}) => [{x, y}]), supports = [], carries = bodies.map(() => false);
  for (const member of members) {
    member.places = [0];
    member.platforms.forEach((ends, r) => {
      const body = member.bodies[r], at = middleOf(ends), up = (r === 0) !== member.turned;
      fixed[body].push(at);
      if (bodies[body].held) supports.push({...at, angle: member.angle + (up ? 0 : Math.PI), half: 9e-3});
    });
    carries[member.bodies[0]] = true;
  }
  for (const {x, y, from, to} of joints) {
    fixed[from].push({x, y});
    fixed[to].push({x, y});
    if (bodies[from].held || bodies[to].held) supports.push({x, y, angle: 0, half: 3e-3});
  }
  for (const {fromX, fromY, toX, toY, from, to} of springs) {
    fixed[from].push({x: fromX, y: fromY});
    fixed[to].push({x: toX, y: toY});
    if (inPlane && bodies[from].held) supports.push({x: fromX, y: fromY, angle: 0, half: 3e-3});
    if (inPlane && bodies[to].held) supports.push({x: toX, y: toY, angle: 0, half: 3e-3});
  }
  const moving = bodies.map((body, k) => ({...body, body: k, fixed: fixed[k]})).filter(({held}) => !held);
  return {
    opposed: false,
    columns: 1,
    joined: null,
    box: boxOf(members, [...moving.flatMap((body) => body.fixed), ...supports.flatMap(({x, y, half}) => [{x: x - half, y}, {x: x + half, y}])]),
    supports,
    loads: moving.filter(({mass}) => mass > 0).map(({body, mass, x, y}) => ({body, mass, x, y, hangs: !inPlane && !carries[body], aside: inPlane})),
    bodies: moving,
    springs: springs.map(({fromX, fromY, toX, toY}) => [{x: fromX, y: fromY}, {x: toX, y: toY}]),
    joints,
    openingAt: NaN, // no single one
    focus: members[0],
  };
}

/** (frame, is there a bead?) => all that is drawn of it. */
export function geometryOf(frame, bead) {
  const members = Array.from({length: frame.get('members')}, (_, k) => memberOf(frame, k, bead));
  const network = frame.get('bodies') > 0;
  return {members, network, gravity: frame.get('mount.tilt'), ...(network ? networkOf : stackOf)(frame, members)};
}
