// Padeyes: a side view with the stress of the fine mesh, and the hand formulae.
import { scaleCss } from "./colours";
import { known, PadeyePicture, PadeyeSummary, PageData } from "./data";
import { folded } from "./annex";
import { Child, h, svg } from "./dom";
import { svgButton } from "./download";
import type { Section } from "./section";
import { inReportUnit, kilonewtons, megapascals, missing, scientific, seconds, share, significant } from "./numbers";

const width = 300;  // of a picture, px

/** Main plate behind, the front cheek plate upon it, and the pull of the pin as an arrow. */
function picture(padeye: PadeyePicture, largest: number): Child {
  const places = padeye.corners.flatMap((corners) => [0, 1, 2, 3].map((i) => [corners[2 * i], corners[2 * i + 1]]));
  const left = Math.min(...places.map(([x]) => x)), right = Math.max(...places.map(([x]) => x));
  const low = Math.min(...places.map(([, y]) => y)), high = Math.max(...places.map(([, y]) => y));
  const margin = 0.25 * (right - left);
  const scale = width / (right - left + 2 * margin);
  const height = (high - low + 2 * margin) * scale;
  const at = (x: number, y: number): string => `${((x - left + margin) * scale).toFixed(1)},${((high + margin - y) * scale).toFixed(1)}`;
  const cells = padeye.corners.map((corners, i) => ({ corners, plate: padeye.plate[i], stress: padeye.von_mises[i] }))
    .filter((cell) => cell.plate < 2).sort((a, b) => a.plate - b.plate)
    .map((cell) => svg("polygon", {
      points: [0, 1, 2, 3].map((i) => at(cell.corners[2 * i], cell.corners[2 * i + 1])).join(" "),
      fill: scaleCss(cell.stress / largest), stroke: "none",
    }, svg("title", {}, `${cell.plate === 0 ? "main plate" : "cheek plate"}: ${megapascals(cell.stress)} MPa`)));
  const [fx, fy] = padeye.force;
  const length = Math.hypot(fx, fy) || 1;
  const reach = 0.2 * (right - left) + Math.max(high, 0);
  const [startX, startY] = at(0, 0).split(","), [endX, endY] = at(fx / length * reach, fy / length * reach).split(",");
  const drawing = svg("svg", { viewBox: `0 0 ${width} ${height.toFixed(0)}`, role: "img", "aria-label": `stress of padeye ${padeye.lug}` },
    cells, svg("line", { x1: startX, y1: startY, x2: endX, y2: endY, stroke: "#1d2329", "stroke-width": 2 }),
    svg("circle", { cx: endX, cy: endY, r: 4, fill: "#1d2329" }));
  return h("figure", { class: "padeye" }, drawing,
    h("figcaption", {}, h("b", {}, padeye.lug), ` ${padeye.state}${known(padeye.time) ? ` at ${seconds(padeye.time)} s` : ""}, `
      + `${kilonewtons(Math.hypot(...padeye.force))} kN`, svgButton(`stress of padeye ${padeye.lug}`, () => drawing)));
}

function pictures(padeyes: PadeyePicture[]): Child {
  if (padeyes.length === 0) return null;
  const largest = Math.max(...padeyes.flatMap((padeye) => padeye.von_mises));
  const stops = [0, 0.25, 0.5, 0.75, 1].map((part) => `${scaleCss(part)} ${100 * part}%`).join(", ");
  return [h("div", { class: "padeyes" }, padeyes.map((padeye) => picture(padeye, largest))),
    h("div", { class: "padeye-scale" }, h("span", {}, "0"),
      h("span", { class: "padeye-colours", style: `background: linear-gradient(to right, ${stops})` }),
      h("span", {}, `${megapascals(largest)} MPa, von Mises of the mean stress over a plate's thickness; the line is the pin's pull`))];
}

/** Of all padeyes, the most stressed first, which is what the lug's plates and cheeks are checked for. */
function stateRows(padeyes: PadeyeSummary[]): Child[][] {
  const stress = (state: NonNullable<PadeyeSummary["states"]>[number]): number =>
    Math.max(state.main_plate_checked_von_mises_Pa ?? 0, state.cheeks_checked_von_mises_Pa ?? 0);
  return padeyes.flatMap((padeye) => (padeye.states ?? []).map((state) => ({ padeye, state })))
    .sort((a, b) => stress(b.state) - stress(a.state)).map(({ padeye, state }) => [padeye.lug, state.name, seconds(state.time_s),
    state.force_N ? kilonewtons(Math.hypot(...state.force_N)) : missing, state.force_N ? kilonewtons(state.force_N[2]) : missing,
    megapascals(state.main_plate_checked_von_mises_Pa), megapascals(state.cheeks_checked_von_mises_Pa),
    megapascals(state.peak_von_mises_Pa), scientific(state.force_residual)]);
}

/** Of all padeyes, what fails first, then by utilisation. */
function formulaRows(padeyes: PadeyeSummary[]): Child[][] {
  const all = padeyes.flatMap((padeye) => (padeye.formulas ?? []).map((formula) => ({ padeye, formula })));
  return all.sort((a, b) => Number(a.formula.pass) - Number(b.formula.pass)
    || (b.formula.utilisation ?? 0) - (a.formula.utilisation ?? 0)).map(({ padeye, formula }) => {
    const demand = inReportUnit(formula.demand, formula.unit ?? "1"), limit = inReportUnit(formula.limit, formula.unit ?? "1");
    return [padeye.lug, formula.name, demand.text, limit.text, limit.unit, seconds(formula.time_s), share(formula.utilisation),
      formula.pass ? "pass" : "fail", formula.source ?? missing];
  });
}

export function padeyesSection(data: PageData): Section | null {
  const padeyes = data.summary.structure?.padeyes ?? [];
  if (padeyes.length === 0) return null;
  const factor = padeyes[0].consequence_factor;
  const failed = padeyes.flatMap((padeye) => padeye.formulas ?? []).filter((formula) => formula.pass === false).length;
  const unknowns = Math.max(...padeyes.map((padeye) => padeye.unknowns ?? 0));
  return {
    id: "padeyes", title: "Padeyes", content: [
      h("p", { class: "lead" }, `Each padeye is cut from the block along its base and meshed finely (up to ${significant(unknowns, 3)} unknowns); `
        + "the block's displacement drives its base, the pin presses on half of its hole with the "
        + "cosine of the angle from the rope's direction."),
      pictures(data.padeyes ?? []),
      folded("Padeyes", "Stress of the fine mesh (without consequence factor)", [{ head: "Lug", align: "left" }, { head: "Instant", align: "left" },
        { head: "at, s" }, { head: "Force, kN" }, { head: "along the pin, kN" }, { head: "Main plate, checked, MPa" },
        { head: "Cheek plates, MPa" }, { head: "Raw peak, MPa" }, { head: "Force residual" }], stateRows(padeyes), 6),
      folded("Padeyes", `Hand formulae at their worst instants${known(factor) ? ` (forces times ${significant(factor, 2)})` : ""}`, [
        { head: "Lug", align: "left" }, { head: "Formula", align: "left" }, { head: "Demand" }, { head: "Limit" }, { head: "Unit", align: "left" },
        { head: "at, s" }, { head: "Utilisation" }, { head: "Result", align: "left" }, { head: "Source", align: "left" }],
      formulaRows(padeyes), Math.max(8, failed))],
  };
}
