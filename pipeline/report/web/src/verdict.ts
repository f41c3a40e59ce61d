// The verdict, first on the page, and the checks it rests on.
import { Check, known, LoadMaxima, PageData, Structure } from "./data";
import { Child, h, table } from "./dom";
import type { Section } from "./section";
import { accuracyText } from "./structure";
import { change, inReportUnit, kilonewtons, megapascals, millimetres, missing, ratio, seconds, share, tonnesForce } from "./numbers";

// What stands for the utilisation where nothing finite describes it: a rope that has gone slack.
const beyondAnyLimit = 999;

export function bar(utilisation: unknown, pass: boolean): Child {
  if (!known(utilisation)) return missing;
  const full = 1.25;  // the bar ends at 125 %, so that an excess shows
  const width = Math.min(Math.max(utilisation, 0) / full, 1) * 100;
  return h("span", { class: "utilisation" },
    h("span", { class: "bar", "aria-hidden": "true" },
      h("span", { class: pass ? "fill" : "fill failed", style: `width:${width}%` }),
      h("span", { class: "limit", style: `left:${100 / full}%` })),
    h("span", { class: "value" }, utilisation < beyondAnyLimit ? share(utilisation) : "beyond any limit"));
}

export function mark(pass: boolean): Child {
  return h("span", { class: pass ? "mark pass" : "mark fail" }, pass ? "pass" : "fail");
}

/** Failed checks before passed ones, the most utilised first. */
function governingCheck(checks: Check[]): Check | undefined {
  return [...checks].sort((a, b) =>
    Number(a.pass) - Number(b.pass) || (b.utilisation ?? 0) - (a.utilisation ?? 0))[0];
}

function largest(loads: LoadMaxima[], value: (load: LoadMaxima) => unknown): LoadMaxima | undefined {
  return loads.filter((load) => known(value(load)))
    .sort((a, b) => Number(value(b)) - Number(value(a)))[0];
}

function figure(label: string, value: string, unit: string, detail: Child): Child {
  return h("div", { class: "figure" }, h("div", { class: "label" }, label),
    h("div", { class: "value" }, value, unit ? h("span", { class: "unit" }, unit) : null),
    h("div", { class: "detail" }, detail));
}

/** The same increase by the ways of less knowledge than every instant, and as published. */
function beside(structure: Structure, increase: "stress_increase_percent" | "deformation_increase_percent",
  published: unknown): string {
  const ways: [string, unknown, number][] = [
    ["at the ropes' maxima", structure.history ? structure.simultaneous?.[increase] : undefined, 1],
    ["per-rope maxima", structure.simultaneous ? structure.per_rope_maxima?.[increase] : undefined, 1],
    ["published", published, 2]];
  return ways.filter(([, value]) => known(value)).map(([name, value, digits]) => `${name} ${change(value, digits)}`).join(", ");
}

function keyFigures(data: PageData): Child[] {
  const ropes = data.summary.ropes ?? [];
  const figures: Child[] = [];
  const still = largest(ropes, (rope) => rope.max_static_tension_N);
  const moving = largest(ropes, (rope) => rope.max_dynamic_tension_N);
  const jump = largest(ropes, (rope) => rope.dynamic_over_static);
  const when = (time: unknown): string => (known(time) ? ` at ${seconds(time)} s` : "");
  if (still) figures.push(figure("Largest rope load, static", kilonewtons(still.max_static_tension_N), "kN",
    `${tonnesForce(still.max_static_tension_N)} t in ${still.name}${when(still.time_of_max_static_s)}`));
  if (moving) figures.push(figure("Largest rope load, dynamic", kilonewtons(moving.max_dynamic_tension_N), "kN",
    `${tonnesForce(moving.max_dynamic_tension_N)} t in ${moving.name}${when(moving.time_of_max_dynamic_s)}`));
  if (jump) figures.push(figure("Dynamic over static, worst rope", ratio(jump.dynamic_over_static), "", `rope ${jump.name}`));
  const structure = data.summary.structure;
  const way = structure?.history ?? structure?.simultaneous ?? structure?.per_rope_maxima;
  if (structure && way) {
    const published = data.summary.comparison;
    figures.push(figure("Block stress increase", change(way.stress_increase_percent), "",
      [`${megapascals(way.static?.checked_von_mises_Pa)} to ${megapascals(way.dynamic?.checked_von_mises_Pa)} MPa`, h("br"),
        beside(structure, "stress_increase_percent", published?.stress_increase_percent), h("br"),
        accuracyText(structure.accuracy)]));
    figures.push(figure("Block deformation increase", change(way.deformation_increase_percent), "",
      [`${millimetres(way.static?.max_displacement_m)} to ${millimetres(way.dynamic?.max_displacement_m)} mm`, h("br"),
        beside(structure, "deformation_increase_percent", published?.deformation_increase_percent)]));
  }
  return figures;
}

export function verdictSection(data: PageData): HTMLElement {
  const { summary } = data;
  const checks = summary.checks ?? [];
  const pass = summary.verdict === "pass";
  const failed = checks.filter((check) => !check.pass).length;
  const governing = governingCheck(checks);
  const sentence = checks.length === 0 ? "The case asks for no checks."
    : failed === 0 ? (checks.length === 1 ? "The one check is met." : `All ${checks.length} checks are met.`)
    : `${failed} of ${checks.length} checks ${failed === 1 ? "is" : "are"} not met.`;
  const reasons = (summary.verdict_reasons ?? []).filter((reason) => reason);
  const assessed = summary.verdict !== undefined;
  return h("header", { id: "verdict" },
    h("p", { class: "kicker" }, assessed ? "Lift assessment" : "Simulation"),
    h("h1", {}, data.case.title || data.case.name),
    h("p", { class: "made" }, [data.case.name, data.case.created && dateText(data.case.created),
      data.case.program_version && `Blocklift ${data.case.program_version}`].filter(Boolean).join("  ·  ")),
    assessed && h("div", { class: pass ? "verdict pass" : "verdict fail" },
      h("div", { class: "word" }, pass ? "Pass" : "Fail"),
      h("div", { class: "why" },
        h("p", { class: "sentence" }, sentence),
        governing && h("div", { class: "governing" },
          h("span", {}, h("b", {}, pass ? "Governing: " : "Decisive: "), governing.name), demandText(governing),
          bar(governing.utilisation, governing.pass)),
        !pass && reasons.length > 1 && h("ul", {}, reasons.map((reason) => h("li", {}, reason))))),
    h("div", { class: "figures" }, keyFigures(data)),
    (summary.warnings ?? []).length > 0 && h("ul", { class: "warnings" },
      summary.warnings!.map((warning) => h("li", {}, warning))));
}

function demandText(check: Check): Child {
  const demand = inReportUnit(check.demand, check.unit ?? "1");
  const limit = inReportUnit(check.limit, check.unit ?? "1");
  return h("span", { class: "demand" }, `${demand.text} of ${limit.text} ${limit.unit}`);
}

function dateText(text: string): string {
  const date = new Date(text);
  return Number.isNaN(date.getTime()) ? text
    : date.toLocaleString("en-GB", { dateStyle: "long", timeStyle: "short", timeZone: "UTC" }) + " UTC";
}

export function checksSection(data: PageData): Section | null {
  const checks = data.summary.checks ?? [];
  if (checks.length === 0) return null;
  const timed = checks.some((check) => known(check.time_s));
  const columns = [
    { head: "Check", align: "left" as const }, { head: "Demand" }, { head: "Limit" }, { head: "Unit", align: "left" as const },
    ...(timed ? [{ head: "At, s" }] : []), { head: "Utilisation", align: "left" as const }, { head: "Result", align: "left" as const }];
  const rows = checks.map((check) => {
    const demand = inReportUnit(check.demand, check.unit ?? "1");
    const limit = inReportUnit(check.limit, check.unit ?? "1");
    return [[check.name, check.note ? h("span", { class: "note" }, check.note) : null], demand.text, limit.text, limit.unit,
      ...(timed ? [seconds(check.time_s)] : []), bar(check.utilisation, check.pass), mark(check.pass)];
  });
  return { id: "checks", title: "Checks", content: table("Every check, demand against limit", columns, rows, "checks") };
}
