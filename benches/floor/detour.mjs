// Recast and Detour (WebAssembly) on a floor that `cargo bench --bench floor -- --write NAME FILE` wrote.
//
//   node benches/floor/detour.mjs FOLDER FILE      FOLDER: where `npm install recast-navigation` was run
//
// Prints lines of numbers as the bench's own programs do: times of building in ms, MB held, ways with their µs and cm.

import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

const [folder, file] = process.argv.slice(2);
const find = createRequire(resolve(folder, 'package.json'));
const load = (name) => import(pathToFileURL(find.resolve(name)));
const { init, NavMeshQuery } = await load('@recast-navigation/core');
const { generateSoloNavMesh, generateTiledNavMesh } = await load('@recast-navigation/generators');
await init();

const bytes = readFileSync(file);
let at = 0;
const take = (points) => {
  const count = bytes.readUInt32LE(at);
  const numbers = new Float32Array(bytes.buffer.slice(bytes.byteOffset + at + 4, bytes.byteOffset + at + 4 + count * points * 12));
  at += 4 + count * points * 12;
  return numbers;
};
const corners = take(3);
const ways = take(2);
const indices = Uint32Array.from({ length: corners.length / 3 }, (_, i) => i);

const CELL = 0.05;
const RADIUS = Math.ceil(0.2 / CELL);
// The settings of Recast's demonstration, as in peers.rs; beyond 2 600 cells a floor is built in tiles.
const settings = {
  cs: CELL, ch: CELL, walkableSlopeAngle: 45, walkableHeight: 24, walkableClimb: 0, walkableRadius: RADIUS,
  maxEdgeLen: RADIUS * 8, maxSimplificationError: 1.3, minRegionArea: 8, mergeRegionArea: 20, maxVertsPerPoly: 6,
  detailSampleDist: 6, detailSampleMaxError: 1,
};
const extent = (axis) => {
  let [low, high] = [Infinity, -Infinity];
  for (let i = axis; i < corners.length; i += 3) [low, high] = [Math.min(low, corners[i]), Math.max(high, corners[i])];
  return high - low;
};
const isLarge = Math.max(extent(0), extent(2)) / CELL > 2600;
const build = () => {
  const made = isLarge
    ? generateTiledNavMesh(corners, indices, { ...settings, tileSize: 512, borderSize: RADIUS + 3 })
    : generateSoloNavMesh(corners, indices, settings);
  if (!made.success) throw new Error(made.error);
  return made.navMesh;
};
const held = () => process.memoryUsage().rss / 1048576;
const median = (list) => list.sort((a, b) => a - b)[list.length >> 1];

console.log(`before\t${held()}`);
let mesh = build();
console.log(`after\t${held()}`);
const spent = Array.from({ length: isLarge ? 3 : 15 }, () => {
  mesh.destroy();
  const [start, began] = [process.cpuUsage(), performance.now()];
  mesh = build();
  const used = process.cpuUsage(start);
  return [(used.user + used.system) / 1e3, performance.now() - began];
});
console.log(`build\t${median(spent.map((s) => s[0]))}\nclock\t${median(spent.map((s) => s[1]))}`);

const query = new NavMeshQuery(mesh, { maxNodes: 65535 });
// Nearest polygons, corridor, taut way: what it takes to be told a way.
const ask = (from, to) => {
  const [start, goal] = [query.findNearestPoly(from), query.findNearestPoly(to)];
  if (!start.nearestRef || !goal.nearestRef) return undefined;
  const path = query.findPath(start.nearestRef, goal.nearestRef, start.nearestPoint, goal.nearestPoint, { maxPathPolys: 4096 });
  const count = path.polys.size;
  let length;
  if (path.success && count > 0 && path.polys.get(count - 1) === goal.nearestRef) {
    const way = query.findStraightPath(start.nearestPoint, goal.nearestPoint, path.polys, { maxStraightPathPoints: 1024 });
    length = 0;
    for (let i = 1; i < way.straightPathCount; i++) {
      const step = (axis) => way.straightPath.get(3 * i + axis) - way.straightPath.get(3 * i - 3 + axis);
      length += Math.hypot(step(0), step(2)) * 100;
    }
    way.straightPath.destroy();
    way.straightPathFlags.destroy();
    way.straightPathRefs.destroy();
  }
  path.polys.destroy();
  return length;
};
const point = (i) => ({ x: ways[i], y: ways[i + 1], z: ways[i + 2] });
const all = Array.from({ length: ways.length / 6 }, (_, i) => [point(6 * i), point(6 * i + 3)]);
// Just-in-time compilers are given time to warm up.
for (let round = 0; round < 20; round++) all.slice(0, 50).forEach(([from, to]) => ask(from, to));
all.forEach(([from, to], i) => {
  let [best, length] = [Infinity, undefined];
  for (let k = 0; k < 5; k++) {
    const start = performance.now();
    length = ask(from, to);
    best = Math.min(best, performance.now() - start);
  }
  if (length !== undefined) console.log(`way\t${i}\t${best * 1e3}\t${length}`);
});
