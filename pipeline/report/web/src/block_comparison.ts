// The blocks of several results beside each other, and what each has more or less than the first. The data's twin is
// blocks_json of pipeline/comparison/compared_blocks.h.
import { beyondScale, colourTexture, cutControls, extentOf, groupControls, legendBar, niceDeformation, pictureOnPaper, probe, viewControls } from "./block_picture";
import { differenceColour, scaleColour } from "./colours";
import { Field, known, Packed, State, states, StructureState, Surface, unpack, Way } from "./data";
import { append, checkbox, choice, h, slider } from "./dom";
import { megapascals, millimetres, seconds, significant } from "./numbers";
import { StressPane, StressScale } from "./stress_pane";
import { BlockSurface } from "./surface";
import { canDraw, Viewer } from "./viewer";

interface ComparedField { field: Field; figures: StructureState }
interface Difference { von_mises: Packed; displacement: Packed }
interface ComparedBlock {
  name: string; surface?: Surface; surface_of?: number;
  fields: Partial<Record<State, ComparedField>>;
  differences: Partial<Record<State, Difference>>;
}
export interface ComparedBlocks { way: Way; blocks: ComparedBlock[] }

type Quantity = "von_mises" | "displacement";
type ScaleTop = "checked" | "peak";
type DifferenceTop = "most" | "largest";

/** How a quantity is said: its name, its unit, and how many of it one SI unit is. */
const quantities: Record<Quantity, { name: string; unit: string; factor: number; text: (value: unknown) => string }> = {
  von_mises: { name: "von Mises stress", unit: "MPa", factor: 1e-6, text: megapascals },
  displacement: { name: "deformation", unit: "mm", factor: 1e3, text: millimetres },
};
const stateNames: Record<State, string> = { dynamic: "in motion", static: "at rest" };
/** Differences below this share of the values themselves are rounding. */
const rounding = 1e-6;

function magnitudes(vectors: Float32Array): Float32Array {
  return Float32Array.from({ length: vectors.length / 3 }, (_, i) => Math.hypot(vectors[3 * i], vectors[3 * i + 1], vectors[3 * i + 2]));
}

/** The magnitude that all but one in a hundred of the known values stay below. */
function mostOf(lists: Float32Array[]): number {
  const sizes = Float32Array.from(lists.flatMap((list) => [...list].filter((value) => !Number.isNaN(value)).map(Math.abs))).sort();
  return sizes.length > 0 ? sizes[Math.min(Math.floor(0.99 * sizes.length), sizes.length - 1)] : 0;
}

/** One drawing: a block, or what it has more or less than the first. */
interface Drawing { block: ComparedBlock; surface: BlockSurface; isDifference: boolean }

function drawingsOf(blocks: ComparedBlock[]): Drawing[] {
  const surfaces: BlockSurface[] = [];
  for (const block of blocks) surfaces.push(block.surface ? new BlockSurface(block.surface) : surfaces[block.surface_of!]);
  const drawings = blocks.map((block, i) => ({ block, surface: surfaces[i], isDifference: false }));
  return [...drawings, ...drawings.slice(1).map((drawing) => ({ ...drawing, isDifference: true }))];
}

/** Puts the drawings before what the page says of the blocks without scripts. */
export function showBlocks(data: ComparedBlocks, host: HTMLElement): void {
  if (!canDraw()) {
    host.prepend(h("p", { class: "hint" }, "This browser does not draw in three dimensions "
      + "(WebGL); the table has the largest stresses."));
    return;
  }
  const pictures = h("div", {});
  host.prepend(pictures);
  append(pictures, new BlockPictures(data).elements());
}

class BlockPictures {
  private readonly drawings: Drawing[];
  private readonly viewer: Viewer;
  private readonly scale = new StressScale(colourTexture(scaleColour));
  private readonly differenceScale = new StressScale(colourTexture(differenceColour), this.scale);
  private readonly panes: StressPane[];
  private readonly captions: HTMLElement[];
  private readonly legend = legendBar(scaleColour);
  private readonly differenceLegend = legendBar(differenceColour);
  private readonly factor = h("output", {});
  private readonly deform = slider("Deformation drawn larger by", 0, 2, 0.05, 1, () => this.setDeformation());
  private unit = 1;
  private most = 0;  // of the differences that are drawn
  private state: State;
  private quantity: Quantity = "von_mises";
  private top: ScaleTop = "checked";
  private differenceTop: DifferenceTop = "most";

  constructor(private readonly data: ComparedBlocks) {
    this.drawings = drawingsOf(data.blocks);
    this.state = data.blocks.some((block) => block.fields.dynamic) ? "dynamic" : "static";
    const names = data.blocks.map((block) => block.name).join(", ");
    this.viewer = new Viewer(this.drawings.length, 360, `Stress of the block: ${names}, and differences from ${data.blocks[0].name}; drag or arrow keys turn all`,
      (width) => Math.floor(width / 320));
    this.panes = this.drawings.map(({ block, surface, isDifference }, i) =>
      new StressPane(surface, this.viewer, i, isDifference ? this.differenceScale : this.scale, this.nameOf(block, isDifference)));
    this.captions = this.drawings.map((_, i) => this.viewer.addFrame(i).appendChild(h("div", { class: "words" })));
  }

  private get reference(): ComparedBlock { return this.data.blocks[0]; }

  private nameOf(block: ComparedBlock, isDifference: boolean): string {
    return isDifference ? `${block.name} \u2212 ${this.reference.name}` : block.name;
  }

  elements(): HTMLElement[] {
    const { viewer, panes, scale } = this;
    const extent = extentOf(this.drawings.map((drawing) => drawing.surface));
    const shown = [...states].reverse().filter((state) => this.data.blocks.some((block) => block.fields[state]));
    const view = viewControls(viewer, extent);
    const tops = choice<ScaleTop>("Scale up to", [["checked", "checked stress"], ["peak", "raw peak"]], this.top, (top) => { this.top = top; this.rescale(); }).element;
    this.fill();
    const bands = (on: boolean): void => { for (const one of [scale, this.differenceScale]) one.setBanded(on); this.rescale(); };
    return [
      h("div", { class: "controls" },
        choice<Quantity>("Colours", [["von_mises", "stress"], ["displacement", "deformation"]], this.quantity,
          (quantity) => { this.quantity = quantity; tops.hidden = quantity !== "von_mises"; this.fill(); }).element,
        shown.length > 1 && choice<State>("Loads", shown.map((state) => [state, stateNames[state]]), this.state, (state) => { this.state = state; this.fill(); }).element,
        view, tops,
        choice<DifferenceTop>("Difference up to", [["most", "99 of 100 points"], ["largest", "its largest"]], this.differenceTop,
          (top) => { this.differenceTop = top; this.rescale(); }).element,
        checkbox("bands", false, bands),
        checkbox("plate edges", true, (on) => { for (const pane of panes) pane.edges.visible = on; viewer.draw(); })),
      h("div", { class: "controls" },
        h("span", { class: "slider" }, this.deform, this.factor), cutControls(extent, scale, panes, viewer), groupControls(panes, viewer)),
      h("figure", { class: "pair" }, viewer.element,
        probe(viewer, panes, (pane, value) => `${pane.name}: ${this.said(value, panes.indexOf(pane))} here`),
        pictureOnPaper(viewer, (pane) => this.captions[pane].cloneNode(true))),
      h("div", { class: "scales" }, this.legend.element, this.differenceLegend.element),
      h("p", { class: "source" }, this.note()),
    ];
  }

  /** What the colours mean, in words. */
  private note(): string {
    const whole: Record<Way, string> = {
      history: "Stress is the largest of the whole lift at each point, which may come at another "
        + "instant in each result; deformation is that of the instant of the largest checked "
        + "stress.",
      simultaneous: "Stress and deformation are those of the worst of the instants of each rope's "
        + "largest load.",
      per_rope_maxima: "Stress and deformation are those of each rope's largest load, all at once.",
    };
    return `${whole[this.data.way]} Differences count from ${this.reference.name}: red is more, blue is less, grey has no counterpart there.`;
  }

  /** A value with its unit; of differences with its sign. */
  private said(value: number, pane: number): string {
    const { text, unit } = quantities[this.quantity];
    return `${this.drawings[pane].isDifference && value > 0 ? "+" : ""}${text(value)} ${unit}`;
  }

  /** Takes values and shapes of the chosen state and quantity. */
  private fill(): void {
    const lists: Float32Array[] = [];
    this.drawings.forEach(({ block, surface, isDifference }, i) => {
      const { field, figures } = block.fields[this.state] ?? {};
      const count = surface.points.length / 3;
      const moves = field ? unpack(field.displacement) : new Float32Array(3 * count);
      let values: Float32Array = new Float32Array(count);
      let place: number[] | undefined;
      if (isDifference) {
        const difference = block.differences[this.state];
        values = difference ? unpack(difference[this.quantity]) : values.fill(NaN);
        lists.push(values);
      } else if (field && this.quantity === "von_mises") {
        values = unpack(field.von_mises);
        place = field.checked_stress_point ?? figures?.checked_point_m;
      } else if (field) {
        values = magnitudes(moves);
      }
      const checked = place && known(figures?.checked_von_mises_Pa) ? figures!.checked_von_mises_Pa! : null;
      this.panes[i].setValues(values, moves, (extreme) => this.said(checked ?? extreme, i), checked === null ? undefined : place);
      this.panes[i].showMark(!isDifference || !this.isAlike(i));
    });
    this.most = mostOf(lists);
    this.unit = niceDeformation(this.drawings[0].surface.size, Math.max(...this.panes.map((pane) => pane.largestDisplacement)));
    this.setDeformation();
    this.rescale();
    this.captions.forEach((caption, i) => caption.replaceChildren(...this.caption(i)));
  }

  private caption(i: number): (Node | string)[] {
    const { block, isDifference } = this.drawings[i];
    const pane = this.panes[i];
    const { field, figures } = block.fields[this.state] ?? {};
    const title = h("b", {}, `${this.nameOf(block, isDifference)}, ${stateNames[this.state]}`);
    if (!field || (isDifference && !block.differences[this.state])) return [title, h("br"), "has no such stresses"];
    if (isDifference) {
      return [title, h("br"), this.isAlike(i) ? "no difference" : `from ${this.said(pane.smallestStress, i)} to ${this.said(pane.largestStress, i)}`];
    }
    const shape = known(field.time) ? ` at ${seconds(field.time)} s` : "";
    if (this.quantity === "displacement") return [title, h("br"), `largest ${this.said(pane.largestStress, i)}${shape}`];
    const checked = known(figures?.checked_von_mises_Pa) ? `checked ${megapascals(figures!.checked_von_mises_Pa)} MPa${shape}, ` : "";
    return [title, h("br"), `${checked}raw peak ${this.said(pane.largestStress, i)}`];
  }

  /** The largest of a scale for the blocks: of both states, so that they can be held against each other. */
  private limit(): number {
    if (this.quantity === "von_mises" && this.top === "checked") {
      const checked = this.data.blocks.flatMap((block) => states.map((state) => block.fields[state]?.figures.checked_von_mises_Pa)).filter(known);
      if (checked.length > 0) return Math.max(...checked);
    }
    return this.largestDrawn();
  }

  private largestDrawn(): number {
    return Math.max(...this.panes.filter((_, i) => !this.drawings[i].isDifference).map((pane) => pane.largestStress), 1e-30);
  }

  private get differencePanes(): number[] {
    return this.drawings.flatMap((drawing, i) => drawing.isDifference ? [i] : []);
  }

  private largestDifference(pane: number): number {
    return Math.max(this.panes[pane].largestStress, -this.panes[pane].smallestStress);
  }

  /** Whether a drawing of a difference has none but rounding. */
  private isAlike(pane: number): boolean { return this.largestDifference(pane) <= rounding * this.largestDrawn(); }

  private rescale(): void {
    const { name, unit, factor } = quantities[this.quantity];
    const limit = this.limit();
    this.scale.setTop(limit);
    this.legend.show(`${name}, ${unit}`, 0, limit * factor, this.scale.banded, this.largestDrawn() > limit * 1.001 ? beyondScale : "");
    const panes = this.differencePanes;
    const alike = panes.every((pane) => this.isAlike(pane));
    const all = Math.max(...panes.map((pane) => this.largestDifference(pane)));
    const largest = alike ? limit : this.differenceTop === "most" && this.most > 0 ? this.most : all;
    this.differenceScale.setTop(largest, true);
    this.differenceLegend.show(`difference of ${name}, ${unit}`, -largest * factor, largest * factor, this.scale.banded,
      alike ? "There is no difference." : all > largest * 1.001 ? beyondScale : "");
    this.viewer.draw();
  }

  private setDeformation(): void {
    const share = Number(this.deform.value);
    this.scale.deformation.value = this.unit * share;
    for (const pane of this.panes) pane.placeMarks();
    this.factor.textContent = share === 0 ? "not deformed" : `deformation × ${significant(this.unit * share, 2)}`;
    this.viewer.draw();
  }
}
