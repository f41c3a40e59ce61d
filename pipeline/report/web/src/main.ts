// The report: sections one after another, each made of what the results have.

import { Clock } from "./clock";
import { PageData, readPageData, states } from "./data";
import { append, Child, h } from "./dom";
import { accuracySection, methodSection } from "./accuracy";
import { checksSection, verdictSection } from "./verdict";
import { historiesSection, outputsSection } from "./histories";
import { liftSection } from "./lift";
import { loadsSection } from "./loads";
import { modesSection, VibrationPlayer } from "./modes";
import { padeyesSection } from "./padeyes";
import { Section } from "./section";
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
  append(report, [verdictSection(data)]);
  const makers: (() => Section | null)[] = [
    () => liftSection(data, clock, vibrations), () => modesSection(data, clock, vibrations), () => outputsSection(data, clock), () => historiesSection(data, clock), () => loadsSection(data, clock),
    () => stressSection(data), () => structureSection(data), () => padeyesSection(data),
    () => standardSection(data), () => checksSection(data),
    () => accuracySection(data), () => methodSection(data),
  ];
  const links: Child[] = [h("a", { href: "#verdict" }, data.case.name || "Verdict")];
  let number = 0;
  for (const make of makers) {
    let section: Section | null;
    try {
      section = make();
    } catch (error) {  // one section that fails must not take the others along
      console.error(error);
      section = { id: `failed-${number + 1}`, title: "A section is missing", content: h("p", {}, `It could not be drawn: ${String(error)}`) };
    }
    if (!section) continue;
    number += 1;
    append(report, [h("section", { id: section.id }, h("h2", {}, h("span", { class: "number" }, String(number)), section.title),
      section.content)]);
    links.push(h("a", { href: `#${section.id}` }, section.short ?? section.title));
  }
  append(document.getElementById("contents")!, links);
  document.body.classList.add("ready");
}

show();
