// Stress pictures: static and dynamic side by side, one scale, one eye.
import * as three from "three";

import { scaleColour, scaleCss } from "./colours";
import { Field, known, PageData, State, states, Way } from "./data";
import { checkbox, choice, h, slider } from "./dom";
import type { Section } from "./section";
import { fixed, megapascals, millimetres, seconds, significant } from "./numbers";
import { StressPane, StressScale } from "./stress_pane";
import { BlockSurface } from "./surface";
import { canDraw, Viewer } from "./viewer";

type ScaleTop = "checked" | "peak" | "yield";
const wayNames: Record<Way, string> = { simultaneous: "simultaneous loads", per_rope_maxima: "per-rope maxima",
  history: "the whole lift" };

function colourTexture(): three.DataTexture {
  const count = 256;
  const bytes = new Uint8Array(4 * count);
  for (let i = 0; i < count; ++i) bytes.set([...scaleColour(i / (count - 1)).map((value) => Math.round(value * 255)), 255], 4 * i);
  const texture = new three.DataTexture(bytes, count, 1);
  texture.minFilter = texture.magFilter = three.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

/** Legend of the scale, in MPa. */
function legendBar(): { element: HTMLElement; show: (top: number, bands: boolean, cut: boolean) => void } {
  const bar = h("div", { class: "bar" });
  const ticks = h("div", { class: "ticks" });
  const note = h("p", { class: "hint" });
  const show = (top: number, bands: boolean, cut: boolean): void => {
    const steps = bands ? 10 : 48;
    const stops = Array.from({ length: steps }, (_, i) => {
      const colour = scaleCss(bands ? (i + 0.5) / steps : i / (steps - 1));
      return bands ? `${colour} ${i * 100 / steps}% ${(i + 1) * 100 / steps}%` : colour;
    });
    bar.style.background = `linear-gradient(to right, ${stops.join(", ")})`;
    ticks.replaceChildren(...[0, 0.2, 0.4, 0.6, 0.8, 1].map((share) =>
      h("span", { style: `left:${share * 100}%` }, fixed(top * share / 1e6, top < 1e7 ? 2 : top < 1e8 ? 1 : 0))));
    note.textContent = cut ? "Values beyond the scale keep its last colour." : "";
  };
  return { element: h("div", { class: "scale" }, h("span", { class: "title" }, "von Mises stress, MPa"), bar, ticks, note), show };
}

function niceDeformation(surface: BlockSurface, largest: number): number {
  return largest > 0 ? Number((0.03 * surface.size / largest).toPrecision(1)) : 1;
}

export function stressSection(data: PageData): Section | null {
  const surface = data.surface;
  if (!surface) return null;
  const note = surface.note && h("p", { class: "hint" }, surface.note);
  const fields = surface.fields ?? {};
  const ways = (["history", "simultaneous", "per_rope_maxima"] as const).filter((way) => fields[way]);
  if (!surface.points || ways.length === 0) return note ? { id: "stress", title: "Stress pictures", content: note } : null;
  if (!canDraw()) return { id: "stress", title: "Stress pictures", content: h("p", { class: "hint" },
    "This browser does not draw in three dimensions (WebGL). The figures are in the tables below, the fields in the .vtu files.") };
  return { id: "stress", title: "Stress pictures", content: [stressPictures(data, new BlockSurface(surface), ways), note] };
}

function stressPictures(data: PageData, surface: BlockSurface, ways: Way[]): HTMLElement[] {
  const fields = data.surface!.fields!;
  const structure = data.summary.structure;
  const shown = states.filter((state) => ways.some((way) => fields[way]![state]));
  const viewer = new Viewer(shown.length, 460, "Stress of the block, static left and dynamic right; drag or arrow keys turn both");
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
    legend.show(limit, scale.banded, (all.peak ?? 0) > limit * 1.001);
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
    unit = niceDeformation(surface, Math.max(...panes.map((pane) => pane.largestDisplacement)));
    setDeformation(Number(deform.value));
    rescale();
  };

  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => new three.Vector3(
    ...[0, 1, 2].map((k) => (i >> k & 1 ? surface.high[k] : surface.low[k])) as [number, number, number]));
  const eyes: Record<string, [number, number, number]> = {
    oblique: [-0.7, -1, 0.75], below: [-0.7, -1, -0.6], side: [0, -1, 0], end: [-1, 0, 0], top: [0, 0, 1] };
  const look = (name: string): void => { viewer.look(eyes[name], corners, 0.14); viewer.draw(); };

  choose(way);
  look("oblique");
  const value = probe(viewer, panes);
  const available = limits();
  const tops: [ScaleTop, string][] = [["checked", "checked stress"], ["peak", "raw peak"], ["yield", "yield"]];
  return [
    h("div", { class: "controls" },
      ways.length > 1 && choice("Loads", ways.map((one) => [one, wayNames[one]]), way, choose).element,
      choice("View", Object.keys(eyes).map((name) => [name, name]), "oblique", look).element,
      choice("Scale up to", tops.filter(([name]) => known(available[name])), "checked", (name) => { top = name; rescale(); }).element,
      checkbox("bands", false, (on) => { scale.setBanded(on); rescale(); }),
      checkbox("plate edges", true, (on) => { for (const pane of panes) pane.edges.visible = on; viewer.draw(); })),
    h("div", { class: "controls" },
      h("span", { class: "slider" }, deform, factor), cutControls(surface, scale, panes, viewer), groupControls(surface, panes, viewer)),
    h("figure", { class: "pair" }, h("div", { class: "captions" }, captions), viewer.element, value, pictureOnPaper(viewer)),
    legend.element,
  ];
}

/** The picture for paper: of a fixed shape, with its labels as part of it, taken when the page is about to be printed. */
function pictureOnPaper(viewer: Viewer): HTMLElement {
  const host = h("div", { class: "on-paper panes" });
  const take = (): void => host.replaceChildren(...viewer.picture(520, 400));
  window.addEventListener("beforeprint", take);
  window.matchMedia("print").addEventListener("change", (event) => { if (event.matches) take(); });
  return host;
}

/** A plane that cuts the block open. */
function cutControls(surface: BlockSurface, scale: StressScale, panes: StressPane[], viewer: Viewer): HTMLElement {
  let axis = -1;
  const place = slider("Where the block is cut open", 0, 1, 0.005, 0.5, () => cut());
  const text = h("output", {});
  place.disabled = true;
  const cut = (): void => {
    place.disabled = axis < 0;
    const at = axis < 0 ? 0 : surface.low[axis] + Number(place.value) * (surface.high[axis] - surface.low[axis]);
    scale.cut(axis, at);
    for (const pane of panes) pane.placeMarks();
    text.textContent = axis < 0 ? "" : `${"xyz"[axis]} = ${fixed(at, 2)} m`;
    viewer.draw();
  };
  const axes = choice("Cut across", [["-1", "none"], ["0", "x"], ["1", "y"], ["2", "z"]], "-1", (name) => { axis = Number(name); cut(); });
  return h("span", { class: "slider" }, axes.element, place, text);
}

/** Plates that can be taken away. */
function groupControls(surface: BlockSurface, panes: StressPane[], viewer: Viewer): HTMLElement | null {
  if (surface.groups.length < 2) return null;
  const hidden = new Set<number>();
  return h("details", { class: "groups" }, h("summary", {}, "plates"), h("div", {}, surface.groups.map((name, i) =>
    checkbox(name, true, (on) => {
      if (on) hidden.delete(i); else hidden.add(i);
      for (const pane of panes) pane.hide(hidden);
      viewer.draw();
    }))));
}

/** The stress under the pointer, read from a picture of one pixel whose colour is the value. */
function probe(viewer: Viewer, panes: StressPane[]): HTMLElement {
  const output = h("output", { class: "probe" });
  const target = new three.WebGLRenderTarget(1, 1);
  const pixel = new Uint8Array(4);
  let busy = false;
  const read = (event: PointerEvent): void => {
    busy = false;
    const { width, height, left, top } = viewer.element.getBoundingClientRect();
    const paneWidth = width / panes.length;
    const index = Math.min(Math.max(Math.floor((event.clientX - left) / paneWidth), 0), panes.length - 1);
    const camera = viewer.camera.clone();
    camera.setViewOffset(paneWidth, height, event.clientX - left - index * paneWidth, event.clientY - top, 1, 1);
    const { renderer } = viewer;
    const range = panes[index].largestStress;
    panes[index].probing(true, range);
    renderer.setRenderTarget(target);
    renderer.setViewport(0, 0, 1, 1);
    renderer.setScissor(0, 0, 1, 1);
    renderer.setClearColor(0x000000, 0);
    renderer.clear();
    renderer.render(viewer.panes[index].scene, camera);
    renderer.readRenderTargetPixels(target, 0, 0, 1, 1, pixel);
    renderer.setRenderTarget(null);
    panes[index].probing(false, range);
    viewer.draw();
    output.textContent = pixel[3] < 128 ? ""
      : `${panes[index].state} ${megapascals((pixel[0] * 256 + pixel[1]) / 65535 * range)} MPa here`;
  };
  viewer.renderer.domElement.addEventListener("pointermove", (event) => {
    if (busy || event.buttons !== 0) return;
    busy = true;
    requestAnimationFrame(() => read(event));
  });
  viewer.renderer.domElement.addEventListener("pointerleave", () => { output.textContent = ""; });
  return output;
}
