// What drawings of the block have in common: colours and their legend, view, cut, plates, the value under the pointer,
// pictures for paper.
import * as three from "three";

import { ColourScale, scaleColour, scaleCss } from "./colours";
import { choice, checkbox, h, slider } from "./dom";
import { fixed } from "./numbers";
import { StressPane, StressScale } from "./stress_pane";
import { BlockSurface } from "./surface";
import { Viewer } from "./viewer";

export function colourTexture(colour: ColourScale = scaleColour): three.DataTexture {
  const count = 256;
  const bytes = new Uint8Array(4 * count);
  for (let i = 0; i < count; ++i) bytes.set([...colour(i / (count - 1)).map((value) => Math.round(value * 255)), 255], 4 * i);
  const texture = new three.DataTexture(bytes, count, 1);
  texture.minFilter = texture.magFilter = three.LinearFilter;
  texture.needsUpdate = true;
  return texture;
}

export interface Legend {
  element: HTMLElement;
  /** From `bottom` to `top`, in the unit that is shown. */
  show: (title: string, bottom: number, top: number, bands: boolean, note: string) => void;
}

export const beyondScale = "Values beyond the scale keep its last colour.";

export function legendBar(colour: ColourScale = scaleColour): Legend {
  const name = h("span", { class: "title" });
  const bar = h("div", { class: "bar" });
  const ticks = h("div", { class: "ticks" });
  const hint = h("p", { class: "hint" });
  const show = (title: string, bottom: number, top: number, bands: boolean, note: string): void => {
    const steps = bands ? 10 : 48;
    const stops = Array.from({ length: steps }, (_, i) => {
      const css = scaleCss(bands ? (i + 0.5) / steps : i / (steps - 1), colour);
      return bands ? `${css} ${i * 100 / steps}% ${(i + 1) * 100 / steps}%` : css;
    });
    bar.style.background = `linear-gradient(to right, ${stops.join(", ")})`;
    const decimals = top < 0.1 ? 4 : top < 1 ? 3 : top < 10 ? 2 : top < 100 ? 1 : 0;
    ticks.replaceChildren(...(bottom < 0 ? [0, 0.25, 0.5, 0.75, 1] : [0, 0.2, 0.4, 0.6, 0.8, 1]).map((share) => {
      const value = bottom + (top - bottom) * share;
      return h("span", { style: `left:${share * 100}%` }, (bottom < 0 && value > 0 ? "+" : "") + fixed(value, decimals));
    }));
    name.textContent = title;
    hint.textContent = note;
  };
  return { element: h("div", { class: "scale" }, name, bar, ticks, hint), show };
}

/** How much larger than it is a deformation is drawn. */
export function niceDeformation(size: number, largest: number): number {
  return largest > 0 ? Number((0.03 * size / largest).toPrecision(1)) : 1;
}

/** The box about what is drawn, m. */
export interface Extent { low: [number, number, number]; high: [number, number, number] }

export function extentOf(surfaces: BlockSurface[]): Extent {
  const over = (pick: (...values: number[]) => number, end: "low" | "high"): [number, number, number] =>
    [0, 1, 2].map((k) => pick(...surfaces.map((surface) => surface[end][k]))) as [number, number, number];
  return { low: over(Math.min, "low"), high: over(Math.max, "high") };
}

/** Buttons for the side from which the block is seen; the first is looked from at once. */
export function viewControls(viewer: Viewer, { low, high }: Extent): HTMLElement {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => new three.Vector3(
    ...[0, 1, 2].map((k) => (i >> k & 1 ? high[k] : low[k])) as [number, number, number]));
  const eyes: Record<string, [number, number, number]> = {
    oblique: [-0.7, -1, 0.75], below: [-0.7, -1, -0.6], side: [0, -1, 0], end: [-1, 0, 0], top: [0, 0, 1] };
  const look = (name: string): void => { viewer.look(eyes[name], corners, 0.14); viewer.draw(); };
  look("oblique");
  return choice("View", Object.keys(eyes).map((name) => [name, name]), "oblique", look).element;
}

/** A plane that cuts the block open. */
export function cutControls({ low, high }: Extent, scale: StressScale, panes: StressPane[], viewer: Viewer): HTMLElement {
  let axis = -1;
  const place = slider("Where the block is cut open", 0, 1, 0.005, 0.5, () => cut());
  const text = h("output", {});
  place.disabled = true;
  const cut = (): void => {
    place.disabled = axis < 0;
    const at = axis < 0 ? 0 : low[axis] + Number(place.value) * (high[axis] - low[axis]);
    scale.cut(axis, at);
    for (const pane of panes) pane.placeMarks();
    text.textContent = axis < 0 ? "" : `${"xyz"[axis]} = ${fixed(at, 2)} m`;
    viewer.draw();
  };
  const axes = choice("Cut across", [["-1", "none"], ["0", "x"], ["1", "y"], ["2", "z"]], "-1", (name) => { axis = Number(name); cut(); });
  return h("span", { class: "slider" }, axes.element, place, text);
}

/** Plates that can be taken away, by their names in all panes. */
export function groupControls(panes: StressPane[], viewer: Viewer): HTMLElement | null {
  const names = [...new Set(panes.flatMap((pane) => pane.surface.groups))];
  if (names.length < 2) return null;
  const hidden = new Set<string>();
  return h("details", { class: "groups" }, h("summary", {}, "plates"), h("div", {}, names.map((name) =>
    checkbox(name, true, (on) => {
      if (on) hidden.delete(name); else hidden.add(name);
      for (const pane of panes)
        pane.hide(new Set(pane.surface.groups.flatMap((group, i) => hidden.has(group) ? [i] : [])));
      viewer.draw();
    }))));
}

/** The value under the pointer, read from a picture of one pixel whose colour is the value. */
export function probe(viewer: Viewer, panes: StressPane[], text: (pane: StressPane, value: number) => string): HTMLElement {
  const output = h("output", { class: "probe" });
  const target = new three.WebGLRenderTarget(1, 1);
  const pixel = new Uint8Array(4);
  let busy = false;
  const read = (event: PointerEvent): void => {
    busy = false;
    const place = viewer.paneAt(event);
    if (!place) { output.textContent = ""; return; }
    const pane = panes[place.index];
    const camera = viewer.camera.clone();
    camera.setViewOffset(place.width, place.height, place.x, place.y, 1, 1);
    const { renderer } = viewer;
    const [bottom, top] = pane.probing(true);
    renderer.setRenderTarget(target);
    renderer.setViewport(0, 0, 1, 1);
    renderer.setScissor(0, 0, 1, 1);
    renderer.setClearColor(0x000000, 0);
    renderer.clear();
    renderer.render(viewer.panes[place.index].scene, camera);
    renderer.readRenderTargetPixels(target, 0, 0, 1, 1, pixel);
    renderer.setRenderTarget(null);
    pane.probing(false);
    viewer.draw();
    output.textContent = pixel[3] < 128 ? "" : text(pane, bottom + (pixel[0] * 256 + pixel[1]) / 65535 * (top - bottom));
  };
  viewer.renderer.domElement.addEventListener("pointermove", (event) => {
    if (busy || event.buttons !== 0) return;
    busy = true;
    requestAnimationFrame(() => read(event));
  });
  viewer.renderer.domElement.addEventListener("pointerleave", () => { output.textContent = ""; });
  return output;
}

/** The picture for paper: of a fixed shape, with its labels as part of it, taken when the page is about to be printed. */
export function pictureOnPaper(viewer: Viewer, caption: (pane: number) => Node | null = () => null): HTMLElement {
  const host = h("div", { class: `on-paper panes${viewer.panes.length > 3 ? " many" : ""}` });
  const take = (): void => host.replaceChildren(...viewer.picture(520, 400).map((picture, i) => {
    const words = caption(i);
    return words ? h("div", {}, words, picture) : picture;
  }));
  window.addEventListener("beforeprint", take);
  window.matchMedia("print").addEventListener("change", (event) => { if (event.matches) take(); });
  return host;
}
