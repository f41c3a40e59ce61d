// The report as a document: printed from windows of three widths, read without scripts, on a telephone, in the dark and by
// machines that read aloud; its tables and plots as files.
//   node document_test.mjs WRITE_SAMPLE_REPORTS FOLDER_OF_AXE
// Exit code 77 (skipped) where there is no Chromium.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { inflateSync } from "node:zlib";

import { testInBrowser } from "./browser.mjs";

let expect;  // (holds, text): complains of what does not hold

/** What is drawn on the pages of a PDF, page by page: its content streams, which name fonts and pictures by number. */
function pagesOf(pdf) {
  const text = pdf.toString("latin1");
  const objects = new Map([...text.matchAll(/\n(\d+) 0 obj\s*([\s\S]*?)\bendobj/g)].map((match) => [match[1], match[2]]));
  return [...objects.values()].filter((object) => /\/Type\s*\/Page\b/.test(object)).map((page) => {
    const content = objects.get(/\/Contents\s+(\d+)/.exec(page)[1]);
    const [, stream] = /stream\r?\n([\s\S]*?)\r?\nendstream/.exec(content);
    return inflateSync(Buffer.from(stream, "latin1"), { finishFlush: 2 }).toString("latin1");
  });
}

async function testPrint(browser, address) {
  const prints = [];
  for (const width of [1280, 1920, 700]) {
    const page = await browser.open(address, { width });
    const { data } = await page.send("Page.printToPDF", { preferCSSPageSize: true, printBackground: true });
    const pages = pagesOf(Buffer.from(data, "base64"));
    prints.push({ width, pages });
    await page.close();
  }
  const [first, ...others] = prints;
  expect(first.pages.length >= 3 && first.pages.length <= 20, `the sample prints on ${first.pages.length} pages`);
  for (const { width, pages } of others) {
    expect(pages.length === first.pages.length, `${pages.length} pages from ${width} px, ${first.pages.length} from ${first.width} px`);
    pages.forEach((page, i) => expect(page === first.pages[i], `page ${i + 1} is another from ${width} px than from ${first.width} px`));
  }
}

/** The curve of a plot on paper reaches from the start of the lift to its end, inside of its axes. */
async function testPaperPlot(browser, address) {
  const page = await browser.open(address);
  await page.send("Emulation.setEmulatedMedia", { media: "print" });
  const plot = await page.value(`(() => {
    const drawing = document.querySelector("#histories .on-paper svg");
    const box = (element) => { const { left, right } = element.getBoundingClientRect(); return [left, right]; };
    return { shown: drawing.getBoundingClientRect().width, axes: [...drawing.querySelectorAll("line")].map(box),
      curves: [...drawing.querySelectorAll("path")].map(box), canvases: [...document.querySelectorAll(".plot canvas")]
        .filter((canvas) => canvas.getClientRects().length > 0).length };
  })()`);
  expect(plot.shown > 300, "the plot of the tension is not on paper");
  expect(plot.canvases === 0, "plots of the screen are printed");
  expect(plot.curves.length === 2, `${plot.curves.length} curves of tension on paper; 2 are due`);
  const [left, right] = [Math.min(...plot.axes.map((one) => one[0])), Math.max(...plot.axes.map((one) => one[1]))];
  for (const curve of plot.curves) {
    expect(Math.abs(curve[0] - left) < 3 && Math.abs(curve[1] - right) < 3,
      `a curve goes from ${curve[0]} to ${curve[1]} px of ${left} to ${right} px`);
  }
  await page.close();
}

/** Hoists are folded away on the screen, and drawn on paper. */
async function testHoists(browser, address) {
  const page = await browser.open(address);
  const widths = `[...document.querySelectorAll("#histories .hoists svg")].map((one) => one.getBoundingClientRect().width)`;
  const folded = await page.value(widths);
  expect(folded.length === 1 && folded[0] === 0, `hoists for paper on the screen: ${folded} px wide`);
  await page.send("Emulation.setEmulatedMedia", { media: "print" });
  const printed = await page.value(widths);
  expect(printed.length === 1 && printed[0] > 100, `hoists on paper: ${printed} px wide`);
  await page.value(`document.querySelectorAll("#histories details").forEach((one) => { one.open = true; })`);
  const twice = await page.value(`[...document.querySelectorAll("#histories details svg")].filter((one) => one.getClientRects().length > 0).length`);
  expect(twice === 0, "hoists that were unfolded are printed twice");
  await page.close();
}

async function testWithoutScripts(browser, address) {
  const page = await browser.open(address, { scripts: false });
  const { root } = await page.send("DOM.getDocument", { depth: 0 });
  const { outerHTML } = await page.send("DOM.getOuterHTML", { nodeId: root.nodeId });
  const body = outerHTML.slice(outerHTML.indexOf("<main"), outerHTML.indexOf("</main>"));
  for (const text of ["Fail", "Governing: ", ">988<", "Largest rope load, dynamic", "Every check, by group and utilisation", "Sample project",
    "indicative", "A sample &amp; nothing else"])
    expect(body.includes(text), `"${text}" is not read without scripts`);
  await page.close();
}

async function testNarrow(browser, address) {
  const page = await browser.open(address, { width: 400 });
  const wide = await page.value("document.scrollingElement.scrollWidth");
  expect(wide <= 400, `the page is ${wide} px wide in a window of 400 px`);
  await page.close();
}

async function testReading(browser, address, axe) {
  for (const dark of [false, true]) {
    const page = await browser.open(address, { dark });
    const luminance = await page.value(`(getComputedStyle(document.documentElement).getPropertyValue("--paper"))`);
    expect(dark === (Number.parseInt(luminance.slice(1, 3), 16) < 128), `the ${dark ? "dark" : "light"} page stands on ${luminance}`);
    await page.value(axe);
    const violations = await page.value("axe.run().then((result) => result.violations.map((one) => "
      + "`${one.id}: ${one.help}: ${one.nodes.slice(0, 3).map((node) => node.html.slice(0, 160)).join(' | ')}`))");
    for (const violation of violations) failures.push(`${dark ? "dark" : "light"}: ${violation}`);
    await page.close();
  }
}

async function testWheel(browser, address) {
  const page = await browser.open(address);
  const place = await page.value(`(() => {
    document.documentElement.style.scrollBehavior = "auto";
    const canvas = document.querySelector(".stage-view canvas");
    if (!canvas) return null;
    canvas.scrollIntoView({ block: "center" });
    const { left, top, width, height } = canvas.getBoundingClientRect();
    return { x: left + width / 2, y: top + height / 2 };
  })()`);
  if (!place) return;  // without WebGL there is no drawing to turn
  const turned = async () => {
    const before = await page.value("scrollY");
    await page.send("Input.dispatchMouseEvent", { type: "mouseWheel", ...place, deltaX: 0, deltaY: 120 });
    await page.value("new Promise((done) => setTimeout(done, 400))");
    return await page.value("scrollY") - before;
  };
  expect(await turned() > 50, "the wheel does not move the page over a drawing without the focus");
  await page.value(`document.querySelector(".stage-view canvas").focus({ preventScroll: true })`);
  expect(Math.abs(await turned()) < 1, "the wheel moves the page over a drawing that has the focus");
  await page.close();
}

async function testFiles(browser, address) {
  const page = await browser.open(address);
  const { tables, without, plots, bare } = await page.value(`(() => {
    const tables = [...document.querySelectorAll("main table")];
    const plots = [...document.querySelectorAll("main .tile, main #histories")];
    return { tables: tables.length, without: tables.filter((one) => !one.querySelector(".csv")).length,
      plots: plots.length, bare: plots.filter((one) => !one.querySelector(".copy.svg")).length };
  })()`);
  expect(tables > 5 && without === 0, `${without} of ${tables} tables cannot be saved as CSV`);
  expect(plots > 2 && bare === 0, `${bare} of ${plots} plots cannot be saved as SVG`);
  const saved = (button) => page.value(`new Promise((done) => {
    URL.createObjectURL = (blob) => { blob.text().then(done); return "data:,"; };
    HTMLAnchorElement.prototype.click = () => {};
    document.querySelector(${JSON.stringify(button)}).click();
  })`);
  const csv = await saved("#checks .csv");
  expect(/^\ufeff?Check,Demand,Limit,Unit/.test(csv) && csv.includes(",988,"), `the checks as CSV are ${csv.slice(0, 200)}`);
  const drawing = await saved("#histories .copy.svg");
  expect(/^<\?xml/.test(drawing) && drawing.includes("http://www.w3.org/2000/svg") && drawing.includes("<path"), "the plot as SVG is none");
  await page.close();
}

await testInBrowser(async (browser, folder, complain) => {
  expect = (holds, text) => { if (!holds) complain(text); };
  execFileSync(process.argv[2], [folder]);
  const address = `file://${join(folder, "whole", "report.html")}`;
  await testPrint(browser, address);
  await testPaperPlot(browser, address);
  await testHoists(browser, address);
  await testWithoutScripts(browser, address);
  await testNarrow(browser, address);
  await testReading(browser, address, readFileSync(join(process.argv[3], "axe.min.js"), "utf8"));
  await testWheel(browser, address);
  await testFiles(browser, address);
}, "the sample report is a document");
