// Numbers beside the lines of a plot's grid: few, whole, and each different from its neighbours.
import { fixed } from "./numbers";

/** Steps of 1, 2 or 5 times a power of ten, about `count` of them; at least two lie in the range. */
export function niceTicks(low: number, high: number, count: number): number[] {
  const rough = Math.max(high - low, 1e-9 * Math.max(Math.abs(low), Math.abs(high)), 1e-30) / count;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5, 10].find((factor) => factor * power >= rough * 0.999) ?? 10);
  const ticks: number[] = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) ticks.push(i * step + 0);  // no minus before a nought
  return ticks.length > 1 || count > 20 || !(high > low) ? ticks : niceTicks(low, high, 2 * count);
}

/** Decimals at which a step is written in full: 2 for 0.25, none for 20. */
function decimalsOf(step: number): number {
  for (let decimals = 0; decimals < 12; ++decimals) {
    const shifted = step * 10 ** decimals;
    if (shifted > 0.5 && Math.abs(shifted - Math.round(shifted)) < 0.01) return decimals;
  }
  return 12;
}

/** The texts of evenly spaced ticks; very large and very small ones share a power of ten. */
export function tickTexts(ticks: number[]): string[] {
  const largest = Math.max(0, ...ticks.map(Math.abs));
  const step = ticks.length > 1 ? Math.abs(ticks[1] - ticks[0]) : largest;
  if (!(largest > 0) || !(step > 0)) return ticks.map((tick) => fixed(tick, 0));
  if (largest < 1e6 && largest >= 1e-4) return ticks.map((tick) => fixed(tick, decimalsOf(step)));
  const exponent = Math.floor(Math.log10(largest) + 1e-9);
  const unit = 10 ** exponent;
  return ticks.map((tick) => (Math.abs(tick) < 1e-6 * step ? "0" : `${fixed(tick / unit, decimalsOf(step / unit))}e${fixed(exponent, 0)}`));
}
