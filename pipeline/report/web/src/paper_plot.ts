// Plots for paper and for files: drawings of lines that scale as a whole, whatever the window was.
import { Stage } from "./data";
import { svg } from "./dom";
import { niceTicks, tickTexts } from "./ticks";

export interface PaperCurve {
  name: string; colour: string; width: number; time: ArrayLike<number>; values: ArrayLike<number>; dots?: boolean; dash?: number[];
}
export interface PaperMark { time: number; value: number; colour: string; text?: string; below?: boolean }
export interface PaperPlot {
  label: string; unit: string; start: number; end: number; range?: [number, number];
  stages: Stage[]; curves: PaperCurve[]; marks?: PaperMark[]; size: "large" | "middle" | "small";
}

const sizes = { large: [720, 250, 9.5], middle: [350, 165, 8.5], small: [232, 104, 7.5] } as const;
const ink = "#3c4854";

/** A path through the lowest and highest value of each column, so that no peak is lost. */
function pathText(curve: PaperCurve, x: (time: number) => number, y: (value: number) => number): string {
  const { time, values } = curve;
  let text = "";
  let i = 0;
  const add = (at: number): void => { text += `${text ? "L" : "M"}${x(time[at]).toFixed(1)} ${y(values[at]).toFixed(1)}`; };
  while (i < time.length) {
    const column = Math.floor(2 * x(time[i]));
    let [low, high, last] = [i, i, i];
    for (; last < time.length && Math.floor(2 * x(time[last])) === column; ++last) {
      if (values[last] < values[low]) low = last;
      if (values[last] > values[high]) high = last;
    }
    if (low === high) add(low);
    else { add(Math.min(low, high)); add(Math.max(low, high)); }
    i = last;
  }
  return text;
}

function extentOf(plot: PaperPlot): [number, number] {
  let [low, high] = [Infinity, -Infinity];
  for (const { values } of plot.curves) for (let i = 0; i < values.length; ++i) {
    low = Math.min(low, values[i]);
    high = Math.max(high, values[i]);
  }
  if (!(high >= low)) return [0, 1];
  const room = 0.1 * Math.max(high - low, 1e-9 + 1e-6 * Math.abs(high));
  return [low >= 0 ? Math.max(low - room, 0) : low - room, high + 1.4 * room];
}

export function paperPlot(plot: PaperPlot): SVGElement {
  const [width, height, font] = sizes[plot.size];
  const [left, right, top, bottom] = [font * 5, 6, font * 1.3, font * (plot.size === "large" ? 3.2 : 1.9)];
  const [low, high] = plot.range ?? extentOf(plot);
  const span = Math.max(plot.end - plot.start, 1e-9);
  const x = (time: number): number => left + (time - plot.start) / span * (width - left - right);
  const y = (value: number): number => height - bottom - (value - low) / Math.max(high - low, 1e-30) * (height - bottom - top);
  const parts: SVGElement[] = [];
  const write = (at: number, down: number, text: string, anchor: string, fill = ink, more: Record<string, string | number> = {}): void => {
    parts.push(svg("text", { x: at.toFixed(1), y: down.toFixed(1), "font-size": font, "text-anchor": anchor, fill, ...more }, text));
  };
  plot.stages.forEach((stage, i) => {
    const wide = x(stage.end) - x(stage.start);
    parts.push(svg("rect", { x: x(stage.start).toFixed(1), y: top, width: Math.max(wide, 0).toFixed(1), height: (height - bottom - top).toFixed(1),
      fill: i % 2 ? "#f3f6f8" : "#e9eef2" }));
    if (plot.size === "large" && stage.name.length * font * 0.5 < wide - 4)
      write(x(stage.start) + 3, height - bottom - 3, stage.name, "start", "#5a6875", { "font-size": font * 0.85 });
  });
  const across = niceTicks(plot.start, plot.end, plot.size === "large" ? 10 : plot.size === "middle" ? 5 : 4);
  const acrossTexts = tickTexts(across);
  across.forEach((tick, i) => {
    parts.push(svg("line", { x1: x(tick).toFixed(1), x2: x(tick).toFixed(1), y1: top, y2: (height - bottom).toFixed(1), stroke: "#d5dce2", "stroke-width": 0.5 }));
    write(x(tick), height - bottom + font * 1.2, acrossTexts[i], "middle");
  });
  const up = niceTicks(low, high, plot.size === "large" ? 6 : 4);
  const upTexts = tickTexts(up);
  up.forEach((tick, i) => {
    parts.push(svg("line", { x1: left, x2: width - right, y1: y(tick).toFixed(1), y2: y(tick).toFixed(1), stroke: "#d5dce2", "stroke-width": 0.5 }));
    write(left - 3, y(tick) + font * 0.35, upTexts[i], "end");
  });
  write(2, font * 0.95, plot.unit, "start");
  if (plot.size === "large") write((left + width - right) / 2, height - 3, "time, s", "middle");
  for (const curve of plot.curves) {
    if (!curve.dots) {
      parts.push(svg("path", { d: pathText(curve, x, y), fill: "none", stroke: curve.colour, "stroke-width": curve.width, "stroke-linejoin": "round",
        ...(curve.dash ? { "stroke-dasharray": curve.dash.join(" ") } : {}) }));
      continue;
    }
    for (let i = 0; i < curve.time.length; ++i)
      parts.push(svg("circle", { cx: x(curve.time[i]).toFixed(1), cy: y(curve.values[i]).toFixed(1), r: 2, fill: curve.colour }));
  }
  for (const mark of plot.marks ?? []) {
    const [at, down] = [x(mark.time), y(mark.value)];
    parts.push(svg("circle", { cx: at.toFixed(1), cy: down.toFixed(1), r: plot.size === "large" ? 3 : 2, fill: "#ffffff", stroke: mark.colour, "stroke-width": 1.2 }));
    if (!mark.text) continue;
    const before = at > (left + width) / 2;
    write(at + (before ? -6 : 6), down + (mark.below ? font * 1.2 : -2), mark.text, before ? "end" : "start", mark.colour,
      { "font-weight": 600, stroke: "#ffffff", "stroke-width": 2.5, "paint-order": "stroke" });
  }
  return svg("svg", { viewBox: `0 0 ${width} ${height}`, class: `paper plot-${plot.size}`, role: "img", "aria-label": plot.label,
    "font-family": "system-ui, Helvetica, Arial, sans-serif" }, parts);
}
