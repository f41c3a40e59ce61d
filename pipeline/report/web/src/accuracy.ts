// How far the numbers can be trusted, and what they rest on.
import { addToAnnex } from "./annex";
import { History, known, PageData, State, states } from "./data";
import { Child, Column, h, table } from "./dom";
import { energyPlot } from "./histories";
import type { Section } from "./section";
import { fixed, missing, scientific, significant } from "./numbers";

const left = (head: string): Column => ({ head, align: "left" });
const plain = (name: string): string => {
  const text = name.replace(/_s$/, "").replace(/_/g, " ");
  return text.charAt(0).toUpperCase() + text.slice(1);
};

function valueText(value: unknown): string {
  if (typeof value === "string") return value;
  if (typeof value === "boolean") return value ? "yes" : "no";
  if (!known(value)) return missing;
  return Number.isInteger(value) ? fixed(value, 0) : Math.abs(value) < 1e-3 ? scientific(value) : significant(value, 3);
}

function energyTable(data: PageData): Child {
  const energy = data.summary.energy;
  if (!energy) return null;
  return table("Energy balance of the integration", [left("Quantity"), { head: "Value" }, left("Unit")], [
    ["Largest energy in play", known(energy.largest_energy_J) ? significant(energy.largest_energy_J / 1e3, 4) : missing, "kJ"],
    ["Largest imbalance", known(energy.largest_imbalance_J) ? significant(energy.largest_imbalance_J / 1e3, 2) : missing, "kJ"],
    ["Imbalance relative to it", scientific(energy.relative_imbalance), ""]]);
}

function speedText(data: PageData): string {
  const timing = data.summary.timing ?? {};
  return known(timing.simulated_s) && known(timing.dynamic_s) && timing.dynamic_s > 0
    ? `The dynamics ran ${significant(timing.simulated_s / timing.dynamic_s, 2)} times faster than the lift.` : "";
}

export function accuracySection(data: PageData): Section | null {
  const { energy, solver, timing } = data.summary;
  const history: History | null = data.histories.dynamic;
  if (!energy && !solver && !timing && !history?.energy.length) return null;
  addCost(data);
  const samples = states.filter((state: State) => data.histories[state])
    .map((state) => `${fixed(data.histories[state]!.samples, 0)} ${state}`).join(" and ");
  return {
    id: "accuracy", title: "Accuracy", content: [
      history?.energy.length ? energyPlot(data, history) : null,
      energyTable(data),
      h("p", { class: "source" }, [samples && `Results hold ${samples} samples.`, speedText(data)].filter(Boolean).join(" "))],
  };
}

/** What the computation cost, for the annex. */
function addCost(data: PageData): void {
  const { solver, timing } = data.summary;
  if (solver) addToAnnex("Computation", table("Solver", [left("Quantity"), { head: "Value" }],
    Object.entries(solver).filter(([, value]) => typeof value !== "object").map(([name, value]) => [plain(name), valueText(value)])));
  if (timing) addToAnnex("Computation", table("Computing time", [left("Part"), { head: "s" }],
    Object.entries(timing).filter(([name, value]) => name !== "simulated_s" && known(value))
      .map(([name, value]) => [plain(name), significant(value, 3)])));
}

export function methodSection(data: PageData): Section {
  const { summary } = data;
  const moved = data.histories.dynamic !== null || data.histories.static !== null;
  const structure = Boolean(summary.structure);
  return {
    id: "method", title: "Assumptions and method", short: "Method", content: [
      (summary.assumptions ?? []).length > 0 && [h("h3", {}, "Assumptions"),
        h("ul", { class: "assumptions" }, summary.assumptions!.map((text) => h("li", {}, text)))],
      h("h3", {}, "Method"),
      moved && h("p", {}, "Cranes, hook blocks and load are rigid bodies joined by driven joints "
        + "and by ropes that pull but never push; "
        + "rope and crane stiffness act in series. The equations of motion are set up recursively "
        + "along the tree of bodies. The static "
        + "curve is the equilibrium found at a row of instants of the operation; the dynamic "
        + "curve integrates the equations in time with "
        + "an implicit method of variable order and step that stops at stage changes and when a "
        + "rope goes slack or tightens."),
      structure && h("p", {}, "The rope forces act on the lugs, in the block's frame, together "
        + "with the block's weight and inertia, so that "
        + "forces and moments balance. The block is linear elastic: shells on the mid-planes of "
        + "its plates, and beams; its supports only take "
        + "away rigid motion and carry nothing. Displacements are relative to the rigid motion. "
        + "The raw peak stress can lie at a sharp corner, "
        + "where it grows with every refinement of the mesh; the checked stress is a mean over "
        + "squares of 50 x 50 mm, which does not, and is the "
        + "one compared with yield."),
      h("p", {}, "A utilisation is demand over limit; the verdict is a pass when every check "
        + "passes. Forces in tonnes (1000 kg) are kN divided by 9.80665 m/s²."),
      (summary.files ?? []).length > 0 && table("Files of this result", [left("File"), left("Content")],
        summary.files!.map((file) => [h("code", {}, file.name), file.content])),
      data.case.yaml && h("details", { class: "case" }, h("summary", {}, "The case file"), h("pre", { tabindex: 0 }, data.case.yaml))],
  };
}
