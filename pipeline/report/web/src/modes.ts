// Natural periods: the motions that the hanging lift has of its own, in words, in figures and played in the drawing.
import { Clock } from "./clock";
import { known, ModeShapes, NaturalMode, PageData, unpack } from "./data";
import { Child, Column, h, table } from "./dom";
import type { Section } from "./section";
import type { Pose, Vector } from "./motion";
import { fixed, missing, seconds, share, significant } from "./numbers";

const amplitudes = 12;  // numbers a mode and body: rotation and displacement, real, then imaginary

/** One mode that the drawing plays: its shape, the instant it belongs to, the phase it has come to. */
export class Vibration {
  phase = 0;
  constructor(readonly name: string, readonly time: number, private shapes: Map<string, Float32Array>, private row: number) {}

  /** A body's pose moved along the mode; `size` (m) is the largest motion. */
  moved(body: string, pose: Pose, size: number): Pose {
    const motion = this.shapes.get(body)?.subarray(amplitudes * this.row, amplitudes * (this.row + 1));
    if (!motion) return pose;
    const at = (k: number): number => size * (motion[k] * Math.cos(this.phase) - motion[k + 6] * Math.sin(this.phase));
    const turn: Vector = [at(0), at(1), at(2)];
    const angle = Math.hypot(...turn);
    const s = angle > 0 ? Math.sin(angle / 2) / angle : 0.5;
    return {
      p: [pose.p[0] + at(3), pose.p[1] + at(4), pose.p[2] + at(5)],
      q: product([Math.cos(angle / 2), s * turn[0], s * turn[1], s * turn[2]], pose.q),
    };
  }
}

function product(a: Pose["q"], b: Pose["q"]): Pose["q"] {
  return [
    a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
    a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]];
}

/** What the drawing plays now; the table sets it, the drawing listens. */
export class VibrationPlayer {
  now: Vibration | null = null;
  private listeners: ((vibration: Vibration | null) => void)[] = [];

  listen(listener: (vibration: Vibration | null) => void): void { this.listeners.push(listener); }
  get canPlay(): boolean { return this.listeners.length > 0; }
  play(vibration: Vibration | null): void {
    this.now = vibration;
    for (const listener of this.listeners) listener(vibration);
  }
}

const kinds: Record<string, string> = {
  overdamped: "creeps back without swinging", neutral: "neutral: nothing brings it back", unstable: "unstable: grows by itself",
};

/** What kind of mode it is: wind that turns a load is no motion that grows. */
function kindWords(mode: NaturalMode): string {
  return mode.kind === "unstable" && mode.turned_by_wind ? "turned by the wind, nothing holds it" : kinds[mode.kind] ?? mode.kind;
}

/** The two that have most of the kinetic energy, of those with a twentieth or more. */
function largest(shares: Record<string, number> | undefined): [string, number][] {
  return Object.entries(shares ?? {}).sort((a, b) => b[1] - a[1]).slice(0, 2).filter(([, size]) => size >= 0.05);
}

function listed(shares: [string, number][]): string {
  return shares.map(([name, size]) => `${name} ${share(size)}`).join(", ");
}

/** Bodies that move, and by which vibrations of their own. */
function mover(mode: NaturalMode): string {
  const vibrations = largest(mode.energy_share_by_elastic_mode);
  return listed(largest(mode.energy_share_by_body)) + (vibrations.length > 0 ? `; of it vibrating: ${listed(vibrations)}` : "");
}

/** Whether the load has most of its kinetic energy by vibrating, not by moving as a whole. */
function isVibration(mode: NaturalMode, load: string): boolean {
  const vibrating = Object.values(mode.energy_share_by_elastic_mode ?? {}).reduce((sum, one) => sum + one, 0);
  return vibrating > 0 && vibrating > 0.5 * (mode.energy_share_by_body?.[load] ?? 0);
}

function period(mode: NaturalMode): string {
  if (mode.kind === "overdamped") return "no oscillation";
  return known(mode.period_s) ? significant(mode.period_s, 3) : missing;
}

/**
 * Modes in which the load moves as a whole, those that an operator can feel, and such as grow; the quick rest, and what vessels
 * beside the lift do by themselves, stands apart. All, if nothing is the load.
 */
function isMain(mode: NaturalMode, load: string): boolean {
  const shares = mode.energy_share_by_body;
  if (!load || mode.kind === "unstable") return true;
  if (!shares) return mode.kind !== "oscillating";
  return (shares[load] ?? 0) >= 0.2 && !isVibration(mode, load);
}

function modeTable(caption: string, modes: NaturalMode[], all: NaturalMode[], play: ((row: number) => void) | null): Child {
  if (modes.length === 0) return null;
  const columns: Column[] = [
    { head: "Motion", align: "left" }, { head: "Period, s" }, { head: "Frequency, Hz" },
    { head: "Damping ratio", title: "share of critical damping" },
    { head: "Elastic", title: "part of the restoring energy in stretched ropes; the rest is "
      + "weight: a pendulum 0 %, a bounce 100 %" },
    { head: "Kinetic energy in", align: "left" }, ...(play ? [{ head: "" }] : []),
  ];
  return table(caption, columns, modes.map((mode) => [
    h("span", { title: mode.kind === "oscillating" ? undefined : kindWords(mode) }, mode.name, mode.kind === "oscillating" ? null : h("small", { class: "mode-kind" }, kindWords(mode))),
    period(mode), mode.kind === "neutral" || mode.kind === "overdamped" ? missing : significant(mode.frequency_Hz, 3),
    mode.kind === "neutral" ? missing : `${fixed((mode.damping_ratio ?? 0) * 100, 2)}\u202f%`,
    share(mode.elastic_share), mover(mode),
    ...(play ? [h("button", { type: "button", class: "time show-mode", title: "Play this motion "
      + "in the drawing", onclick: () => play(all.indexOf(mode)) }, "show")] : []),
  ]));
}

/** A motion along the operation: its mode at each instant that has it. */
export interface FollowedMotion { name: string; names: string[]; modes: (NaturalMode | undefined)[] }

/** What the name says behind the bodies: "roll about x" of "load and C1.left: roll about x against C1.right". */
function motionWords(name: string): string {
  return name.slice(name.indexOf(": ") + 2).replace(/ against .*$/, "");
}

/**
 * Motions followed from instant to instant, each mode in one of them. A mode goes on under its own name and, without such, as
 * the same kind of motion of about the same period: two hooks with nearly the same part in it take turns in its name. Of several,
 * the nearest in period goes first.
 */
export function followMotions(instants: NaturalMode[][]): FollowedMotion[] {
  const farthest = Math.log(1.5), far = 1e9;
  const followed: FollowedMotion[] = [];
  instants.forEach((modes, instant) => {
    const last = followed.map(({ modes: before }) => before.filter((mode) => mode).pop()!);
    const pairs = last.flatMap((before, motion) => modes.map((mode, m) => {
      const bothKnown = known(before.period_s) && known(mode.period_s);
      const apart = bothKnown ? Math.abs(Math.log(mode.period_s! / before.period_s!)) : before.kind === mode.kind ? 0 : far;
      const same = followed[motion].names.includes(mode.name);
      const alike = apart <= farthest && mode.kind === before.kind && motionWords(mode.name) === motionWords(before.name);
      return { motion, m, apart, rank: same ? 0 : alike ? 1 : 2 };
    })).filter(({ rank }) => rank < 2).sort((a, b) => a.rank - b.rank || a.apart - b.apart);
    const taken = new Set<number>();
    for (const { motion, m } of pairs) {
      if (followed[motion].modes[instant] || taken.has(m)) continue;
      taken.add(m);
      followed[motion].modes[instant] = modes[m];
      if (!followed[motion].names.includes(modes[m].name)) followed[motion].names.push(modes[m].name);
    }
    modes.forEach((mode, m) => {
      if (taken.has(m)) return;
      const motion: FollowedMotion = { name: mode.name, names: [mode.name], modes: [] };
      motion.modes[instant] = mode;
      followed.push(motion);
    });
  });
  for (const motion of followed) {
    if (motion.names.length === 1) continue;
    const first = motion.names.map((name) => name.split(/, | and |: /)[0]);
    motion.name = (first.every((one) => one === first[0]) ? first[0] : "several bodies") + ": " + motionWords(motion.name);
  }
  return followed;
}

/** How the load's own periods go along the operation: an instant a row. */
function overview(data: PageData, load: string, clock: Clock): Child {
  const instants = data.summary.natural_periods ?? [];
  if (instants.length < 2) return null;
  const motions = followMotions(instants.map(({ modes }) => modes.filter((mode) => isMain(mode, load))));
  const columns: Column[] = [{ head: "Instant", align: "left" }, { head: "at, s" },
    ...motions.map(({ name, names }) => ({ head: name, title: names.length > 1 ? names.join("; ") : undefined }))];
  return table("Natural periods along the operation, s", columns, instants.map(({ instant, time_s: time }, row) => [instant,
    data.scene ? h("button", { class: "time", type: "button", title: "Show this instant in the "
      + "drawing", onclick: () => {
      clock.set(time);
      document.getElementById("lift")?.scrollIntoView({ behavior: "smooth" });
    } }, seconds(time)) : seconds(time),
    ...motions.map(({ modes }) => {
      const mode = modes[row];
      return !mode ? missing : mode.kind === "oscillating" ? period(mode) : mode.turned_by_wind ? "turned by the wind" : mode.kind;
    })]));
}

function shapesOf(shapes: ModeShapes | undefined): Map<string, Float32Array> {
  return new Map(Object.entries(shapes?.bodies ?? {}).map(([body, packed]) => [body, unpack(packed)]));
}

export function modesSection(data: PageData, clock: Clock, player: VibrationPlayer): Section | null {
  const instants = data.summary.natural_periods ?? [];
  if (instants.length === 0) return null;
  const load = data.scene?.load ?? "";
  const body = h("div", {});
  const show = (index: number): void => {
    const { modes, time_s: time } = instants[index];
    const shapes = shapesOf(data.modes[index]);
    const play = player.canPlay && shapes.size > 0 ? (row: number): void => {
      clock.set(time);
      player.play(new Vibration(modes[row].name, time, shapes, row));
      document.getElementById("lift")?.scrollIntoView({ behavior: "smooth" });
    } : null;
    const main = modes.filter((mode) => isMain(mode, load));
    const vibrations = modes.filter((mode) => !isMain(mode, load) && isVibration(mode, load));
    const rest = modes.filter((mode) => !isMain(mode, load) && !vibrations.includes(mode));
    const apart = (summary: string, caption: string, some: NaturalMode[]): Child => some.length === 0 ? null
      : h("details", { class: "modes" }, h("summary", {}, `${summary} (${some.length})`), modeTable(caption, some, modes, play) as HTMLElement);
    body.replaceChildren();
    for (const part of [
      modeTable(`${load ? "Motions of the load" : "Motions"}: ${instants[index].instant}, ${seconds(time)} s`, main, modes, play),
      apart("Vibrations of the load", "Motions in which the load vibrates rather than moves", vibrations),
      apart("Motions of hook blocks and other bodies", "Motions in which the load has little part", rest),
    ]) if (part) body.appendChild(part as Node);
  };
  show(0);
  const which = h("select", { "aria-label": "Instant", onchange: (event: Event) => show(Number((event.target as HTMLSelectElement).value)) },
    instants.map((one, i) => h("option", { value: i }, `${one.instant}, ${seconds(one.time_s)} s`)));
  return {
    id: "periods", title: "Natural periods", content: [
      h("p", { class: "lead" }, load ? "The motions that the lift has of its own while it hangs "
        + "at rest, drives and winches held: a push or a "
        + "start of the cranes wakes those whose period it meets. Small vibrations about the "
        + "equilibrium at the start, after each stage, "
        + "and where a rope at rest is nearest to breaking."
        : "The motions that the mechanism has of its own at rest, drives and winches held: small "
          + "vibrations about its equilibrium at the start."),
      overview(data, load, clock),
      instants.length > 1 ? h("div", { class: "controls" }, h("label", {}, "Instant ", which)) : null, body],
  };
}
