// Opens the pages of sample comparisons in a headless Chromium, without a network: tables, curves and drawings are there.
//   node comparison_page_test.mjs WRITE_SAMPLE_COMPARISON
// Exit code 77 (skipped) where there is no Chromium.
import { execFileSync } from "node:child_process";
import { join } from "node:path";
import { testInBrowser } from "../report/browser.mjs";

const words = (selector) => `[...document.querySelectorAll(${JSON.stringify(selector)})].map((one) => one.textContent.trim()).join("; ")`;
const firstCaption = 'document.querySelector(".frame .words").textContent';
const fits = ["document.documentElement.scrollWidth <= window.innerWidth", true];

/** How many colours stand in a pane of the drawing: a block that is drawn has many, an empty place one. */
const coloursIn = (pane, count) => `(() => {
  const canvas = document.querySelector(".viewer canvas");
  const frame = document.querySelectorAll(".frame")[${pane}];
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [200, 200];
  const scale = canvas.width / canvas.clientWidth;
  copy.getContext("2d").drawImage(canvas, frame.offsetLeft * scale, frame.offsetTop * scale, frame.offsetWidth * scale, frame.offsetHeight * scale, 0, 0, 200, 200);
  const pixels = new Uint32Array(copy.getContext("2d").getImageData(0, 0, 200, 200).data.buffer);
  return new Set(pixels).size > ${count};
})()`;
const choose = (value) => `document.querySelector('input[value="${value}"]').click() ?? new Promise((done) => setTimeout(done, 200))`;

await testInBrowser(async (browser, folder, complain) => {
  execFileSync(process.argv[2], [folder]);
  const page = await browser.open(`file://${join(folder, "comparison.html")}`);
  await page.expect(complain, {
    "the page has drawn itself": ["document.body.classList.contains('ready')", true],
    "tables": ["document.querySelectorAll('table').length", 3],
    "drawings, one a rope": ["document.querySelectorAll('svg.paper').length", 2],
    "curves, two a rope": ["document.querySelectorAll('svg.paper path').length", 4],
    "the key that differs is named": ["document.body.innerText.includes('settle')", true],
    "blocks that are not there": [words("#block"), "There are no pictures: none of the results holds a block's stresses."],
    "the page fits its window": fits,
  });
  await page.close();

  const blocks = `file://${join(folder, "blocks.html")}`;
  for (const width of [1280, 400])
    for (const dark of [false, true]) {
      const drawn = await browser.open(blocks, { width, dark });
      const expect = (what) => drawn.expect((text) => complain(`${width} px, ${dark ? "dark" : "light"}: ${text}`), what);
      await expect({
        "the page has drawn itself": ["document.body.classList.contains('ready')", true],
        "drawings of three blocks and two differences": [words(".frame b"),
          "coarse, in motion; fine, in motion; other, in motion; fine \u2212 coarse, in motion; other \u2212 coarse, in motion"],
        "one canvas, which turns all": ["document.querySelectorAll('.viewer canvas').length", 1],
        "a part without a counterpart is named": ["document.body.innerText.includes('grey where the difference is drawn: wall.')", true],
        "the table of checked stress": ["[...document.querySelectorAll('caption')].some((one) => one.innerText.includes('Largest checked stress of each plate'))", true],
        "the page fits its window": fits,
      });
      for (let pane = 0; pane < 5; ++pane) await expect({ [`colours of drawing ${pane}`]: [coloursIn(pane, 30), true] });
      await drawn.value(choose("displacement"));
      await expect({ "deformation, largest at the farthest corner, 1.25 mm a metre": [firstCaption, "coarse, in motionlargest 11.2 mm"] });
      await drawn.value(choose("static"));
      await expect({ "at rest, 1 mm a metre": [firstCaption, "coarse, at restlargest 8.94 mm"] });
      await drawn.close();
    }

  const plain = await browser.open(blocks, { scripts: false });
  const { root } = await plain.send("DOM.getDocument", { depth: 0 });
  const { outerHTML } = await plain.send("DOM.getOuterHTML", { nodeId: root.nodeId });
  const body = outerHTML.slice(outerHTML.indexOf("<main"), outerHTML.indexOf("</main>"));
  for (const text of ["Largest checked stress of each plate", ">deck at z = 0 m<", ">137.50<", ">+12.50<", "grey where the difference is drawn: wall."])
    if (!body.includes(text)) complain(`"${text}" is not read without scripts`);
  await plain.close();
}, "the sample comparisons draw themselves");
