// Stress pictures: static and dynamic side by side, one scale, one eye.
import { beyondScale, colourTexture, cutControls, extentOf, groupControls, legendBar, niceDeformation, pictureOnPaper, probe, viewControls } from "./block_picture";
import { Field, known, PageData, State, states, Way } from "./data";
import { checkbox, choice, h, slider } from "./dom";
import type { Section } from "./section";
import { megapascals, millimetres, seconds, significant } from "./numbers";
import { StressPane, StressScale } from "./stress_pane";
import { BlockSurface } from "./surface";
import { canDraw, Viewer } from "./viewer";

type ScaleTop = "checked" | "peak" | "yield";
const wayNames: Record<Way, string> = { simultaneous: "simultaneous loads", per_rope_maxima: "per-rope maxima",
  history: "the whole lift" };

export function stressSection(data: PageData): Section | null {
  const surface = data.surface;
  if (!surface) return null;
  const note = surface.note && h("p", { class: "hint" }, surface.note);
  const fields = surface.fields ?? {};
  const ways = (["history", "simultaneous", "per_rope_maxima"] as const).filter((way) => fields[way]);
  if (!surface.points || ways.length === 0) return note ? { id: "stress", title: "Stress pictures", content: note } : null;
  if (!canDraw()) return { id: "stress", title: "Stress pictures", content: h("p", { class: "hint" },
    "This browser does not draw in three dimensions (WebGL). The figures are in the tables below, "
      + "the fields in the .vtu files.") };
  return { id: "stress", title: "Stress pictures", content: [stressPictures(data, new BlockSurface(surface), ways), note] };
}

function stressPictures(data: PageData, surface: BlockSurface, ways: Way[]): HTMLElement[] {
  const fields = data.surface!.fields!;
  const structure = data.summary.structure;
  const shown = states.filter((state) => ways.some((way) => fields[way]![state]));
  const viewer = new Viewer(shown.length, 460, "Stress of the block, static left and dynamic "
    + "right; drag or arrow keys turn both");
  const scale = new StressScale(colourTexture());
  const panes = shown.map((state, i) => new StressPane(surface, viewer, i, scale, state));
  const captions = shown.map((state) => h("figcaption", { class: state }));
  const legend = legendBar();
  let way = ways[0];
  let top: ScaleTop = "checked";

  const limits = (): Record<ScaleTop, number | null> => {
    const both = states.map((state) => structure?.[way]?.[state]);
    const largest = (values: unknown[]): number | null => {
      const found = values.filter(known).filter((value) => value > 0);
      return found.length ? Math.max(...found) : null;
    };
    return {
      checked: largest(both.map((one) => one?.checked_von_mises_Pa)), peak: Math.max(...panes.map((pane) => pane.largestStress)),
      yield: known(structure?.yield_Pa) ? structure!.yield_Pa! : null,
    };
  };
  const rescale = (): void => {
    const all = limits();
    const limit = all[top] ?? all.peak ?? 1;
    scale.setTop(limit);
    legend.show("von Mises stress, MPa", 0, limit / 1e6, scale.banded, (all.peak ?? 0) > limit * 1.001 ? beyondScale : "");
    viewer.draw();
  };
  const caption = (state: State, field: Field | undefined, pane: StressPane): (Node | string)[] => {
    const figures = structure?.[way]?.[state];
    const worst = `${figures?.rope ? `, most of it from rope ${figures.rope}` : ""}${known(figures?.time_s) ? ` at ${seconds(figures!.time_s)} s` : ""}`;
    const instant = way === "history" ? `largest of the whole lift at each point; the checked stress${worst}; shape${known(field?.time) ? ` at ${seconds(field!.time)} s` : ""}`
      : field?.rope ? `largest load in ${field.rope}${known(field.time) ? ` at ${seconds(field.time)} s` : ""}` : wayNames[way];
    const checked = known(figures?.checked_von_mises_Pa) ? `checked ${megapascals(figures!.checked_von_mises_Pa)} MPa, ` : "";
    return [h("b", {}, state.charAt(0).toUpperCase() + state.slice(1)), `  ${instant}`, h("br"),
      `${checked}raw peak ${megapascals(figures?.peak_von_mises_Pa ?? pane.largestStress)} MPa, `
      + `deformation ${millimetres(figures?.max_displacement_m ?? pane.largestDisplacement)} mm`];
  };
  const factor = h("output", {});
  const deform = slider("Deformation drawn larger by", 0, 2, 0.05, 1, (value) => setDeformation(value));
  let unit = 1;
  const setDeformation = (value: number): void => {
    scale.deformation.value = unit * value;
    for (const pane of panes) pane.placeMarks();
    factor.textContent = value === 0 ? "not deformed" : `deformation × ${significant(unit * value, 2)}`;
    viewer.draw();
  };
  const choose = (value: Way): void => {
    way = value;
    panes.forEach((pane, i) => {
      const field = fields[way]![shown[i]];
      pane.setField(field, structure?.[way]?.[shown[i]]);
      captions[i].replaceChildren(...caption(shown[i], field, pane));
    });
    unit = niceDeformation(surface.size, Math.max(...panes.map((pane) => pane.largestDisplacement)));
    setDeformation(Number(deform.value));
    rescale();
  };

  const extent = extentOf([surface]);
  choose(way);
  const view = viewControls(viewer, extent);
  const value = probe(viewer, panes, (pane, stress) => `${pane.name} ${megapascals(stress)} MPa here`);
  const available = limits();
  const tops: [ScaleTop, string][] = [["checked", "checked stress"], ["peak", "raw peak"], ["yield", "yield"]];
  return [
    h("div", { class: "controls" },
      ways.length > 1 && choice("Loads", ways.map((one) => [one, wayNames[one]]), way, choose).element,
      view,
      choice("Scale up to", tops.filter(([name]) => known(available[name])), "checked", (name) => { top = name; rescale(); }).element,
      checkbox("bands", false, (on) => { scale.setBanded(on); rescale(); }),
      checkbox("plate edges", true, (on) => { for (const pane of panes) pane.edges.visible = on; viewer.draw(); })),
    h("div", { class: "controls" },
      h("span", { class: "slider" }, deform, factor), cutControls(extent, scale, panes, viewer), groupControls(panes, viewer)),
    h("figure", { class: "pair" }, h("div", { class: "captions" }, captions), viewer.element, value, pictureOnPaper(viewer)),
    legend.element,
  ];
}
