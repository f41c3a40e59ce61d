// Curves of several results, or of a computed lift and of what was measured of it, over each other: a drawing for each
// quantity.
import { PackedSeries, Series } from "./data";
import { equip, h } from "./dom";
import { PaperCurve, paperPlot } from "./paper_plot";

export interface ComparedResult { name: string; static: PackedSeries[]; dynamic: PackedSeries[] }

// Okabe and Ito's colours, which differ for colour-blind eyes too, without those that paper swallows.
const colours = ["#2f6396", "#d2601a", "#009e73", "#8e4585", "#a07800", "#4a4a4a"];
const colourOf = (result: number): string => colours[result % colours.length];

/** The unit in which values of an SI unit are drawn, and how many of it one is. */
const shownUnits: Record<string, [string, number]> = { N: ["kN", 1e-3], rad: ["deg", 180 / Math.PI] };
const shownUnit = (unit: string): [string, number] => shownUnits[unit] ?? [unit, 1];
const capital = (word: string): string => word.charAt(0).toUpperCase() + word.slice(1);

/** Names of what is drawn in the order in which the results bring them up. */
function namesOf(results: ComparedResult[], state: "static" | "dynamic"): string[] {
  return [...new Set(results.flatMap((result) => result[state].map((series) => series.name)))];
}

function drawing(results: ComparedResult[], state: "static" | "dynamic", name: string): HTMLElement | null {
  const curves: PaperCurve[] = [];
  let [start, end] = [Infinity, -Infinity];
  let [unit, quantity] = ["", ""];
  results.forEach((result, i) => {
    const packed = result[state].find((series) => series.name === name);
    if (!packed) return;
    const { time, values } = new Series(packed);
    if (time.length === 0) return;
    const [shown, factor] = shownUnit(packed.units);
    [unit, quantity] = [shown, packed.quantity];
    start = Math.min(start, time[0]);
    end = Math.max(end, time[time.length - 1]);
    curves.push({ name: result.name, colour: colourOf(i), width: 1.1, time, values: values.map((value) => value * factor) });
  });
  if (curves.length === 0) return null;
  const when = state === "dynamic" ? "in motion" : "at rest";
  return h("figure", { style: "margin: 1rem 0; background: #ffffff; color: #1d2730" }, h("figcaption", {}, `${name}, ${when}`),
    paperPlot({ label: `${capital(quantity)} of ${name} ${when}: ${curves.map((curve) => curve.name).join(", ")}`, unit, start, end, stages: [], curves, size: "large" }));
}

/** What the page's data has of the curves. */
export interface CurvesData { results: ComparedResult[]; heading?: string }

/** Makes the page of its tables and its curves. @param links to further sections */
export function showCurves({ results, heading }: CurvesData, links: HTMLElement[] = []): void {
  for (const element of document.querySelectorAll<HTMLElement>(".table")) equip(element);
  const state = results.some((result) => result.dynamic.length > 0) ? "dynamic" : "static";
  const drawings = namesOf(results, state).map((name) => drawing(results, state, name)).filter((one) => one !== null);
  const contents = document.getElementById("contents")!;
  contents.append(h("a", { href: "#figures" }, "Figures"), ...links);
  if (drawings.length > 0) {
    const legend = h("p", { class: "legend" }, results.map((result, i) =>
      h("span", { style: `color: ${colourOf(i)}; margin-right: 1.5em; font-weight: 600` }, `\u2013 ${result.name}`)));
    document.getElementById("report")!.append(h("section", { id: "curves" }, h("h2", {}, heading ?? "Tensions over each other"), legend, drawings));
    contents.append(h("a", { href: "#curves" }, heading ? "Curves" : "Tensions"));
  }
  document.body.classList.add("ready");
}
