// The lift by the rules of a standard: utilisations, and each chain of factors beside the simulation.
import { Chain, ChainStep, known, PageData } from "./data";
import { Child, h, table } from "./dom";
import type { Section } from "./section";
import { fixed, inReportUnit, missing, tonnesForce } from "./numbers";
import { bar, mark } from "./utilisation";
import { folded } from "./annex";

/** A load with its unit, in tonnes where it is a force; a factor with three digits behind the point. */
function value(number: unknown, unit: string): string {
  if (!known(number)) return missing;
  if (unit === "1") return fixed(number, 3);
  if (unit === "N") return `${tonnesForce(number)} tonnes`;
  const shown = inReportUnit(number, unit);
  return `${shown.text} ${shown.unit}`;
}

const signs: Record<ChainStep["kind"], string> = { load: "+", factor: "×", result: "=", told: "" };

function stepRow(step: ChainStep, first: boolean): Child[] {
  const strong = (text: string): Child => (step.kind === "result" ? h("b", {}, text) : text);
  return [first ? "" : signs[step.kind], [step.name, step.formula ? h("span", { class: "note" }, step.formula) : null],
    strong(value(step.standard, step.unit)), strong(value(step.simulated, step.unit)), step.clause || missing];
}

function chainTable(chain: Chain, governing: boolean): Child {
  const rows = chain.steps.map((step, i) => stepRow(step, i === 0));
  if (known(chain.limit)) {
    rows.push(["≤", [h("b", {}, "limit"), h("span", { class: "note" }, chain.limit_text ?? "")],
      value(chain.limit, chain.unit), value(chain.simulated_limit, chain.unit), chain.limit_clause || missing]);
    rows.push(["", h("b", {}, "utilisation"), h("b", {}, fixed(chain.standard_utilisation, 3)),
      h("b", {}, fixed(chain.simulated_utilisation, 3)), ""]);
  }
  return h("details", { class: "chain", open: governing }, h("summary", {}, chain.name),
    table(`Chain of factors: ${chain.name}`, [{ head: "", align: "left" }, { head: "Step", align: "left" },
      { head: "By the standard" }, { head: "By the simulation" }, { head: "Clause, or key of the "
        + "input", align: "left" }], rows, "checks"));
}

function utilisations(chains: Chain[], governing: string | undefined): Child {
  const utilisation = (chain: Chain): number => Math.max(chain.simulated_utilisation ?? 0, chain.standard_utilisation ?? 0);
  const sorted = chains.filter((chain) => known(chain.limit))
    .sort((a, b) => Number(a.pass) - Number(b.pass) || utilisation(b) - utilisation(a));
  const rows = sorted.map((chain) => [
    [chain.name, chain.name === governing ? h("span", { class: "note" }, "governing") : null, h("span", { class: "note" }, chain.limit_text ?? "")],
    value(chain.standard, chain.unit), value(chain.limit, chain.unit),
    bar(chain.standard_utilisation, (chain.standard_utilisation ?? 0) <= 1),
    value(chain.simulated, chain.unit), value(chain.simulated_limit, chain.unit),
    bar(chain.simulated_utilisation, (chain.simulated_utilisation ?? 0) <= 1), mark(chain.pass === true)]);
  return folded("By the rules", "Utilisations: by the standard's factors, and with the simulation "
    + "in their place", [
    { head: "What", align: "left" }, { head: "By the standard" }, { head: "Limit" }, { head: "Utilisation", align: "left" },
    { head: "By the simulation" }, { head: "Limit" }, { head: "Utilisation", align: "left" }, { head: "Result", align: "left" }],
  rows, Math.max(6, sorted.filter((chain) => !chain.pass).length), "checks");
}

export function standardSection(data: PageData): Section | null {
  const standard = data.summary.standard;
  if (!standard || standard.chains.length === 0) return null;
  return {
    id: "standard", title: `By the rules ${standard.name}`, short: standard.name, content: [
      h("p", { class: "lead" }, "The standard's column takes every factor of its rules on the "
        + "largest load at rest. The simulation's column takes what "
        + "the motion did to this very thing in place of amplification, tilt and yaw. Both take "
        + "contingency and centre of mass."),
      h("ul", {}, (standard.notes ?? []).map((note) => h("li", {}, note))),
      utilisations(standard.chains, standard.governing),
      standard.chains.map((chain) => chainTable(chain, chain.name === standard.governing)),
      h("p", { class: "source" }, `${standard.title ?? ""}, ${standard.edition ?? ""}. Figures: ${standard.source ?? ""}.`)],
  };
}
