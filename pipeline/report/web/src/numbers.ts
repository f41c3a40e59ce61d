// Numbers as an engineer reads them: kN, tonnes, MPa, mm, rounded to what is known.
import { known } from "./data";

export const missing = "–";
const standardGravity = 9.80665;  // m/s^2, for forces given in tonnes

function grouped(text: string): string {
  const [whole, part] = text.split(".");
  const digits = whole.replace(/^-/, "");
  const groups = digits.length > 3 ? digits.replace(/\B(?=(\d{3})+$)/g, "\u202f") : digits;
  return (whole.startsWith("-") ? "\u2212" : "") + groups + (part ? "." + part : "");
}

export function fixed(value: unknown, decimals: number): string {
  if (!known(value)) return missing;
  const text = value.toFixed(decimals);
  return grouped(Number(text) === 0 ? text.replace("-", "") : text);
}

/** About `digits` significant digits, never dropping digits before the point. */
export function significant(value: unknown, digits: number): string {
  if (!known(value)) return missing;
  if (value === 0) return "0";
  const magnitude = Number(value.toExponential(Math.max(digits - 1, 0)).split("e")[1]);  // of 99.96 to three digits: of 100
  if (magnitude < -3 || magnitude > 8) return scientific(value, Math.max(digits - 1, 1));
  return fixed(value, Math.max(digits - 1 - magnitude, 0));
}

const superscripts: Record<string, string> =
  { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

export function scientific(value: unknown, decimals = 1): string {
  if (!known(value)) return missing;
  if (value === 0) return "0";
  const [mantissa, exponent] = value.toExponential(decimals).split("e");
  const raised = String(Number(exponent)).split("").map((sign) => superscripts[sign]).join("");
  return `${mantissa.replace("-", "\u2212")}\u202f·\u202f10${raised}`;
}

export const kilonewtons = (newtons: unknown): string =>
  known(newtons) ? significant(newtons / 1e3, Math.abs(newtons) < 1e5 ? 3 : 4 - Number(Math.abs(newtons) < 1e6)) : missing;
export function tonnesForce(newtons: unknown): string {
  if (!known(newtons)) return missing;
  const tonnes = newtons / 1e3 / standardGravity, size = Math.abs(newtons);
  return size < 1e5 ? significant(tonnes, 3) : fixed(tonnes, size < 1e8 ? 1 : 0);
}
export const tonnes = (kilograms: unknown): string =>
  known(kilograms) ? significant(kilograms / 1e3, 4) : missing;
export const megapascals = (pascals: unknown): string => known(pascals) ? significant(pascals / 1e6, 3) : missing;
export const millimetres = (metres: unknown): string => known(metres) ? significant(metres * 1e3, 3) : missing;
export const seconds = (value: unknown): string => fixed(value, 1);
export const ratio = (value: unknown): string => fixed(value, 3);
export const share = (value: unknown): string => known(value) ? fixed(value * 100, 0) + "\u202f%" : missing;

/** A change in per cent with its sign. */
export function change(percent: unknown, decimals = 1): string {
  if (!known(percent)) return missing;
  const text = fixed(percent, decimals);
  return (Number(percent.toFixed(decimals)) > 0 ? "+" : "") + text + "\u202f%";
}

export function point(metres: unknown): string {
  return Array.isArray(metres) && metres.every(known) ? metres.map((value) => fixed(value, 2)).join(", ") : missing;
}

/** A value of SI unit `unit` in the unit that reports use. */
export function inReportUnit(value: unknown, unit: string): { text: string; unit: string } {
  const factors: Record<string, [number, string]> = {
    N: [1e-3, "kN"], Pa: [1e-6, "MPa"], m: [1e3, "mm"], rad: [180 / Math.PI, "°"], kg: [1e-3, "tonnes"], "N m": [1e-3, "kN m"],
  };
  const [factor, name] = factors[unit] ?? [1, unit === "1" ? "" : unit];
  return { text: !known(value) ? missing : name === "kN" ? kilonewtons(value) : significant(value * factor, 3), unit: name };
}
