// Figures that follow from the motion: attitudes, sling angles, radii, crane loads, clearances.
import { Clock } from "./clock";
import { folded } from "./annex";
import { known, Measure, PackedSeries, PageData, stageAt } from "./data";
import { Child, Column, h } from "./dom";
import { measurePlots } from "./histories";
import { fixed, kilonewtons, missing, seconds, share } from "./numbers";
import type { Section } from "./section";

/** A value in the unit in which an engineer reads such figures. */
export function measureText(value: unknown, unit: string): string {
  if (!known(value)) return missing;
  if (unit === "N") return `${kilonewtons(value)} kN`;
  if (unit === "N m") return `${kilonewtons(value)} kN m`;
  if (unit === "rad") return `${fixed(value * 180 / Math.PI, 2)}\u00a0°`;
  if (unit === "m") return `${fixed(value, 2)} m`;
  return unit === "1" ? share(value) : `${value} ${unit}`;
}

function instant(data: PageData, clock: Clock, value: unknown, time: unknown): Child {
  if (!known(value) || !known(time)) return missing;
  if (!data.scene) return seconds(time);
  return h("button", {
    class: "time", type: "button", title: `Show this instant in the drawing (${stageAt(data.stages, time)})`,
    onclick: () => { clock.set(time); document.getElementById("lift")?.scrollIntoView({ behavior: "smooth" }); },
  }, seconds(time));
}

/** Those of a kind, the one that is furthest out first. */
function ranked(measures: Measure[]): Measure[] {
  const rank = (one: Measure): number => {
    const both = [one.static, one.dynamic].filter(known);
    if (both.length === 0) return -Infinity;
    return one.extreme === "smallest" ? -Math.min(...both) : Math.max(...both.map((x) => (one.extreme === "largest" ? x : Math.abs(x))));
  };
  return [...measures].sort((a, b) => rank(b) - rank(a));
}

export function measuresSection(data: PageData, clock: Clock): Section | null {
  const measures = data.summary.measures ?? [];
  if (measures.length === 0) return null;
  const kinds = [...new Set(measures.map((one) => one.kind))];
  const columns: Column[] = [{ head: "Figure", align: "left" }, { head: "of", align: "left" }, { head: "counted", align: "left" },
    { head: "At rest" }, { head: "at, s" }, { head: "In motion" }, { head: "at, s" }];
  const row = (one: Measure): Child[] => [h("span", { title: one.meaning ?? "" }, one.kind), one.subject, one.extreme ?? "",
    measureText(one.static, one.unit), instant(data, clock, one.static, one.time_of_static_s),
    measureText(one.dynamic, one.unit), instant(data, clock, one.dynamic, one.time_of_dynamic_s)];
  const worst = kinds.map((kind) => ranked(measures.filter((one) => one.kind === kind))[0]);
  const rest = kinds.flatMap((kind) => ranked(measures.filter((one) => one.kind === kind)).slice(1));
  const series = data.histories.dynamic?.measures ?? [];
  // More curves than that cannot be told apart; the table in the annex has all.
  const most = 8;
  const ofKind = (kind: string): PackedSeries[] => {
    const furthest = ranked(measures.filter((one) => one.kind === kind)).slice(0, most).map((one) => one.name);
    return series.filter((one) => furthest.includes(one.name));
  };
  return {
    id: "measures", title: "Attitude, angles, radii and clearances", short: "Angles and clearances", content: [
      h("p", { class: "lead" }, "What follows from where the parts are and what pulls at them, "
        + "over the whole operation: of each kind the one that is furthest out."),
      folded("Angles and clearances", "Furthest out", columns, [...worst, ...rest].map(row), worst.length),
      measurePlots(data, clock, kinds.map((kind) => ({ kind, packed: ofKind(kind) })).filter(({ packed }) => packed.length > 0))],
  };
}
