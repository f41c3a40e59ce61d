// Opens the page of a sample comparison in a headless Chromium, without a network: tables and curves are there.
//   node comparison_page_test.mjs WRITE_SAMPLE_COMPARISON
// Exit code 77 (skipped) where there is no Chromium.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Browser, browserName } from "../report/browser.mjs";

if (!browserName) {
  console.log("skipped: no Chromium on the PATH");
  process.exit(77);
}
const folder = mkdtempSync(join(tmpdir(), "blocklift-comparison-"));
const failures = [];
const browser = new Browser(join(folder, "profile"));
try {
  execFileSync(process.argv[2], [folder]);
  const page = await browser.open(`file://${join(folder, "comparison.html")}`);
  const expect = async (expression, due, what) => {
    const found = await page.value(expression);
    if (found !== due) failures.push(`${what}: ${found} instead of ${due}`);
  };
  await expect("document.body.classList.contains('ready')", true, "the page has drawn itself");
  await expect("document.querySelectorAll('table').length", 3, "tables");
  await expect("document.querySelectorAll('svg.paper').length", 2, "drawings, one a rope");
  await expect("document.querySelectorAll('svg.paper path').length", 4, "curves, two a rope");
  await expect("document.body.innerText.includes('settle')", true, "the key that differs is named");
  await expect("document.documentElement.scrollWidth <= window.innerWidth", true, "the page fits its window");
} finally {
  browser.process.kill();
  await new Promise((resolve) => browser.process.on("exit", resolve));
  rmSync(folder, { recursive: true, force: true });
}
for (const failure of failures) console.error(failure);
process.exit(failures.length > 0 ? 1 : 0);
