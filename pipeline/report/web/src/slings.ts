// Lengths of slings: what an error of each does to all, the worst set of errors, and lengths that hang level.
import { known, PageData, SlingState } from "./data";
import { Child, Column, h, table } from "./dom";
import { change, fixed, kilonewtons, missing, ratio, seconds } from "./numbers";
import type { Section } from "./section";

const degrees = (radians: unknown): string => known(radians) ? `${fixed(radians * 180 / Math.PI, 2)}\u00a0°` : missing;
const metres = (value: unknown): string => fixed(value, 3);

export function slingsSection(data: PageData): Section | null {
  const slings = data.summary.sling_lengths;
  if (!slings) return null;
  const title = "Lengths of the slings";
  if (slings.trouble || !slings.meant) {
    return { id: "slings", title, content: h("p", {}, `What errors in their lengths do was not found: ${slings.trouble ?? "no equilibrium"}`) };
  }
  const meant = slings.meant, names = Object.keys(slings.lengths_m ?? {});
  const percent = `${fixed((slings.tolerance ?? 0) * 100, 2)}\u202f%`;
  const row = (name: string, word: string, state: SlingState): Child[] => [name, word, ...names.map((one) => {
    const now = state.tensions_N?.[one], before = meant.tensions_N?.[one];
    const text = kilonewtons(now);
    return known(now) && known(before) && before > 0
      ? h("span", { title: change(100 * (now / before - 1)) }, text) : text;
  }), degrees(state.tilt_rad)];
  const columns: Column[] = [{ head: "Sling", align: "left" }, { head: `by ${percent}`, align: "left" },
    ...names.map((name): Column => ({ head: `${name}, kN` })), { head: "Tilt of the load" }];
  const rows = [row("all", "as meant", meant),
    ...(slings.errors ?? []).flatMap((one) => [row(one.sling, "longer", one.longer), row(one.sling, "shorter", one.shorter)])];
  const level = slings.level, worst = slings.worst;
  const own: Column[] = [{ head: "Sling", align: "left" }, { head: "Length, m" }, { head: "Tension, kN" }];
  if (worst) own.push({ head: "in the worst set, kN" }, { head: "over that as meant" });
  if (level) own.push({ head: "Length that hangs level, m" }, { head: "Tension then, kN" });
  const ownRows = names.map((name): Child[] => {
    const tension = meant.tensions_N?.[name], most = worst?.tensions_N?.[name];
    const cells: Child[] = [name, metres(slings.lengths_m?.[name]), kilonewtons(tension)];
    if (worst) cells.push(kilonewtons(most), known(most) && known(tension) && tension > 0 ? ratio(most / tension) : missing);
    if (level) cells.push(metres(level.lengths_m?.[name]), kilonewtons(level.tensions_N?.[name]));
    return cells;
  });
  return {
    id: "slings", title, short: "Sling lengths", content: [
      h("p", { class: "lead" }, `What it does where one sling is ${percent} longer or shorter than meant: equilibria of the lift as it hangs at `
        + `${seconds(slings.time_s)} s in still air, each found anew.`),
      table("Tensions by errors of length", columns, rows),
      h("p", {}, worst ? `The worst set is the one of all sets of signs, every sling being off by ${percent}; the tilt is up to ${degrees(worst.tilt_rad)} then, `
        + `${degrees(meant.tilt_rad)} with the lengths as meant. ` : "",
        level ? "Lengths that hang the load level are those nearest to the ones meant."
          : "No lengths near to those meant hang the load level."),
      table("Lengths", own, ownRows)],
  };
}
