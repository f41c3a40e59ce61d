// Names in drawings, placed so that they do not lie on one another.

export type Flat = [number, number];
/** To the right and downwards. */
export interface Box { left: number; right: number; top: number; bottom: number }
export interface Label { text: string; box: Box }

const shared = (a: Box, b: Box): number => Math.max(0, Math.min(a.right, b.right) - Math.max(a.left, b.left))
  * Math.max(0, Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top));
const area = (box: Box): number => (box.right - box.left) * (box.bottom - box.top);

/** Length of a line from a to b within a box: where it enters and leaves, as shares of it (Liang and Barsky 1984). */
function lengthWithin([ax, ay]: Flat, [bx, by]: Flat, box: Box): number {
  let [enters, leaves] = [0, 1];
  for (const [from, along, low, high] of [[ax, bx - ax, box.left, box.right], [ay, by - ay, box.top, box.bottom]]) {
    if (along === 0 && (from < low || from > high)) return 0;
    if (along === 0) continue;
    const ends = [(low - from) / along, (high - from) / along];
    enters = Math.max(enters, Math.min(...ends));
    leaves = Math.min(leaves, Math.max(...ends));
  }
  return Math.max(0, leaves - enters) * Math.hypot(bx - ax, by - ay);
}

/**
 * Which of its candidates each label takes, one label after another: the first that is within the drawing, on none taken
 * before and on no line, or else the one of which least is. A line counts as a strip of a fourth of the label's height.
 */
export function placeLabels(candidates: Box[][], within: Box, lines: Flat[][] = []): number[] {
  const taken: Box[] = [];
  const onLines = (box: Box): number => lines.reduce((sum, line) => sum + line.slice(1).reduce((length, point, i) =>
    length + lengthWithin(line[i], point, box), 0), 0) * (box.bottom - box.top) / 4;
  return candidates.map((boxes) => {
    const costs = boxes.map((box) => taken.reduce((sum, other) => sum + shared(box, other), area(box) - shared(box, within) + onLines(box)));
    const best = costs.findIndex((cost) => cost <= 1e-9 * area(boxes[0]));
    const chosen = best >= 0 ? best : costs.indexOf(Math.min(...costs));
    taken.push(boxes[chosen]);
    return chosen;
  });
}

/** A point of a path at a share of its length. */
function along(path: Flat[], share: number): Flat {
  const lengths = path.slice(1).map((point, i) => Math.hypot(point[0] - path[i][0], point[1] - path[i][1]));
  let left = share * lengths.reduce((sum, length) => sum + length, 0);
  for (let i = 0; i < lengths.length; ++i) {
    if (left <= lengths[i] && lengths[i] > 0)
      return [0, 1].map((k) => path[i][k] + left / lengths[i] * (path[i + 1][k] - path[i][k])) as Flat;
    left -= lengths[i];
  }
  return path[path.length - 1];
}

/** Names beside the middle of their ropes, or further up or down these, on no rope where there is room; ropes that fall onto each other share one. */
export function ropeLabels(ropes: { name: string; path: Flat[] }[], size: number, within: Box): Label[] {
  const near = (a: Flat, b: Flat): boolean => Math.hypot(a[0] - b[0], a[1] - b[1]) < size / 2;
  const groups: { names: string[]; path: Flat[] }[] = [];
  for (const { name, path } of ropes) {
    const ends = [path[0], path[path.length - 1]];
    const same = groups.find((group) => [ends, [...ends].reverse()].some(([first, last]) =>
      near(first, group.path[0]) && near(last, group.path[group.path.length - 1])));
    if (same) same.names.push(name);
    else groups.push({ names: [name], path });
  }
  const letter = 0.6 * size;  // its width, of those of most fonts the larger ones
  const candidates = groups.map(({ names, path }) => {
    const width = letter * names.join(", ").length;
    return [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8, 0.1, 0.9].flatMap((share) => {
      const [x, y] = along(path, share);
      return [x + 0.4 * size, x - 0.4 * size - width].map((left): Box =>
        ({ left, right: left + width, top: y - 0.8 * size, bottom: y + 0.25 * size }));
    });
  });
  return placeLabels(candidates, within, groups.map(({ path }) => path)).map((chosen, i) => ({ text: groups[i].names.join(", "), box: candidates[i][chosen] }));
}
