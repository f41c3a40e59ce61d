// Opens the sample reports in a headless Chromium, without a network, and checks what the page has become.
//   node page_test.mjs WRITE_SAMPLE_REPORTS
// Exit code 77 (skipped) where there is no Chromium.
import { execFileSync, spawnSync } from "node:child_process";
import { join } from "node:path";

import { browserName, testInFolder } from "./browser.mjs";

const sections = {
  whole: ["checks", "lift", "periods", "histories", "loads", "fault", "slings", "stress", "structure", "standard", "accuracy", "method", "annex"],
  loads: ["checks", "loads", "stress", "structure", "standard", "method", "annex"],
  motion: ["checks", "lift", "periods", "histories", "loads", "fault", "slings", "accuracy", "method", "annex"],
};
const expected = [">988<", "Governing: ", "A sample &amp; nothing else"];

await testInFolder((folder, complain) => {
  execFileSync(process.argv[2], [folder]);
  for (const [name, ids] of Object.entries(sections)) {
    const run = spawnSync(browserName, [
      "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--window-size=1300,3000",
      "--host-resolver-rules=MAP * ~NOTFOUND", "--enable-logging=stderr", `--user-data-dir=${join(folder, "profile")}`,
      "--virtual-time-budget=5000", "--dump-dom", `file://${join(folder, name, "report.html")}`,
    ], { encoding: "utf8", timeout: 120000, maxBuffer: 1 << 28 });
    const dom = run.stdout ?? "";
    const complainOf = (text) => complain(`${name}: ${text}`);
    if (!/<body[^>]*class="ready"/.test(dom)) complainOf("the page did not finish drawing itself");
    const found = [...dom.matchAll(/<section id="([^"]*)"/g)].map((match) => match[1]);
    if (found.join() !== ids.join()) complainOf(`sections are ${found.join(", ")}; ${ids.join(", ")} are due`);
    if (ids.includes("periods"))
      for (const text of ["block: pendulum along x", ">14.6<", "neutral: nothing brings it back", "Vibrations of the load (1)",
        "; of it vibrating: load.mode_1 "])
        if (!dom.includes(text)) complainOf(`"${text}" is not among the natural periods`);
    if (ids.includes("fault"))
      for (const text of ["The fault comes at 7.3 s, the worst of 3 instants", ">never<"])
        if (!dom.includes(text)) complainOf(`"${text}" is not where the fault is worst`);
    if (ids.includes("slings"))
      for (const text of ["longer", ">1.43", ">1.240<", ">9.876<"])
        if (!dom.includes(text)) complainOf(`"${text}" is not among the lengths of slings`);
    if (ids.includes("standard"))
      for (const text of ["Motion asks for more.", ">1.234<", "Rules 5.5", "0.987"])
        if (!dom.includes(text)) complainOf(`"${text}" is not in the chain of the standard`);
    for (const text of expected) if (!dom.includes(text)) complainOf(`"${text}" is not on the page`);
    for (const line of (run.stderr ?? "").split("\n"))
      if (/CONSOLE/.test(line) && !/GPU stall|GL Driver Message/.test(line)) complainOf(line);
  }
}, "the sample reports draw themselves without a complaint");
