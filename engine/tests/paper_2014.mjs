/**
 * The method of Shangguan and Zeng (2014), written from its text alone, section 3.1, in double
 * precision: no code in common with the engine. Prints the 36 masses of one turn once a second, as
 * JSON: a list of moments, each a list of [x, y, z], row by row from the foot, from the spine outward.
 *
 * What the text leaves open is as docs/methods.md says: mass 1, a step of 1/60 s, a table under the
 * leaf, the control points on a half circle, their angle a smoothstep of time.
 */

const count = 6;
const apart = 5;
const gravity = 0.00981;
const stiffness = 1;
const damping = -0.7125;
const step = 1 / 60;
const seconds = 11.4;
const width = apart * (count - 1);

const name = (column, row) => row * count + column;
const all = Array.from({ length: count * count }, (_, k) => [k % count, Math.floor(k / count)]);
const rest = all.map(([column, row]) => [-apart * column, apart * row, 0]);
const isFixed = ([column]) => column === 0;
const isControl = ([column]) => column === count - 1;
const isFree = (node) => !isFixed(node) && !isControl(node);

/** Stretch springs, shear springs and bend springs, each from one mass to another (figure 2). */
const springs = all.flatMap(([column, row]) =>
  [
    [1, 0],
    [0, 1],
    [1, 1],
    [-1, 1],
    [2, 0],
    [0, 2],
  ]
    .map(([across, up]) => [column + across, row + up])
    .filter(([c, r]) => c >= 0 && c < count && r < count)
    .map(([c, r]) => {
      const [from, to] = [name(column, row), name(c, r)];
      return { from, to, length: Math.hypot(...rest[to].map((x, axis) => x - rest[from][axis])) };
    }),
);

const place = rest.map((at) => [...at]);
const velocity = rest.map(() => [0, 0, 0]);

function turnBy(time) {
  // 2) Move the control points.
  const part = Math.min(time / seconds, 1);
  const angle = Math.PI * part * part * (3 - 2 * part);
  all.forEach((node, k) => {
    if (isControl(node)) {
      place[k] = [-width * Math.cos(angle), rest[k][1], width * Math.sin(angle)];
    }
  });
  // 3) The force on each mass: its springs by Hooke's law, gravity and damping.
  const force = velocity.map((v) => [damping * v[0], damping * v[1], damping * v[2] - gravity]);
  for (const { from, to, length } of springs) {
    const between = place[to].map((x, axis) => x - place[from][axis]);
    const now = Math.hypot(...between);
    for (let axis = 0; axis < 3; axis++) {
      const pull = (stiffness * (now - length) * between[axis]) / now;
      force[from][axis] += pull;
      force[to][axis] -= pull;
    }
  }
  // 4) Velocities by semi-implicit Euler, and 5) new positions.
  all.forEach((node, k) => {
    if (!isFree(node)) return;
    for (let axis = 0; axis < 3; axis++) {
      velocity[k][axis] += step * force[k][axis];
      place[k][axis] += step * velocity[k][axis];
    }
    // The table.
    if (place[k][2] < 0) {
      place[k][2] = 0;
      velocity[k][2] = Math.max(velocity[k][2], 0);
    }
  });
  // 6) Synchronise: masses at one distance from the dog-ear line, which is parallel to the spine
  // where the whole edge is turned, move by their mean way from where they lay.
  for (let column = 1; column < count - 1; column++) {
    const group = all.map((node, k) => [node, k]).filter(([[c]]) => c === column);
    for (let axis = 0; axis < 3; axis++) {
      const ways = group.map(([, k]) => place[k][axis] - rest[k][axis]);
      const mean = ways.reduce((sum, way) => sum + way, 0) / ways.length;
      for (const [, k] of group) place[k][axis] = rest[k][axis] + mean;
    }
  }
}

const moments = [];
for (let n = 1; n <= Math.round((seconds + 1) / step); n++) {
  turnBy(n * step);
  if (n % 60 === 0) moments.push(place.map((at) => [...at]));
}
console.log(JSON.stringify(moments));
