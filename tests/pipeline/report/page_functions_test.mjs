// Functions of the report's page that need no browser: what stands beside a plot's lines, in which stage an instant is.
//   node page_functions_test.mjs FOLDER_OF_SOURCES FOLDER_OF_NODE_MODULES
import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const [sources, modules] = process.argv.slice(2);
const { build } = await import(pathToFileURL(join(modules, "esbuild", "lib", "main.js")).href);
const folder = mkdtempSync(join(tmpdir(), "page-functions-"));
const load = async (name) => {
  const bundled = (await build({ entryPoints: [join(sources, `${name}.ts`)], bundle: true, write: false, format: "esm" })).outputFiles[0].text;
  const file = join(folder, `${name}.mjs`);
  writeFileSync(file, bundled);
  return import(pathToFileURL(file).href);
};

try {
  const { niceTicks, tickTexts } = await load("ticks");
  assert.deepEqual(tickTexts([175, 177.5, 180]), ["175.0", "177.5", "180.0"]);
  assert.deepEqual(tickTexts([0, 0.25, 0.5]), ["0.00", "0.25", "0.50"]);
  assert.deepEqual(tickTexts([-20, 0, 20]), ["\u221220", "0", "20"]);
  assert.deepEqual(tickTexts([5.8, 5.80001, 5.80002]), ["5.80000", "5.80001", "5.80002"]);
  assert.deepEqual(tickTexts([0, 1250000, 2500000]), ["0", "1.25e6", "2.50e6"]);
  assert.deepEqual(tickTexts([-2e-6, 0, 2e-6]), ["\u22122e\u22126", "0", "2e\u22126"]);
  assert.deepEqual(tickTexts([0]), ["0"]);
  assert.deepEqual(niceTicks(0, 10, 5), [0, 2, 4, 6, 8, 10]);
  for (const [low, high] of [[-0.49, 0.49], [0.1, 0.98], [12.01, 12.09], [-3e-7, 1e-7]])
    for (const count of [2, 3, 4, 5, 6, 10]) assert.ok(niceTicks(low, high, count).length >= 2, `${low} to ${high} by ${count}`);
  assert.ok(niceTicks(3, 3, 4).length <= 5);

  // A pause belongs to the stage that it stands before, what comes after the last stage to the last.
  const { stageAt } = await load("data");
  const stages = [{ name: "up", start: 15, end: 20 }, { name: "down", start: 30, end: 40 }];
  assert.deepEqual([0, 15, 20, 25, 35, 50].map((time) => stageAt(stages, time)), ["up", "up", "up", "down", "down", "down"]);
  assert.equal(stageAt([], 3), "");

  // A motion keeps its column when two hooks take turns in its name, and two of one name have a column each.
  const { followMotions } = await load("modes");
  const mode = (name, period_s) => ({ name, period_s, kind: "oscillating" });
  const followed = followMotions([
    [mode("load: yaw", 5), mode("load and C1.right: roll about x", 1.3), mode("load: bounce", 0.2)],
    [mode("load: yaw", 4.6), mode("load and C1.left: roll about x against C1.right", 1.2), mode("load: yaw", 0.9)],
    [mode("load: yaw", 0.8), mode("load: yaw", 4.4), mode("load and C1.right: roll about x", 1.25), mode("load: roll about x", 0.3)]]);
  assert.deepEqual(followed.map(({ name, modes }) => [name, ...[0, 1, 2].map((row) => modes[row]?.period_s ?? null)]), [
    ["load: yaw", 5, 4.6, 4.4], ["load: roll about x", 1.3, 1.2, 1.25], ["load: bounce", 0.2, null, null],
    ["load: yaw", null, 0.9, 0.8], ["load: roll about x", null, null, 0.3]]);
  assert.deepEqual(followed[1].names, ["load and C1.right: roll about x", "load and C1.left: roll about x against C1.right"]);
  // Turned by the wind at one instant, it goes on under its name.
  assert.equal(followMotions([[mode("load: yaw", 5)], [{ name: "load: yaw", kind: "unstable" }]]).length, 1);

  // A label gives way to those before it, and stays within the drawing.
  const { placeLabels, ropeLabels } = await load("labels");
  const box = (left, top) => ({ left, right: left + 4, top, bottom: top + 1 });
  const sheet = { left: 0, right: 10, top: 0, bottom: 10 };
  assert.deepEqual(placeLabels([[box(1, 1), box(1, 3)], [box(2, 1.5), box(2, 3)], [box(8, 1), box(5.5, 1)]], sheet), [0, 1, 1]);
  assert.deepEqual(placeLabels([[box(1, 1)], [box(1, 1.1), box(1, 1.5)]], sheet), [0, 1]);
  // It keeps off lines where it can.
  assert.deepEqual(placeLabels([[box(1, 1), box(1, 3)]], sheet, [[[0, 0], [3, 1.5], [3, 1.8]]]), [1]);
  assert.deepEqual(placeLabels([[box(1, 1)]], sheet, [[[3, 0], [3, 9]]]), [0]);
  // The two legs of a sling, seen from the side, have their names outside.
  const legs = ropeLabels([{ name: "A", path: [[10, 2], [9, 6]] }, { name: "B", path: [[10, 2], [11, 6]] }], 1, { left: 0, right: 20, top: 0, bottom: 9 });
  assert.ok(legs[0].box.right < 9.5 && legs[1].box.left > 10.5);
  // Slings that fan out from a hook, seen from the side: two fall onto each other, the others are near. At their middles the
  // names would lie on one another.
  const fan = [0, 0, 1, 2, 3, 4].map((x, i) => ({ name: `sling ${i + 1}`, path: [[10, 2], [8 + x, 12]] }));
  const names = ropeLabels(fan, 0.6, { left: 0, right: 20, top: 0, bottom: 14 });
  assert.deepEqual(names.map(({ text }) => text), ["sling 1, sling 2", "sling 3", "sling 4", "sling 5", "sling 6"]);
  const apart = (a, b) => a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top;
  names.forEach((a, i) => names.slice(i + 1).forEach((b) => assert.ok(apart(a.box, b.box), `${a.text} lies on ${b.text}`)));

  // A plate of 2 x 1 m, one quadrangle beside four of half the size: the line between them is no outline, though no two
  // quadrangles share an edge there. Where the small ones are bent up, or of another plate, it is.
  const { BlockSurface } = await load("surface");
  const packed = (array) => ({ type: array instanceof Float32Array ? "f32" : "u32", data: Buffer.from(array.buffer).toString("base64") });
  const outlines = (lift, groups) => {
    const points = [[0, 0], [1, 0], [1, 1], [0, 1], [1, 0.5], [1.5, 0], [1.5, 0.5], [1.5, 1], [2, 0], [2, 0.5], [2, 1]]
      .flatMap(([x, y]) => [x, y, lift * Math.max(0, x - 1)]);
    const quads = [[0, 1, 2, 3], [1, 5, 6, 4], [4, 6, 7, 2], [5, 8, 9, 6], [6, 9, 10, 7]].flat();
    const surface = new BlockSurface({ points: packed(Float32Array.from(points)), quads: packed(Uint32Array.from(quads)),
      groups: ["a", "b"], quad_group: packed(Uint32Array.from(groups)) });
    const lines = surface.outlines();
    const found = [];
    for (let i = 0; i < lines.length; i += 2) found.push([lines[i], lines[i + 1]].sort((a, b) => a - b).join("-"));
    return found.sort();
  };
  const rim = ["0-1", "0-3", "1-5", "10-7", "2-3", "2-7", "5-8", "8-9", "9-10"].map((edge) => edge.split("-").sort((a, b) => a - b).join("-")).sort();
  assert.deepEqual(outlines(0, [0, 0, 0, 0, 0]), rim);
  assert.deepEqual(outlines(1, [0, 0, 0, 0, 0]), [...rim, "1-4", "2-4"].sort());
  assert.deepEqual(outlines(0, [0, 1, 1, 1, 1]), [...rim, "1-4", "2-4"].sort());

  const { kilonewtons, significant } = await load("numbers");
  assert.deepEqual([99964, 99940, 103000].map(kilonewtons), ["100", "99.9", "103"]);
  assert.equal(significant(0.09996, 3), "0.100");
} finally {
  rmSync(folder, { recursive: true, force: true });
}
