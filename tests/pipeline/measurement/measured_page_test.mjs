// Opens the page of a sample lift and its record in a headless Chromium, without a network: tables and curves are there.
//   node measured_page_test.mjs WRITE_SAMPLE_MEASURED
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
const folder = mkdtempSync(join(tmpdir(), "blocklift-measured-"));
const failures = [];
const browser = new Browser(join(folder, "profile"));
try {
  execFileSync(process.argv[2], [folder]);
  const page = await browser.open(`file://${join(folder, "measured.html")}`);
  const expect = async (expression, due, what) => {
    const found = await page.value(expression);
    if (found !== due) failures.push(`${what}: ${found} instead of ${due}`);
  };
  await expect("document.body.classList.contains('ready')", true, "the page has drawn itself");
  await expect("document.querySelectorAll('table').length", 4, "tables");
  await expect("document.querySelectorAll('svg.paper').length", 2, "drawings, one a quantity");
  await expect("document.querySelectorAll('svg.paper path').length", 4, "curves, measured and computed");
  await expect("document.body.innerText.includes('deg')", true, "the unit of an angle is there");
  await expect("document.documentElement.scrollWidth <= window.innerWidth", true, "the page fits its window");
} finally {
  browser.process.kill();
  await new Promise((resolve) => browser.process.on("exit", resolve));
  rmSync(folder, { recursive: true, force: true });
}
for (const failure of failures) console.error(failure);
process.exit(failures.length > 0 ? 1 : 0);
