// The report: sections one after another, each made of what the results have.

import { Clock } from "./clock";
import { PageData, readPageData, states } from "./data";
import { fillAnnex } from "./annex";
import { append, Child, equip, h } from "./dom";
import { accuracySection, methodSection } from "./accuracy";
import { faultSection } from "./fault";
import { historiesSection, outputsSection } from "./histories";
import { liftSection } from "./lift";
import { loadsSection } from "./loads";
import { measuresSection } from "./measures";
import { modesSection, VibrationPlayer } from "./modes";
import { padeyesSection } from "./padeyes";
import { Section } from "./section";
import { slingsSection } from "./slings";
import { standardSection } from "./standard";
import { stressSection } from "./stress";
import { structureSection } from "./structure";

function clockOf(data: PageData): Clock {
  const histories = states.map((state) => data.histories[state]).filter((one) => one !== null);
  if (histories.length === 0) return new Clock(0, 0, 0);
  const start = Math.min(...histories.map((one) => one.start));
  const end = Math.max(...histories.map((one) => one.end));
  const ropes = data.summary.ropes ?? [];
  const governing = ropes.reduce((best, rope) =>
    (rope.max_dynamic_tension_N ?? 0) > (best?.max_dynamic_tension_N ?? 0) ? rope : best, ropes[0]);
  return new Clock(governing?.time_of_max_dynamic_s ?? start, start, end);
}

function show(): void {
  const data = readPageData();
  const clock = clockOf(data);
  const vibrations = new VibrationPlayer();
  const report = document.getElementById("report")!;
  for (const element of report.querySelectorAll<HTMLElement>(".table")) equip(element);
  let annex = document.getElementById("annex");
  if (!annex) report.append(annex = h("section", { id: "annex" }, h("h2", {}, "Annex")));
  const makers: (() => Section | null)[] = [
    () => liftSection(data, clock, vibrations), () => modesSection(data, clock, vibrations), () => outputsSection(data, clock), () => historiesSection(data, clock), () => loadsSection(data, clock), () => measuresSection(data, clock), () => faultSection(data), () => slingsSection(data),
    () => stressSection(data), () => structureSection(data), () => padeyesSection(data),
    () => standardSection(data), () => accuracySection(data), () => methodSection(data),
  ];
  const links: Child[] = [h("a", { href: "#verdict" }, data.case.name || "Verdict")];
  let number = 0;
  const list = (section: Element, title: string): void => {
    number += 1;
    section.querySelector("h2")!.prepend(h("span", { class: "number" }, String(number)));
    links.push(h("a", { href: `#${section.id}` }, h("span", { class: "number" }, `${number} `), title));
  };
  const checks = document.getElementById("checks");
  if (checks) list(checks, "Checks");
  for (const make of makers) {
    let section: Section | null;
    try {
      section = make();
    } catch (error) {  // one section that fails must not take the others along
      console.error(error);
      section = { id: `failed-${number + 1}`, title: "A section is missing", content: h("p", {}, `It could not be drawn: ${String(error)}`) };
    }
    if (!section) continue;
    const element = h("section", { id: section.id }, h("h2", {}, section.title), section.content);
    annex.before(element);
    list(element, section.short ?? section.title);
  }
  fillAnnex(annex);
  if (annex.children.length > 1) list(annex, "Annex");
  else annex.remove();
  append(document.getElementById("contents")!, links);
  document.body.classList.add("ready");
}

show();
