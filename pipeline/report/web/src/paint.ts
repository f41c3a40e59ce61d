// Colours of canvases, which no style sheet reaches: read from the page's variables, light or dark.

export type Paint = "ink" | "soft" | "paper" | "static" | "dynamic" | "measured" | "grid" | "tick" | "band" | "other-band";

const read = new Map<Paint, string>();
const listeners: (() => void)[] = [];

export function paint(name: Paint): string {
  let colour = read.get(name);
  if (colour === undefined) {
    colour = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim() || "#000000";
    read.set(name, colour);
  }
  return colour;
}

/** Called when the reader changes between light and dark. */
export function onNewColours(listener: () => void): void { listeners.push(listener); }

window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  read.clear();
  for (const listener of listeners) listener();
});
