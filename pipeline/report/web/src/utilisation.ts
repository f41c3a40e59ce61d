// How utilisations and results look; the twin of what the program writes for the checks (pipeline/report/front.cc).
import { known } from "./data";
import { Child, h } from "./dom";
import { missing, share } from "./numbers";

// What stands for the utilisation where nothing finite describes it: a rope that has gone slack.
const beyondAnyLimit = 999;

export function bar(utilisation: unknown, pass: boolean): Child {
  if (!known(utilisation)) return missing;
  const full = 1.25;  // the bar ends at 125 %, so that an excess shows
  const width = Math.min(Math.max(utilisation, 0) / full, 1) * 100;
  return h("span", { class: "utilisation" },
    h("span", { class: "bar", "aria-hidden": "true" },
      h("span", { class: pass ? "fill" : "fill failed", style: `width:${width}%` }),
      h("span", { class: "limit", style: `left:${100 / full}%` })),
    h("span", { class: "value" }, utilisation < beyondAnyLimit ? share(utilisation) : "beyond any "
      + "limit"));
}

export function mark(pass: boolean): Child {
  return h("span", { class: pass ? "mark pass" : "mark fail" }, pass ? "pass" : "fail");
}
