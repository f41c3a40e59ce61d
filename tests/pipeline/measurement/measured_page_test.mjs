// Opens the page of a sample lift and its record in a headless Chromium, without a network: tables and curves are there.
//   node measured_page_test.mjs WRITE_SAMPLE_MEASURED
// Exit code 77 (skipped) where there is no Chromium.
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { testInBrowser } from "../report/browser.mjs";

await testInBrowser(async (browser, folder, complain) => {
  execFileSync(process.argv[2], [folder]);
  const page = await browser.open(`file://${join(folder, "measured.html")}`);
  await page.expect(complain, {
    "the page has drawn itself": ["document.body.classList.contains('ready')", true],
    "tables": ["document.querySelectorAll('table').length", 4],
    "drawings, one a quantity": ["document.querySelectorAll('svg.paper').length", 2],
    "curves, measured and computed": ["document.querySelectorAll('svg.paper path').length", 4],
    "the unit of an angle is there": ["document.body.innerText.includes('deg')", true],
    "the page fits its window": ["document.documentElement.scrollWidth <= window.innerWidth", true],
  });
}, "the sample measurement draws itself");
