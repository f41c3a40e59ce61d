// What the three-dimensional pictures share: renderer, camera, orbit, labels, drawing on demand.
import * as three from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

import { h, svg } from "./dom";
import { Box, placeLabels } from "./labels";

export const background = 0xfafbfc;

/** Whether the browser can draw with WebGL 2; asked once. */
export const canDraw: () => boolean = (() => {
  let answer: boolean | undefined;
  return () => {
    if (answer === undefined) {
      const context = document.createElement("canvas").getContext("webgl2");
      answer = context !== null;
      context?.getExtension("WEBGL_lose_context")?.loseContext();
    }
    return answer;
  };
})();

export interface Pane {
  scene: three.Scene;
  labels: { point: three.Vector3; element: HTMLElement }[];
  frame?: HTMLElement;  // over the pane's place, for a caption
}

/** Panes in rows and columns, in pixels. */
interface Grid { columns: number; rows: number; width: number; height: number }

/** How far labels move from where style puts them beside their points, so that none lies on another; those of maxima stay. */
function labelShifts(elements: HTMLElement[], points: [number, number][], within: Box): [number, number][] {
  const shifts = elements.map((element): [number, number][] => {
    const { offsetWidth: width, offsetHeight: height, offsetLeft: beside } = element;
    if (element.classList.contains("maximum")) return [[element.classList.contains("leftwards") ? -width : 0, 0]];
    return [0, -1, 1, -2, 2].flatMap((rows) => [0, -width - 2 * beside].map((across): [number, number] => [across, rows * height]));
  });
  const boxes = elements.map(({ offsetLeft, offsetTop, offsetWidth, offsetHeight }, i) => shifts[i].map(([across, down]): Box => {
    const [left, top] = [points[i][0] + offsetLeft + across, points[i][1] + offsetTop + down];
    return { left, right: left + offsetWidth, top, bottom: top + offsetHeight };
  }));
  return placeLabels(boxes, within).map((chosen, i) => elements[i].classList.contains("maximum") ? [0, 0] : shifts[i][chosen]);
}

/** A canvas with one or more panes side by side, or in several rows, that share camera and orbit. */
export class Viewer {
  readonly element: HTMLElement;
  readonly camera = new three.OrthographicCamera(-1, 1, 1, -1, -1000, 1000);
  readonly renderer: three.WebGLRenderer;
  readonly controls: OrbitControls;
  readonly panes: Pane[];
  readonly overlay = h("div", { class: "overlay" });
  private height = 10;  // of what must fit into the view at zoom 1, m
  private wide = 10;
  private waiting = false;

  /**
   * @param pixelHeight of a row of panes
   * @param columnsAt how many panes stand side by side in a width; all of them if it is not given
   */
  constructor(paneCount: number, private pixelHeight: number, label: string, private columnsAt: (width: number) => number = () => paneCount) {
    this.renderer = new three.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setScissorTest(true);
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", label);
    this.element = h("div", { class: "viewer", style: `height:${pixelHeight}px` }, canvas, this.overlay);
    this.panes = Array.from({ length: paneCount }, () => ({ scene: new three.Scene(), labels: [] }));
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.zoomToCursor = paneCount === 1;
    this.controls.addEventListener("change", () => this.draw());
    // The wheel, and a finger, move the page until the drawing is chosen by a click, a touch or the keyboard.
    this.controls.enableZoom = false;
    canvas.style.touchAction = "pan-y";
    canvas.addEventListener("pointerdown", () => canvas.focus({ preventScroll: true }));
    canvas.addEventListener("focus", () => { this.controls.enableZoom = true; canvas.style.touchAction = "none"; });
    canvas.addEventListener("blur", () => { this.controls.enableZoom = false; canvas.style.touchAction = "pan-y"; });
    canvas.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.resize()).observe(this.element);
  }

  addLabel(pane: number, text: string, className = ""): Pane["labels"][number] {
    const label = { point: new three.Vector3(), element: h("span", { class: `label ${className}` }, text) };
    this.overlay.appendChild(label.element);
    this.panes[pane].labels.push(label);
    return label;
  }

  /** An element that lies over a pane, whatever the window's size. */
  addFrame(pane: number): HTMLElement {
    const frame = h("div", { class: "frame" });
    this.overlay.appendChild(frame);
    return this.panes[pane].frame = frame;
  }

  /** The pane under the pointer, and the pointer's place in it in pixels; none beside all of them. */
  paneAt(event: PointerEvent): { index: number; x: number; y: number; width: number; height: number } | null {
    const { left, top } = this.element.getBoundingClientRect();
    const { columns, rows, width, height } = this.grid();
    const [x, y] = [event.clientX - left - this.element.clientLeft, event.clientY - top - this.element.clientTop];
    const [column, row] = [Math.min(Math.max(Math.floor(x / width), 0), columns - 1), Math.min(Math.max(Math.floor(y / height), 0), rows - 1)];
    const index = row * columns + column;
    return index < this.panes.length ? { index, x: x - column * width, y: y - row * height, width, height } : null;
  }

  /** Looks from `direction` (from what is seen towards the eye) so that all the points just fit into the view. */
  look(direction: [number, number, number], points: three.Vector3[], margin = 0.08): void {
    const forward = new three.Vector3(...direction).normalize();
    const right = new three.Vector3(0, 0, 1).cross(forward);
    if (right.length() < 1e-6) right.set(1, 0, 0);
    const up = forward.clone().cross(right.normalize());
    const axes = [right, up, forward];
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const point of points) axes.forEach((axis, k) => {
      low[k] = Math.min(low[k], point.dot(axis));
      high[k] = Math.max(high[k], point.dot(axis));
    });
    const target = new three.Vector3();
    axes.forEach((axis, k) => target.addScaledVector(axis, (low[k] + high[k]) / 2));
    this.wide = (high[0] - low[0]) * (1 + margin);
    this.height = (high[1] - low[1]) * (1 + margin);
    const distance = 2 * Math.max(this.height, this.wide, high[2] - low[2], 1);
    this.camera.near = -distance;
    this.camera.far = 4 * distance;
    const eye = new three.Vector3(...direction).normalize().multiplyScalar(distance);
    // Straight down the up vector the orbit has no azimuth: lean by a hair.
    if (Math.hypot(eye.x, eye.y) < 1e-6 * distance) eye.y = -1e-3 * distance;
    this.camera.position.copy(target).add(eye);
    this.controls.target.copy(target);
    this.camera.zoom = 1;
    this.resize();
    this.controls.update();
  }

  /** Moves the eye along with the target. */
  follow(target: three.Vector3): void {
    const step = target.clone().sub(this.controls.target);
    this.camera.position.add(step);
    this.controls.target.copy(target);
    this.controls.update();
    this.draw();
  }

  private key(event: KeyboardEvent): void {
    const turn = Math.PI / 24;
    const offset = this.camera.position.clone().sub(this.controls.target);
    const sphere = new three.Spherical().setFromVector3(new three.Vector3(offset.x, offset.z, -offset.y));
    const moves: Record<string, () => void> = {
      ArrowLeft: () => { sphere.theta -= turn; }, ArrowRight: () => { sphere.theta += turn; },
      ArrowUp: () => { sphere.phi -= turn; }, ArrowDown: () => { sphere.phi += turn; },
      "+": () => { this.camera.zoom *= 1.15; }, "=": () => { this.camera.zoom *= 1.15; }, "-": () => { this.camera.zoom /= 1.15; },
    };
    if (!moves[event.key]) return;
    moves[event.key]();
    event.preventDefault();
    const moved = new three.Vector3().setFromSpherical(sphere.makeSafe());
    this.camera.position.copy(this.controls.target).add(new three.Vector3(moved.x, -moved.z, moved.y));
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  private grid(): Grid {
    const { clientWidth, clientHeight } = this.element;
    const columns = Math.min(Math.max(this.columnsAt(clientWidth), 1), this.panes.length);
    const rows = Math.ceil(this.panes.length / columns);
    return { columns, rows, width: clientWidth / columns, height: clientHeight / rows };
  }

  private resize(): void {
    if (this.element.clientWidth === 0 || this.element.clientHeight === 0) return;
    this.element.style.height = `${this.grid().rows * this.pixelHeight}px`;
    const { clientWidth: width, clientHeight: height } = this.element;
    const grid = this.grid();
    this.renderer.setSize(width, height, false);
    this.fit(grid.width, grid.height);
    this.draw();
  }

  /** Lets everything fit into a pane of this size. */
  private fit(width: number, height: number): void {
    const aspect = width / height;
    const tall = Math.max(this.height, this.wide / aspect);
    this.camera.top = tall / 2;
    this.camera.bottom = -tall / 2;
    this.camera.right = (tall / 2) * aspect;
    this.camera.left = -this.camera.right;
    this.camera.updateProjectionMatrix();
  }

  /** Each pane as a picture of `width` by `height`, its labels drawn in, whatever the size on the screen. */
  picture(width: number, height: number): HTMLElement[] {
    this.renderer.setPixelRatio(2);
    this.renderer.setSize(width * this.panes.length, height, false);
    this.fit(width, height);
    this.render({ columns: this.panes.length, rows: 1, width, height });
    const pictures = this.panes.map(({ labels }, i) => {
      const copy = h("canvas", { width: 2 * width, height: 2 * height }) as HTMLCanvasElement;
      copy.getContext("2d")!.drawImage(this.renderer.domElement, 2 * i * width, 0, 2 * width, 2 * height, 0, 0, 2 * width, 2 * height);
      const texts = labels.filter(({ point, element }) => element.style.display !== "none" && element.textContent && this.place(point).inside)
        .flatMap(({ point, element }) => {
          const { x, y } = this.place(point);
          const [left, top] = [x * width, y * height];
          const end = x > 0.75 ? "end" : "start";
          return [svg("circle", { cx: left, cy: top, r: 3, fill: "#111111" }),
            svg("text", { x: left + (end === "end" ? -7 : 7), y: top - 7, "font-size": 15, "font-weight": 600, "text-anchor": end, fill: "#111111", stroke: "#ffffff",
              "stroke-width": 4, "paint-order": "stroke" }, element.textContent)];
        });
      return h("div", { class: "pane" }, copy, svg("svg", { viewBox: `0 0 ${width} ${height}`, "aria-hidden": "true" }, texts));
    });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.resize();
    return pictures;
  }

  /** Where a point stands in a pane, from 0 to 1 rightwards and downwards. */
  private place(point: three.Vector3): { x: number; y: number; inside: boolean } {
    const place = point.clone().project(this.camera);
    return { x: (place.x + 1) / 2, y: (1 - place.y) / 2, inside: Math.abs(place.x) <= 1 && Math.abs(place.y) <= 1 };
  }

  private render({ columns, rows, width, height }: Grid): void {
    this.camera.updateMatrixWorld();
    this.renderer.setClearColor(background);
    if (this.panes.length < columns * rows) {
      this.renderer.setScissor(0, 0, columns * width, rows * height);
      this.renderer.clear();
    }
    this.panes.forEach(({ scene }, i) => {
      const [left, bottom] = [(i % columns) * width, (rows - 1 - Math.floor(i / columns)) * height];
      this.renderer.setViewport(left, bottom, width, height);
      this.renderer.setScissor(left, bottom, width, height);
      this.renderer.render(scene, this.camera);
    });
  }

  /** Draws before the browser's next picture; many calls make one. */
  draw(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => { this.waiting = false; this.drawNow(); });
  }

  private drawNow(): void {
    if (this.element.clientWidth === 0 || this.element.clientHeight === 0) return;
    const grid = this.grid();
    this.render(grid);
    this.panes.forEach(({ labels, frame }, i) => {
      const [left, top] = [(i % grid.columns) * grid.width, Math.floor(i / grid.columns) * grid.height];
      frame?.setAttribute("style", `left:${left}px;top:${top}px;width:${grid.width}px;height:${grid.height}px`);
      const shown = labels.filter(({ point, element }) => {
        const { x, inside } = this.place(point);
        element.classList.toggle("leftwards", x > 0.75);
        element.style.visibility = inside ? "visible" : "hidden";
        return inside;
      });
      const places = shown.map(({ point }): [number, number] => {
        const { x, y } = this.place(point);
        return [left + x * grid.width, top + y * grid.height];
      });
      const shifts = labelShifts(shown.map(({ element }) => element), places,
        { left, right: left + grid.width, top, bottom: top + grid.height });
      shown.forEach(({ element }, k) => {
        element.style.transform = `translate(${places[k][0] + shifts[k][0]}px, ${places[k][1] + shifts[k][1]}px)`;
      });
    });
  }
}
