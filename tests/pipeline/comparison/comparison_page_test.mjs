// Opens the page of a sample comparison in a headless Chromium, without a network: tables and curves are there.
//   node comparison_page_test.mjs WRITE_SAMPLE_COMPARISON
// Exit code 77 (skipped) where there is no Chromium.
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { testInBrowser } from "../report/browser.mjs";

await testInBrowser(async (browser, folder, complain) => {
  execFileSync(process.argv[2], [folder]);
  const page = await browser.open(`file://${join(folder, "comparison.html")}`);
  await page.expect(complain, {
    "the page has drawn itself": ["document.body.classList.contains('ready')", true],
    "tables": ["document.querySelectorAll('table').length", 3],
    "drawings, one a rope": ["document.querySelectorAll('svg.paper').length", 2],
    "curves, two a rope": ["document.querySelectorAll('svg.paper path').length", 4],
    "the key that differs is named": ["document.body.innerText.includes('settle')", true],
    "the page fits its window": ["document.documentElement.scrollWidth <= window.innerWidth", true],
  });
}, "the sample comparison draws itself");
