// Histories of tension, static over dynamic: one large plot, a small one for each rope, zoomed together.
import uPlot from "uplot";

import { Clock } from "./clock";
import { measuredColour, stateColour } from "./colours";
import { svgButton } from "./download";
import { onNewColours, paint } from "./paint";
import { PaperMark, paperPlot } from "./paper_plot";
import { tickTexts } from "./ticks";
import { History, known, PackedSeries, PageData, Series, Stage, stageAt, State, states } from "./data";
import { h } from "./dom";
import type { Section } from "./section";
import { change, fixed, kilonewtons, seconds, tonnesForce } from "./numbers";

interface Peak { time: number; value: number }
/** Measured values: they stand for their own instants alone. */
class Points extends Series {
  override at(time: number): number {
    const index = this.time.indexOf(time);
    return index < 0 ? NaN : this.values[index];
  }
}
/** One curve pair: what is plotted as static and as dynamic, the largest of each, and what was measured. */
interface Curve {
  name: string; kind: string; series: Partial<Record<State, Series>>; peaks: Partial<Record<State, Peak>>; measured?: Points;
}

function curvesOf(data: PageData): Curve[] {
  const curves: Curve[] = [];
  for (const [kind, label] of [["ropes", "rope"], ["hoists", "hoist"]] as const)
    for (const state of states)
      for (const packed of data.histories[state]?.[kind] ?? []) {
        if (packed.quantity !== "tension") continue;
        let curve = curves.find((one) => one.name === packed.name && one.kind === label);
        if (!curve) curves.push((curve = { name: packed.name, kind: label, series: {}, peaks: {} }));
        curve.series[state] = new Series(packed);
        const summary = (data.summary[kind] ?? []).find((one) => one.name === packed.name);
        const [time, value] = state === "static" ? [summary?.time_of_max_static_s, summary?.max_static_tension_N]
          : [summary?.time_of_max_dynamic_s, summary?.max_dynamic_tension_N];
        curve.peaks[state] = known(time) && known(value) ? { time, value } : largestOf(curve.series[state]);
      }
  for (const packed of data.measured ?? []) {
    const curve = curves.find((one) => one.kind === "rope" && one.name === packed.name);
    if (curve) curve.measured = new Points(packed);
  }
  return curves;
}

/** How far the computed tensions are from the measured ones, a sentence a rope. */
function measuredText(data: PageData): string {
  const rows = data.summary.comparison?.series ?? [];
  if (rows.length === 0) return "";
  const one = rows.map((row) => `${row.name}: ${fixed(row.mean_difference_percent, 1)} % in the mean, at most ${change(row.largest_difference_percent)} at `
    + `${seconds(row.time_of_largest_s)} s, at ${row.points ?? 0} points`);
  return `Measured tensions (${data.summary.comparison?.source ?? "source not given"}) are drawn as dots. In motion less measured, of the largest measured: ${one.join("; ")}.`;
}

/** Both series on the union of their instants, in the given unit. */
function aligned(series: (Series | undefined)[], factor: number): uPlot.AlignedData {
  const present = series.filter((one): one is Series => one !== undefined);
  const all = new Set<number>();
  for (const one of present) for (const time of one.time) all.add(time);
  const time = Float64Array.from(all).sort();
  return [time, ...series.map((one) => {
    const values = new Array<number | null>(time.length).fill(null);
    if (one) for (let i = 0; i < time.length; ++i) {
      const value = one.at(time[i]);
      values[i] = Number.isFinite(value) ? value * factor : null;
    }
    return values;
  })] as unknown as uPlot.AlignedData;
}

function largestOf(series: Series | undefined): Peak | undefined {
  if (!series || series.values.length === 0) return undefined;
  let best = 0;
  series.values.forEach((value, i) => { if (value > series.values[best]) best = i; });
  return { time: series.time[best], value: series.values[best] };
}

/** Smallest and largest value of a curve pair. */
function extent(curve: Curve): { low: number; high: number } {
  let [low, high] = [Infinity, -Infinity];
  for (const series of [...states.map((state) => curve.series[state]), curve.measured]) for (const value of series?.values ?? []) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  return { low, high };
}

const font = (size: number): string => `${size}px system-ui, "Segoe UI", Helvetica, Arial, sans-serif`;

/** Bands behind the curves, one a stage, with their names if there is room. */
function stageBands(stages: Stage[], named: boolean): uPlot.Plugin {
  return {
    hooks: {
      drawClear: (u) => {
        const { ctx } = u;
        ctx.save();
        ctx.beginPath();
        ctx.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
        ctx.clip();
        stages.forEach((stage, i) => {
          const left = u.valToPos(stage.start, "x", true);
          const right = u.valToPos(stage.end, "x", true);
          ctx.fillStyle = paint(i % 2 ? "band" : "other-band");
          ctx.fillRect(left, u.bbox.top, right - left, u.bbox.height);
          if (!named) return;
          const inside = Math.min(right, u.bbox.left + u.bbox.width) - Math.max(left, u.bbox.left);
          ctx.font = font(11 * devicePixelRatio);
          if (ctx.measureText(stage.name).width + 8 > inside) return;
          ctx.fillStyle = paint("soft");
          ctx.textAlign = "left";
          ctx.textBaseline = "bottom";
          ctx.fillText(stage.name, Math.max(left, u.bbox.left) + 5 * devicePixelRatio, u.bbox.top + u.bbox.height - 4 * devicePixelRatio);
        });
        ctx.restore();
      },
    },
  };
}

/** Rings at the largest values and a line at the instant of the drawing. */
function marks(curve: () => Curve, clock: Clock, factor: number, labelled: boolean): uPlot.Plugin {
  return {
    hooks: {
      draw: (u) => {
        const { ctx } = u;
        const right = u.bbox.left + u.bbox.width;
        ctx.save();
        ctx.beginPath();
        ctx.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
        ctx.clip();
        const now = u.valToPos(clock.time, "x", true);
        ctx.strokeStyle = paint("ink");
        ctx.lineWidth = devicePixelRatio;
        ctx.setLineDash([3 * devicePixelRatio, 3 * devicePixelRatio]);
        ctx.beginPath();
        ctx.moveTo(now, u.bbox.top);
        ctx.lineTo(now, u.bbox.top + u.bbox.height);
        ctx.stroke();
        ctx.setLineDash([]);
        for (const state of states) {
          const top = curve().peaks[state];
          if (!top) continue;
          const x = u.valToPos(top.time, "x", true);
          const y = u.valToPos(top.value * factor, "y", true);
          ctx.strokeStyle = paint(state);
          ctx.fillStyle = paint("paper");
          ctx.lineWidth = 2 * devicePixelRatio;
          ctx.beginPath();
          ctx.arc(x, y, (labelled ? 4.5 : 3) * devicePixelRatio, 0, 2 * Math.PI);
          ctx.fill();
          ctx.stroke();
          if (!labelled) continue;
          const text = `${kilonewtons(top.value)} kN at ${seconds(top.time)} s`;
          ctx.font = `600 ${font(12 * devicePixelRatio)}`;
          const wide = ctx.measureText(text).width;
          const rightwards = x + wide + 14 * devicePixelRatio < right;
          ctx.textAlign = rightwards ? "left" : "right";
          ctx.textBaseline = state === "static" ? "top" : "bottom";
          const shift = (rightwards ? 9 : -9) * devicePixelRatio;
          ctx.lineWidth = 4 * devicePixelRatio;
          ctx.strokeStyle = paint("paper");
          const lower = y + (state === "static" ? 6 : -2) * devicePixelRatio;
          ctx.strokeText(text, x + shift, lower);
          ctx.fillStyle = paint(state);
          ctx.fillText(text, x + shift, lower);
        }
        ctx.restore();
      },
    },
  };
}

/** Plots that zoom as one. */
class Group {
  private plots: uPlot[] = [];
  private busy = false;
  constructor(readonly start: number, readonly end: number) {}

  add(plot: uPlot): void { this.plots.push(plot); }

  zoom(from: number, to: number): void {
    if (this.busy) return;
    this.busy = true;
    for (const plot of this.plots) plot.setScale("x", { min: from, max: to });
    this.busy = false;
  }

  all(): void { this.zoom(this.start, this.end); }
  redraw(): void { for (const plot of this.plots) plot.redraw(false); }

  /** Moves by a share of the window, or makes it larger by a factor. */
  move(share: number, factor: number): void {
    const { min, max } = this.plots[0].scales.x;
    if (!known(min) || !known(max)) return;
    const middle = (min + max) / 2 + share * (max - min);
    const half = Math.min((max - min) / 2 * factor, (this.end - this.start) / 2);
    const from = Math.min(Math.max(middle - half, this.start), this.end - 2 * half);
    this.zoom(from, from + 2 * half);
  }
}

/** Curves that move by less than this part of their size are drawn as the level lines that they are. */
const smallestSwing = 1e-4;

function wholeRange(_: uPlot, min: number | null, max: number | null): uPlot.Range.MinMax {
  if (!known(min) || !known(max)) return [0, 1];
  const [low, high] = uPlot.rangeNum(min, max, 0.1, true);
  const [middle, half] = [(min + max) / 2, smallestSwing * Math.max(Math.abs(min), Math.abs(max))];
  return [Math.min(known(low) ? low : min, middle - half), Math.max(known(high) ? high : max, middle + half)];
}

interface PlotSettings {
  host: HTMLElement; height: number; group: Group; clock: Clock; plugins: uPlot.Plugin[]; series: uPlot.Series[];
  unit: string; small: boolean; range?: uPlot.Range.MinMax | uPlot.Range.Function; cursor?: (time: number | null) => void;
}

function makePlot(settings: PlotSettings, data: uPlot.AlignedData): uPlot {
  const { host, group, small } = settings;
  const axis: uPlot.Axis = {
    font: font(small ? 10 : 12), stroke: () => paint("soft"), grid: { stroke: () => paint("grid"), width: 1 },
    ticks: { stroke: () => paint("tick"), width: 1, size: 4 },
  };
  const plot = new uPlot({
    width: Math.max(host.clientWidth, 120), height: settings.height, legend: { show: false }, pxAlign: 0,
    cursor: { sync: { key: "tension" }, drag: { x: true, y: false, setScale: true }, points: { size: 6 } },
    scales: { x: { time: false, range: (_, min, max) => [min, max] }, y: { range: settings.range ?? wholeRange } },
    axes: [
      { ...axis, size: small ? 22 : 24, gap: 3, space: small ? 60 : 90, label: small ? undefined : "time, s", labelFont: font(12), labelSize: 20, labelGap: 0 },
      { ...axis, size: (_, values) => Math.max(small ? 42 : 46, 11 + (small ? 6 : 7) * Math.max(0, ...(values ?? []).map((one) => one.length))), gap: 3,
        // A window of four such spaces holds two ticks at least: steps are at most twice what was asked for.
        space: (_u, _axis, _min, _max, pixels) => Math.min(small ? 24 : 44, pixels / 4), label: small ? undefined : settings.unit, labelFont: font(12), labelSize: 18,
        values: (_, ticks) => tickTexts(ticks) },
    ],
    series: [{}, ...settings.series], plugins: settings.plugins,
    hooks: {
      setScale: [(u, key) => {
        const { min, max } = u.scales.x;
        if (key === "x" && known(min) && known(max)) group.zoom(min, max);
      }],
      setCursor: [(u) => settings.cursor?.(known(u.cursor.left) && u.cursor.left >= 0 ? u.posToVal(u.cursor.left, "x") : null)],
      ready: [(u) => {
        let pressed = 0;
        u.over.addEventListener("pointerdown", (event) => { pressed = event.clientX; });
        u.over.addEventListener("click", (event) => {
          if (Math.abs(event.clientX - pressed) < 3) settings.clock.set(u.posToVal(event.offsetX, "x"));
        });
      }],
    },
  }, data, host);
  new ResizeObserver(() => {
    if (host.clientWidth > 0 && host.clientWidth !== plot.width) plot.setSize({ width: host.clientWidth, height: settings.height });
  }).observe(host);
  onNewColours(() => plot.redraw(false));
  group.add(plot);
  return plot;
}

/** Static is drawn over dynamic, which would hide it. */
const drawingOrder: State[] = ["dynamic", "static"];
const drawn = (curve: Curve): (Series | undefined)[] => [...drawingOrder.map((state) => curve.series[state]), curve.measured];
const pairSeries = (small: boolean): uPlot.Series[] => [
  { label: "dynamic", stroke: () => paint("dynamic"), width: small ? 0.9 : 1.1, spanGaps: true, points: { show: false } },
  { label: "static", stroke: () => paint("static"), width: small ? 1.3 : 2, spanGaps: true, points: { show: false } },
  { label: "measured", stroke: () => paint("measured"), width: 0, paths: () => null, points: { show: true, size: small ? 3 : 6, fill: () => paint("measured") } },
];

const tensionFactor = 1e-3;  // N to kN

/** A curve pair for paper and files, over the whole lift whatever the page is zoomed to. */
function onPaper(data: PageData, curve: Curve, clock: Clock, large: boolean, range?: [number, number]): SVGElement {
  const scaled = (series: Series): Float32Array => series.values.map((value) => value * tensionFactor);
  const curves = drawingOrder.filter((state) => curve.series[state]).map((state) => ({ name: state, colour: stateColour[state],
    width: state === "static" ? 1.4 : 0.6, time: curve.series[state]!.time, values: scaled(curve.series[state]!), dots: false }));
  if (curve.measured) curves.push({ name: "measured" as State, colour: measuredColour, width: 0, time: curve.measured.time,
    values: scaled(curve.measured), dots: true });
  const marks = states.filter((state) => curve.peaks[state]).map((state): PaperMark => {
    const { time, value } = curve.peaks[state]!;
    return { time, value: value * tensionFactor, colour: stateColour[state], below: state === "static",
      text: large ? `${state}: ${kilonewtons(value)} kN at ${seconds(time)} s` : undefined };
  });
  return paperPlot({ label: `Tension of ${curve.name} over time, static and dynamic`, unit: large ? `${curve.name}: tension, kN` : "kN",
    start: clock.start, end: clock.end, range, stages: data.stages, curves, marks, size: large ? "large" : "small" });
}

/** The names of stages as buttons that zoom to them. */
function stageButtons(data: PageData, group: Group): HTMLElement {
  const margin = 0.03;
  return h("div", { class: "buttons", role: "group", "aria-label": "Zoom to" },
    h("button", { type: "button", onclick: () => group.all() }, "whole lift"),
    data.stages.map((stage) => h("button", {
      type: "button", onclick: () => {
        const spread = margin * (stage.end - stage.start);
        group.zoom(Math.max(stage.start - spread, group.start), Math.min(stage.end + spread, group.end));
      },
    }, stage.name)));
}

function readoutText(curve: Curve, stages: Stage[], time: number): string {
  const value = (state: State): number => curve.series[state]?.at(time) ?? NaN;
  const still = value("static");
  const moving = value("dynamic");
  const parts = [`${seconds(time)} s`, stageAt(stages, time)];
  if (Number.isFinite(still)) parts.push(`static ${kilonewtons(still)} kN (${tonnesForce(still)} tonnes)`);
  if (Number.isFinite(moving)) parts.push(`dynamic ${kilonewtons(moving)} kN (${tonnesForce(moving)} tonnes)`);
  if (Number.isFinite(still) && Number.isFinite(moving) && still > 0) parts.push(change((moving / still - 1) * 100));
  return parts.filter(Boolean).join("   ·   ");
}

export function historiesSection(data: PageData, clock: Clock): Section | null {
  const curves = curvesOf(data);
  if (curves.length === 0) return null;
  const group = new Group(clock.start, clock.end);
  const factor = tensionFactor;
  const ropes = data.summary.ropes ?? [];
  const loudest = [...ropes].sort((a, b) => (b.max_dynamic_tension_N ?? 0) - (a.max_dynamic_tension_N ?? 0))[0];
  let shown = curves.find((curve) => curve.name === loudest?.name) ?? curves[0];

  const readout = h("p", { class: "readout", "aria-live": "off" });
  const read = (time: number | null): void => { readout.textContent = readoutText(shown, data.stages, time ?? clock.time); };
  const host = h("div", {
    class: "plot large", tabindex: 0, role: "img", "aria-label": "Tension over time; arrow keys "
      + "move, plus and minus zoom, 0 shows all",
    onkeydown: (event: KeyboardEvent) => {
      const keys: Record<string, () => void> = {
        ArrowLeft: () => group.move(-0.1, 1), ArrowRight: () => group.move(0.1, 1),
        "+": () => group.move(0, 0.8), "=": () => group.move(0, 0.8), "-": () => group.move(0, 1.25), "0": () => group.all(),
      };
      if (keys[event.key]) { keys[event.key](); event.preventDefault(); }
    },
  });
  const tiles = curves.map((curve) => {
    const plotHost = h("div", { class: "plot" });
    const tile = h("button", {
      type: "button", class: "tile-name", "aria-pressed": String(curve === shown),
      title: "Show in the large plot", onclick: () => choose(curve),
    }, curve.name);
    return { curve, plotHost, tile };
  });
  let large: uPlot | null = null;
  const choose = (curve: Curve): void => {
    shown = curve;
    for (const one of tiles) one.tile.setAttribute("aria-pressed", String(one.curve === curve));
    if (large) {
      const { min, max } = large.scales.x;
      large.setData(aligned(drawn(curve), factor), false);
      large.setScale("x", { min: min!, max: max! });
    }
    paper.replaceChildren(onPaper(data, curve, clock, true));
    heading.textContent = `${curve.kind === "rope" ? "Rope" : "Hoist"} ${curve.name}`;
    read(null);
  };
  const heading = h("h3", {}, "");
  const paper = h("div", { class: "on-paper" });
  const widest: Record<string, number> = {};
  for (const curve of curves) {
    const { low, high } = extent(curve);
    widest[curve.kind] = Math.max(widest[curve.kind] ?? 0, (high - low) * factor * 1.12);
  }
  /** Every small plot spans the same number of kN, around its own middle, so that swings can be compared. */
  const sameSpan = (curve: Curve): uPlot.Range.MinMax => {
    const { low, high } = extent(curve);
    const middle = (low + high) / 2 * factor;
    const half = Math.max(widest[curve.kind] / 2, 0.5);
    return middle - half < 0 && low >= 0 ? [0, 2 * half] : [middle - half, middle + half];
  };

  // The plots need the width of their places, which they have once the section stands in the page.
  requestAnimationFrame(() => {
    large = makePlot({
      host, height: 340, group, clock, unit: "tension, kN", small: false, series: pairSeries(false), cursor: read,
      plugins: [stageBands(data.stages, true), marks(() => shown, clock, factor, true)],
      range: (_, min, max) => { const room = 0.12 * Math.max(max - min, 1); return [min >= 0 ? Math.max(min - room, 0) : min - room, max + room]; },
    }, aligned(drawn(shown), factor));
    for (const { curve, plotHost } of tiles) {
      makePlot({
        host: plotHost, height: 130, group, clock, unit: "kN", small: true, series: pairSeries(true),
        plugins: [stageBands(data.stages, false), marks(() => curve, clock, factor, false)],
        range: sameSpan(curve),
      }, aligned(drawn(curve), factor));
    }
    choose(shown);
    clock.listen(() => { group.redraw(); read(null); });
  });

  const grid = (kind: string): HTMLElement => h("div", { class: "tiles" }, tiles.filter((one) => one.curve.kind === kind)
    .map(({ curve, tile, plotHost }) => {
      const drawing = onPaper(data, curve, clock, false, sameSpan(curve) as [number, number]);
      return h("div", { class: "tile" }, tile, svgButton(`tension of ${curve.name}`, () => drawing), plotHost, h("div", { class: "on-paper" }, drawing));
    }));
  /** Folded away on the screen; on paper, where nothing unfolds, as drawings of their own. */
  const hoists = (): (HTMLElement | false)[] => {
    const all = curves.filter((curve) => curve.kind === "hoist");
    if (all.length === 0) return [];
    const drawings = all.map((curve) => h("figure", {}, h("figcaption", {}, curve.name),
      onPaper(data, curve, clock, false, sameSpan(curve) as [number, number])));
    return [h("details", { class: "of-screen" }, h("summary", {}, "Hoists"), grid("hoist")),
      h("div", { class: "on-paper hoists" }, h("h3", {}, "Hoists"), h("div", { class: "tiles" }, drawings))];
  };
  return {
    id: "histories", title: "Rope tensions", content: [
      h("div", { class: "plot-head" }, heading, legend(), svgButton("tension", () => onPaper(data, shown, clock, true))),
      stageButtons(data, group), host, paper, readout,
      h("p", { class: "hint" }, "Drag to zoom, double-click for all, click to set the drawing's "
        + "instant (dashed). Rings mark the largest values. "
        + "The small plots all span the same number of kN; choose one by its name."),
      measuredText(data) && h("p", {}, measuredText(data)),
      grid("rope"),
      ...hoists()],
  };
}

function legend(): HTMLElement {
  return h("span", { class: "legend" }, states.map((state) =>
    h("span", {}, h("i", { class: state }), state)));
}

const palette = ["#2f6396", "#d2601a", "#3f8f5b", "#8d5aa5", "#a8842c", "#c2456b", "#4aa3b5", "#6b7682"];

/** Which of the series run within a hundredth of all their span along an earlier one, which they would hide. */
function runAlong(series: Series[]): boolean[] {
  const all = series.map(({ values }) => values.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]));
  const span = Math.max(...all.map(([, high]) => high)) - Math.min(...all.map(([low]) => low));
  return series.map((one, i) => series.slice(0, i).some((earlier) => {
    let near = 0;
    one.time.forEach((time, k) => { if (Math.abs(one.values[k] - earlier.at(time)) <= 0.01 * span) ++near; });
    return near >= 0.5 * one.time.length;
  }));
}

/** A plot of series in one unit with its legend; it is drawn once its place in the page has a width. */
function tileOf(data: PageData, group: Group, clock: Clock, settings: {
  title: string; packed: PackedSeries[]; series: Series[]; label: (one: PackedSeries) => string; factor: number; unit: string; plugins?: uPlot.Plugin[];
}): HTMLElement {
  const { packed, series } = settings;
  const host = h("div", { class: "plot" });
  const colour = (i: number): string => (packed.length === 1 ? "#5f7f9f" : palette[i % palette.length]);
  const dashes = runAlong(series).map((along, i) => (along ? [5, 3 + 3 * (i % 3)] : undefined));
  requestAnimationFrame(() => makePlot({
    host, height: 200, group, clock, unit: settings.unit, small: false, plugins: [stageBands(data.stages, false), ...settings.plugins ?? []],
    series: packed.map((one, i) => ({ label: one.name, stroke: colour(i), width: 1.3, dash: dashes[i], spanGaps: true, points: { show: false } })),
  }, aligned(series, settings.factor)));
  const drawing = paperPlot({ label: settings.title, unit: settings.unit, start: clock.start, end: clock.end, stages: data.stages, size: "middle",
    curves: packed.map((one, i) => ({ name: one.name, colour: colour(i), width: 0.9, dash: dashes[i], time: series[i].time,
      values: series[i].values.map((value) => value * settings.factor) })) });
  return h("div", { class: "tile" }, h("h3", { class: "tile-title" }, settings.title, svgButton(settings.title, () => drawing)), host,
    h("div", { class: "on-paper" }, drawing), packed.length > 1 && h("span", { class: "legend" },
    packed.map((one, i) => h("span", { title: one.description }, h("i", { style: `background:${colour(i)}` }), settings.label(one)))));
}

/** Terms of energy over time; the balance, that should be nothing, in a plot of its own. */
export function energyPlot(data: PageData, history: History): HTMLElement {
  const group = new Group(history.start, history.end);
  const clock = new Clock(history.start, history.start, history.end);
  const plots: HTMLElement[] = [];
  const add = (title: string, packed: PackedSeries[], factor: number, unit: string): void => {
    if (packed.length === 0) return;
    const series = packed.map((one) => new Series(one));
    // Potential energy has no zero of its own: from the start on, it stands on the scale of the work done.
    for (const { values } of series.filter((_, i) => packed[i].name === "gravity")) values.set(values.map((value, _, all) => value - all[0]));
    plots.push(tileOf(data, group, clock, { title, packed, series, factor, unit,
      label: (one) => (one.name === "gravity" ? "gravity, from the start" : one.name.replace(/_/g, " ")) }));
  };
  const largest = Math.max(0, ...history.energy.flatMap((one) => Array.from(new Series(one).values, Math.abs)));
  const [factor, unit] = largest < 1e4 ? [1, "J"] : largest < 1e6 ? [1e-3, "kJ"] : [1e-6, "MJ"];
  add("Energies of the dynamic run", history.energy.filter((one) => one.name !== "balance"), factor, unit);
  add("What the balance leaves unexplained", history.energy.filter((one) => one.name === "balance"), 1, "J");
  return h("div", { class: "tiles two" }, plots);
}

/** A line at the instant of the drawing. */
function nowLine(clock: Clock): uPlot.Plugin {
  return { hooks: { draw: (u) => {
    const now = u.valToPos(clock.time, "x", true);
    u.ctx.save();
    u.ctx.strokeStyle = paint("ink");
    u.ctx.lineWidth = devicePixelRatio;
    u.ctx.setLineDash([3 * devicePixelRatio, 3 * devicePixelRatio]);
    u.ctx.beginPath();
    u.ctx.moveTo(now, u.bbox.top);
    u.ctx.lineTo(now, u.bbox.top + u.bbox.height);
    u.ctx.stroke();
    u.ctx.restore();
  } } };
}

/** A plot for each kind of measure in motion. */
export function measurePlots(data: PageData, clock: Clock, kinds: { kind: string; packed: PackedSeries[] }[]): HTMLElement {
  const group = new Group(clock.start, clock.end);
  const scales: Record<string, [number, string]> = { N: [1e-3, "kN"], rad: [180 / Math.PI, "°"], m: [1, "m"], "1": [100, "%"] };
  clock.listen(() => group.redraw());
  return h("div", { class: "tiles two" }, kinds.map(({ kind, packed }) => {
    const [factor, unit] = scales[packed[0].units] ?? [1, packed[0].units];
    return tileOf(data, group, clock, {
      title: `${kind[0].toUpperCase()}${kind.slice(1)} in motion, ${unit}`, packed, series: packed.map((one) => new Series(one)),
      label: (one) => one.name.slice(0, -kind.length - 2), factor, unit, plugins: [nowLine(clock)] });
  }));
}

/** What a mechanism file asks for: a plot for each output and unit. */
export function outputsSection(data: PageData, clock: Clock): Section | null {
  const outputs = data.outputs ?? [];
  if (outputs.length === 0) return null;
  const group = new Group(clock.start, clock.end);
  const tiles = new Map<string, PackedSeries[]>();
  for (const one of outputs) {
    const key = `${one.name.replace(/_/g, " ")}, ${one.units}`;
    tiles.set(key, [...tiles.get(key) ?? [], one]);
  }
  clock.listen(() => group.redraw());
  return { id: "outputs", title: "Outputs", content: [
    h("p", { class: "hint" }, "Drag to zoom, double-click for all, click to set the drawing's "
      + "instant (dashed)."),
    h("div", { class: "tiles two" }, [...tiles].map(([title, packed]) => tileOf(data, group, clock, {
      title, packed, series: packed.map((one) => new Series(one)), label: (one) => one.quantity.replace(/_/g, " "), factor: 1,
      unit: packed[0].units, plugins: [nowLine(clock)] })))] };
}
