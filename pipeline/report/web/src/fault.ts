// When a fault is worst: the largest share of a breaking load that it brings, over the instant at which it comes.
import { known, PageData, TriedInstant } from "./data";
import { Child, Column, h, table } from "./dom";
import { missing, seconds, share } from "./numbers";
import { paperPlot } from "./paper_plot";
import type { Section } from "./section";

const part = (value: unknown): string => known(value) ? share(value) : missing;

export function faultSection(data: PageData): Section | null {
  const worst = data.summary.worst_instant;
  if (!worst) return null;
  const tried = (worst.tried ?? []).filter((one) => known(one.time_s) && known(one.share));
  const undisturbed = worst.undisturbed;
  const columns: Column[] = [{ head: "The fault comes at, s" }, { head: "Most loaded", align: "left" }, { head: "of its breaking load" },
    { head: "at, s" }];
  const row = (one: TriedInstant): Child[] => [seconds(one.time_s), one.rope, part(one.share), seconds(one.peak_time_s)];
  const ranked = [...tried].sort((a, b) => (b.share ?? 0) - (a.share ?? 0)).slice(0, 10).map(row);
  if (undisturbed) ranked.push(["never", undisturbed.rope, part(undisturbed.share), seconds(undisturbed.peak_time_s)]);
  const content: Child[] = [
    h("p", { class: "lead" }, `The fault comes at ${seconds(worst.time_s)} s, the worst of ${tried.length} instants that were tried: `
      + `${worst.rope} carries ${part(worst.share)} of its breaking load then. What was not tried may be worse.`)];
  if (tried.length > 1) {
    const time = tried.map((one) => one.time_s!), values = tried.map((one) => 100 * one.share!);
    const marks = known(worst.time_s) && known(worst.share)
      ? [{ time: worst.time_s, value: 100 * worst.share, colour: "#b3261e", text: `${worst.rope} ${part(worst.share)}` }] : [];
    content.push(paperPlot({ label: "Largest share of a breaking load over the instant of the fault", unit: "%", size: "large",
      start: 0, end: Math.max(...time, ...data.stages.map((stage) => stage.end)), stages: data.stages, marks,
      curves: [{ name: "tried", colour: "#1f5fa8", width: 1, time, values, dots: true }] }));
  }
  content.push(table("Worst instants", columns, ranked));
  return { id: "fault", title: "When the fault is worst", short: "Worst instant", content };
}
