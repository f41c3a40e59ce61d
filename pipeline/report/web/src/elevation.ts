// Elevations of the lift as line drawings: for print, for browsers without WebGL, and as buttons for the stages.
import { Scene } from "./data";
import { svg } from "./dom";
import { Flat, ropeLabels } from "./labels";
import { Bodies, boxCorners, inWorld, ropePath, Vector } from "./motion";

export type Side = "side" | "front";  // side: along x, y to the right; front: along y, x to the right

export interface Frame { left: number; right: number; bottom: number; top: number }

const flatten = (side: Side) => ([x, y, z]: Vector): Flat => [side === "side" ? y : x, z];

/** Corners of the smallest convex outline (monotone chain). */
function outline(points: Flat[]): Flat[] {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const turn = (o: Flat, a: Flat, b: Flat): number => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
  const chain = (ordered: Flat[]): Flat[] => {
    const kept: Flat[] = [];
    for (const point of ordered) {
      while (kept.length >= 2 && turn(kept[kept.length - 2], kept[kept.length - 1], point) <= 0) kept.pop();
      kept.push(point);
    }
    kept.pop();
    return kept;
  };
  return [...chain(sorted), ...chain(sorted.reverse())];
}

/** What the drawing must hold at the given instants. */
export function frameOf(scene: Scene, bodies: Bodies, times: number[], side: Side): Frame {
  const flat = flatten(side);
  const frame: Frame = { left: Infinity, right: -Infinity, bottom: 0, top: -Infinity };
  for (const time of times) for (const body of scene.bodies) {
    const pose = bodies.pose(body.name, time);
    for (const box of body.boxes) for (const corner of boxCorners(box)) {
      const [across, up] = flat(inWorld(pose, corner));
      frame.left = Math.min(frame.left, across);
      frame.right = Math.max(frame.right, across);
      frame.bottom = Math.min(frame.bottom, up);
      frame.top = Math.max(frame.top, up);
    }
  }
  return frame;
}

/** The side from which the load is seen to move and turn more between the instants; "side" if that is no matter. */
export function tellingSide(scene: Scene, bodies: Bodies, times: number[]): Side {
  const corners = (scene.bodies.find(({ name }) => name === scene.load)?.boxes ?? []).flatMap(boxCorners);
  const movement = (side: Side): number => {
    const flat = flatten(side);
    const across = times.map((time) => corners.map((corner) => flat(inWorld(bodies.pose(scene.load, time), corner))[0]));
    return across.slice(1).reduce((sum, now, i) => sum + now.reduce((part, place, k) => part + Math.abs(place - across[i][k]), 0), 0);
  };
  return movement("front") > 1.5 * movement("side") ? "front" : "side";
}

export function elevation(
  scene: Scene, bodies: Bodies, time: number, side: Side, frame: Frame, labelled: boolean): SVGElement {
  const flat = flatten(side);
  const margin = 0.04 * Math.max(frame.right - frame.left, frame.top - frame.bottom);
  const [width, height] = [frame.right - frame.left + 2 * margin, frame.top - frame.bottom + 2 * margin];
  const x = (point: Flat): number => point[0] - frame.left + margin;
  const y = (point: Flat): number => frame.top + margin - point[1];
  const text = (points: Flat[]): string => points.map((point) => `${x(point).toFixed(2)},${y(point).toFixed(2)}`).join(" ");
  const shapes: SVGElement[] = [];
  const order = (kind: string): number => (kind === "load" ? 1 : 0);
  for (const body of [...scene.bodies].sort((a, b) => order(a.kind) - order(b.kind))) {
    const pose = bodies.pose(body.name, time);
    const isLoad = body.name === scene.load;
    for (const box of body.boxes)
      shapes.push(svg("polygon", {
        points: text(outline(boxCorners(box).map((corner) => flat(inWorld(pose, corner))))),
        fill: isLoad ? "#c3ced8" : "#f2f4f6", stroke: isLoad ? "#34495c" : "#93a0ac", "vector-effect": "non-scaling-stroke",
        "stroke-width": isLoad ? 1.3 : 0.8,
      }));
  }
  for (const rope of scene.ropes) {
    const path = ropePath(rope, bodies, time).map(flat);
    shapes.push(svg("polyline", {
      points: text(path), fill: "none", stroke: rope.kind === "sling" ? "#a8450f" : "#4b5864", "vector-effect": "non-scaling-stroke",
      "stroke-width": rope.kind === "sling" ? 1.4 : 0.9,
    }));
  }
  if (labelled) {
    const size = height / 42;
    const ropes = scene.ropes.filter((one) => one.kind === "sling").map((one) => ({ name: one.name,
      path: ropePath(one, bodies, time).map(flat).map((point): Flat => [x(point), y(point)]) }));
    for (const { text: names, box } of ropeLabels(ropes, size, { left: 0, right: width, top: 0, bottom: height }))
      shapes.push(svg("text", { x: box.left, y: box.bottom - 0.25 * size, "font-size": size, fill: "#1d2730", stroke: "#fff",
        "stroke-width": size / 5, "paint-order": "stroke" }, names));
  }
  return svg("svg", { viewBox: `0 0 ${width.toFixed(2)} ${height.toFixed(2)}`, role: "img", "aria-label": `${side} elevation`, class: "elevation" },
    svg("line", { x1: 0, x2: width, y1: y([0, 0]), y2: y([0, 0]), stroke: "#93a0ac", "vector-effect": "non-scaling-stroke" }), shapes);
}
