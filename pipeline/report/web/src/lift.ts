// The drawing of the lift: a scene to turn and to play, elevations of its stages, the tensions of the instant.
import * as three from "three";

import { Clock } from "./clock";
import { PageData, Scene, Series, stageAt, State, states } from "./data";
import { checkbox, choice, h, slider } from "./dom";
import { svgButton } from "./download";
import { elevation, frameOf, tellingSide } from "./elevation";
import type { Section } from "./section";
import type { Vibration, VibrationPlayer } from "./modes";
import { Bodies, boxCorners, inWorld, ropePath, Vector } from "./motion";
import { kilonewtons, missing, seconds, significant, tonnesForce } from "./numbers";
import { BlockSurface } from "./surface";
import { canDraw, Viewer } from "./viewer";

const shades: Record<string, number> = { crane: 0xdfe5ea, trolley: 0xb9c6d1, "hook block": 0xe0b04c, spreader: 0xe0b04c, load: 0xa9bccd };

interface Rope { name: string; sling: boolean; segments: three.Mesh[]; label?: { point: three.Vector3 }; path: (time: number) => Vector[] }

/** The scene in three dimensions; show() puts everything where it is at an instant. */
class LiftView {
  readonly viewer = new Viewer(1, 520, "Drawing of the lift; drag or arrow keys turn it, plus and "
    + "minus zoom");
  followLoad = false;
  private closeUp = false;
  /** Largest motion of a natural mode in the drawing, m: what the eye sees well. */
  get vibrationSize(): number { return 0.05 * Math.max(this.bounds.max.z - this.bounds.min.z, 10); }
  private groups = new Map<string, three.Group>();
  private ropes: Rope[] = [];
  private corners: three.Vector3[] = [];  // of everything drawn, at instants along the lift
  private bounds = new three.Box3();
  private lugs: { point: three.Vector3; element: HTMLElement; at: Vector }[] = [];

  constructor(private data: PageData, private scene: Scene, private bodies: () => Bodies, times: number[]) {
    const world = this.viewer.panes[0].scene;
    world.add(new three.HemisphereLight(0xffffff, 0xc8d0d8, 2.2));
    const sun = new three.DirectionalLight(0xffffff, 1.6);
    sun.position.set(-1, -2, 3);
    world.add(sun);
    for (const body of scene.bodies) world.add(this.makeBody(body));
    for (const rope of scene.ropes) this.makeRope(rope, world);
    for (const lug of scene.lugs) this.lugs.push({ ...this.viewer.addLabel(0, lug.name, "lug"), at: lug.point as Vector });
    for (const time of times) for (const body of scene.bodies) for (const box of body.boxes) for (const corner of boxCorners(box))
      this.corners.push(new three.Vector3(...inWorld(bodies().pose(body.name, time), corner)));
    this.bounds.setFromPoints(this.corners);
    this.addGround(world);
  }

  private makeBody(body: Scene["bodies"][number]): three.Group {
    const group = new three.Group();
    const isLoad = body.name === this.scene.load;
    const colour = shades[isLoad ? "load" : body.kind] ?? shades.crane;
    const material = new three.MeshLambertMaterial({ color: colour, side: three.DoubleSide, flatShading: true,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 });
    const lines = new three.LineBasicMaterial({ color: isLoad ? 0x34495c : 0x8693a0 });
    if (isLoad && this.data.surface?.points) {
      const surface = new BlockSurface(this.data.surface);
      const position = new three.BufferAttribute(surface.points, 3);
      group.add(new three.Mesh(new three.BufferGeometry().setAttribute("position", position)
        .setIndex(new three.BufferAttribute(surface.triangles(), 1)), material));
      group.add(new three.LineSegments(new three.BufferGeometry().setAttribute("position", position)
        .setIndex(new three.BufferAttribute(surface.outlines(), 1)), new three.LineBasicMaterial({ color: 0x4d6276 })));
    } else {
      for (const box of body.boxes) {
        const shape = new three.BoxGeometry(box[0], box[1], box[2])
          .applyQuaternion(new three.Quaternion(box[7], box[8], box[9], box[6])).translate(box[3], box[4], box[5]);
        group.add(new three.Mesh(shape, material), new three.LineSegments(new three.EdgesGeometry(shape), lines));
      }
    }
    this.groups.set(body.name, group);
    return group;
  }

  private makeRope(rope: Scene["ropes"][number], world: three.Scene): void {
    const sling = rope.kind === "sling";
    const cylinder = new three.CylinderGeometry(1, 1, 1, 8, 1, true);
    const material = new three.MeshBasicMaterial({ color: sling ? 0xa8450f : 0x4b5864 });
    const segments = rope.points.slice(1).map(() => new three.Mesh(cylinder, material));
    world.add(...segments);
    this.ropes.push({ name: rope.name, sling, segments, path: (time) => ropePath(rope, this.bodies(), time),
      label: sling ? this.viewer.addLabel(0, rope.name, "rope") : undefined });
  }

  private addGround(world: three.Scene): void {
    const { min, max } = this.bounds;
    const size = 20 * Math.ceil(Math.max(max.x - min.x, max.y - min.y) / 20 + 1);
    const grid = new three.GridHelper(size, size / 10, 0xc3ccd4, 0xe1e6ea);
    grid.rotation.x = Math.PI / 2;
    grid.position.set(10 * Math.round((min.x + max.x) / 20), 10 * Math.round((min.y + max.y) / 20), -0.05);
    world.add(grid);
  }

  show(time: number): void {
    for (const [name, group] of this.groups) {
      const { p, q } = this.bodies().pose(name, time);
      group.position.set(...p);
      group.quaternion.set(q[1], q[2], q[3], q[0]);
    }
    const radius = Math.max(this.bounds.max.z - this.bounds.min.z, 10) / 700;
    for (const rope of this.ropes) {
      const path = rope.path(time).map((point) => new three.Vector3(...point));
      rope.segments.forEach((segment, i) => {
        const along = path[i + 1].clone().sub(path[i]);
        segment.position.copy(path[i]).addScaledVector(along, 0.5);
        segment.scale.set(radius, along.length(), radius);
        segment.quaternion.setFromUnitVectors(new three.Vector3(0, 1, 0), along.normalize());
      });
      rope.label?.point.copy(path[0]).add(path[path.length - 1]).multiplyScalar(0.5);
    }
    const loadPose = this.bodies().pose(this.scene.load, time);
    for (const { point, at } of this.lugs) point.set(...inWorld(loadPose, at));
    if (this.followLoad || this.closeUp) this.viewer.follow(this.loadCentre(time));
    this.viewer.draw();
  }

  private loadCorners(time: number): three.Vector3[] {
    const load = this.scene.bodies.find((body) => body.name === this.scene.load);
    const pose = this.bodies().pose(this.scene.load, time);
    return (load?.boxes ?? []).flatMap((box) => boxCorners(box).map((corner) => new three.Vector3(...inWorld(pose, corner))));
  }

  private loadCentre(time: number): three.Vector3 {
    const corners = this.loadCorners(time);
    return corners.length === 0 ? new three.Vector3(...this.bodies().pose(this.scene.load, time).p)
      : new three.Box3().setFromPoints(corners).getCenter(new three.Vector3());
  }

  look(name: "oblique" | "side" | "front" | "top" | "load", time: number): void {
    const eyes: Record<typeof name, [number, number, number]> = {
      oblique: [0.75, -1, 0.42], side: [1, 0, 0], front: [0, -1, 0], top: [0, 0, 1], load: [0.75, -1, 0.5] };
    const slings = this.ropes.filter((rope) => rope.sling).flatMap((rope) => rope.path(time).map((point) => new three.Vector3(...point)));
    this.viewer.look(eyes[name], name === "load" ? [...this.loadCorners(time), ...slings] : this.corners, name === "load" ? 0.25 : 0.08);
    this.closeUp = name === "load";
    // From afar the lugs' names would only hide the ropes'.
    for (const { element } of this.lugs) element.style.display = name === "load" ? "" : "none";
    this.viewer.draw();
  }
}

/** Tension of every sling at the instant, static and dynamic, as bars. */
function tensionPanel(data: PageData, clock: Clock): HTMLElement | null {
  const ropes = (data.histories.dynamic ?? data.histories.static)?.ropes.filter((one) => one.quantity === "tension") ?? [];
  if (ropes.length === 0) return null;
  const series = (state: State, name: string): Series | undefined => {
    const packed = data.histories[state]?.ropes.find((one) => one.name === name && one.quantity === "tension");
    return packed && new Series(packed);
  };
  let top = 1;
  const rows = ropes.map(({ name }) => {
    const curves = { static: series("static", name), dynamic: series("dynamic", name) };
    for (const state of states) for (const value of curves[state]?.values ?? []) top = Math.max(top, value);
    const bars = { static: h("i", { class: "static" }), dynamic: h("i", { class: "dynamic" }) };
    const value = h("span", { class: "value" });
    return { curves, bars, value, element: h("div", { class: "rope" }, h("b", {}, name), h("span", { class: "bars" }, bars.static, bars.dynamic), value) };
  });
  const show = (time: number): void => {
    for (const { curves, bars, value } of rows) {
      let last = NaN;
      for (const state of states) {
        const now = curves[state]?.at(time) ?? NaN;
        bars[state].style.width = `${Number.isFinite(now) ? Math.max(now / top, 0) * 100 : 0}%`;
        if (Number.isFinite(now)) last = now;
      }
      value.textContent = Number.isFinite(last) ? `${kilonewtons(last)} kN` : missing;
      value.title = `${tonnesForce(last)} tonnes`;
    }
  };
  clock.listen(show);
  show(clock.time);
  return h("div", { class: "tensions", role: "group", "aria-label": "Rope tensions at this instant" },
    h("p", { class: "legend" }, states.map((state) => h("span", {}, h("i", { class: state }), state))),
    rows.map((row) => row.element));
}

/** The lift at its start and at the end of each stage; each is a button that goes there. */
function stageStrip(data: PageData, scene: Scene, bodies: Bodies, clock: Clock): HTMLElement {
  const instants = [{ name: "start", time: clock.start },
    ...data.stages.map((stage) => ({ name: `after ${stage.name}`, time: stage.end }))];
  const times = instants.map((one) => one.time);
  const side = tellingSide(scene, bodies, times);
  const frame = frameOf(scene, bodies, times, side);
  return h("div", { class: "strip" }, instants.map(({ name, time }) => h("button", {
    type: "button", title: "Show this instant", onclick: () => clock.set(time),
  }, elevation(scene, bodies, time, side, frame, false), h("span", {}, name, h("small", {}, `${seconds(time)} s`)))));
}

/** The line under the drawing that says which natural mode it plays, and the motion itself. */
function vibrationBar(clock: Clock, view: LiftView, player: VibrationPlayer, bodies: () => Bodies, atRest: () => void): HTMLElement {
  const shownPeriod = 2500;  // ms of one swing on the screen, whatever its true period
  const name = h("b", {});
  const bar = h("p", { class: "vibration", hidden: true }, "Natural motion, enlarged and not at "
    + "its own pace: ", name, " ",
    h("button", { type: "button", onclick: () => player.play(null) }, "stop"));
  let begun = 0;
  const step = (moment: number): void => {
    const vibration = player.now;
    if (!vibration) return;
    vibration.phase = 2 * Math.PI * (moment - begun) / shownPeriod;
    view.show(vibration.time);
    requestAnimationFrame(step);
  };
  player.listen((vibration: Vibration | null) => {
    if (vibration) atRest();
    bodies().vibrate(vibration, view.vibrationSize);
    bar.hidden = vibration === null;
    name.textContent = vibration?.name ?? "";
    if (vibration) { begun = performance.now(); requestAnimationFrame(step); } else view.show(clock.time);
  });
  clock.listen((time) => { if (player.now && Math.abs(time - player.now.time) > 1e-6) player.play(null); });
  window.addEventListener("beforeprint", () => player.play(null));
  return bar;
}

export function liftSection(data: PageData, clock: Clock, player: VibrationPlayer): Section | null {
  const { scene } = data;
  const moving = states.filter((state) => data.motion[state]);
  if (!scene || moving.length === 0) return null;
  const all = new Map(moving.map((state) => [state, new Bodies(data.motion[state]!)]));
  let state: State = all.has("dynamic") ? "dynamic" : "static";
  const bodies = (): Bodies => all.get(state)!;
  const times = [clock.start, ...data.stages.flatMap((stage) => [stage.start, (stage.start + stage.end) / 2, stage.end]), clock.end];

  const drawings = h("div", { class: "elevations" });
  const drawElevations = (): void => {
    drawings.replaceChildren(...(["side", "front"] as const).map((side) => h("figure", {},
      elevation(scene, bodies(), clock.time, side, frameOf(scene, bodies(), times, side), true) as unknown as HTMLElement,
      h("figcaption", {}, svgButton(`${side} elevation`, () => elevation(scene, bodies(), clock.time, side, frameOf(scene, bodies(), times, side), true)),
        `${side === "side" ? "Side" : "Front"} elevation at ${seconds(clock.time)} s, ${stageAt(data.stages, clock.time)}`))));
  };
  drawElevations();

  const now = h("output", { class: "now" });
  const time = slider("Instant of the lift, s", clock.start, clock.end, "any", clock.time, (value) => clock.set(value));
  time.addEventListener("keydown", (event) => {  // a step of one second; the browser's own would be a hundredth of the lift
    const steps: Record<string, number> = { ArrowLeft: -1, ArrowRight: 1, PageDown: -30, PageUp: 30 };
    if (steps[event.key]) { clock.set(clock.time + steps[event.key]); event.preventDefault(); }
  });
  const show = (value: number): void => {
    time.value = String(value);
    now.textContent = `${seconds(value)} s, ${stageAt(data.stages, value)}`;
  };
  clock.listen(show);
  show(clock.time);
  window.addEventListener("beforeprint", drawElevations);

  const strip = stageStrip(data, scene, bodies(), clock);
  if (!canDraw()) {
    clock.listen(drawElevations);
    drawings.classList.add("always");
    return { id: "lift", title: scene.load ? "The lift" : "The motion", content: [h("div", { class: "player" }, time, now), drawings, tensionPanel(data, clock), strip,
      h("p", { class: "hint" }, "This browser does not draw in three dimensions (WebGL); the "
        + "elevations take its place.")] };
  }
  const view = new LiftView(data, scene, bodies, times);
  clock.listen((value) => view.show(value));
  const views = choice("View", [["oblique", "oblique"], ["side", "side"], ["front", "front"], ["top", "top"],
    ...(scene.load ? [["load", "load"] as ["load", "load"]] : [])], "oblique",
    (name) => view.look(name, clock.time));
  const which = choice("Motion", moving.map((one) => [one, one]), state, (value) => { player.play(null); state = value; view.show(clock.time); });
  const vibration = vibrationBar(clock, view, player, bodies, () => {
    if (!all.has("static")) return;
    bodies().vibrate(null, 0);
    state = "static";
    which.set(state);
  });
  view.look("oblique", clock.time);
  view.show(clock.time);
  return {
    id: "lift", title: scene.load ? "The lift" : "The motion", content: [
      h("div", { class: "controls" }, views.element, moving.length > 1 && which.element,
        scene.load && checkbox("follow the load", false, (on) => { view.followLoad = on; view.show(clock.time); })),
      h("div", { class: "stage-view" }, view.viewer.element, tensionPanel(data, clock)),
      h("div", { class: "player" }, playButton(clock), time, now), vibration, strip, drawings],
  };
}

function playButton(clock: Clock): HTMLElement {
  // Seconds of the lift in one second: a short motion takes some ten seconds to be shown.
  const speeds = Math.min(60, (clock.end - clock.start) / 10);
  let playing = false;
  let last = 0;
  const button = h("button", { type: "button", class: "play", title: `Play, ${significant(speeds, 2)} times as fast as the motion`, onclick: () => {
    playing = !playing;
    last = performance.now();
    button.textContent = playing ? "pause" : "play";
    if (playing && clock.time >= clock.end) clock.set(clock.start);
    if (playing) requestAnimationFrame(step);
  } }, "play");
  const step = (moment: number): void => {
    if (!playing) return;
    clock.set(clock.time + Math.max(moment - last, 0) / 1000 * speeds);
    last = moment;
    if (clock.time >= clock.end) { playing = false; button.textContent = "play"; } else requestAnimationFrame(step);
  };
  return button;
}
