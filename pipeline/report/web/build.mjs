// Bundles the pages and writes them as a C++ source that defines report_page(), comparison_page_template() and
// curves_page_template(), and the licences of what is bundled.
//   node build.mjs report_page.cc notice.txt
import { readFileSync, writeFileSync } from "node:fs";
import { build } from "esbuild";

const common = { bundle: true, minify: true, write: false, target: "es2020", charset: "utf8", legalComments: "eof" };
const bundle = async (entry) => (await build({ ...common, entryPoints: [entry], format: "iife" })).outputFiles[0].text;
const style = (await build({ ...common, entryPoints: ["src/style.css"] })).outputFiles[0].text;

// A "</script" inside a string of the bundle would end the element that holds it.
const fill = (text, mark, content) => {
  const parts = text.split(mark);
  if (parts.length !== 2) throw new Error(`a page must hold ${mark} exactly once`);
  return parts[0] + content + parts[1];
};

// What is in the page beside our own: the libraries that package.json depends on.
const libraries = Object.keys(JSON.parse(readFileSync("package.json", "utf8")).dependencies).map((name) => {
  const { version, license, homepage } = JSON.parse(readFileSync(`node_modules/${name}/package.json`, "utf8"));
  return { name, version, license, homepage, text: readFileSync(`node_modules/${name}/LICENSE`, "utf8").trim() };
});
const listed = (some) => some.map(({ name, version, license }) => `${name} ${version} (${license} licence)`).join(" and ");
// A page with script, style and licences in it, and its marks left for the program, which fills them in this order.
const makePage = async (html, entry, marks, draws) => {
  const script = await bundle(entry);
  let page = readFileSync(html, "utf8");
  page = fill(page, "%LICENCES%", `Made by Blocklift (GPL-3.0-or-later), which is free software without any warranty.${draws}`);
  for (const mark of marks) fill(page, mark, "");
  page = fill(page, "%STYLE%", style.replaceAll("</style", "<\\/style"));
  page = fill(page, "%SCRIPT%", script.replaceAll("</script", "<\\/script").replaceAll("<!--", "\\x3c!--"));
  const places = marks.map((mark) => page.indexOf(mark));
  if (places.some((place, i) => i > 0 && place < places[i - 1])) throw new Error(`the page must hold ${marks.join(", ")} in this order`);
  if (marks.some((mark) => script.includes(mark) || style.includes(mark))) throw new Error("script or style hold a placeholder");
  return page;
};
const report = await makePage("src/page.html", "src/main.ts", ["%TITLE%", "%MARGINS%", "%FRONT%", "%CHECKS%", "%ANNEX%", "%DATA%"],
  ` This page draws with ${listed(libraries)}.`);
const ofCurves = ["%TITLE%", "%HEADING%", "%CONTENT%", "%DATA%"];
const comparison = await makePage("src/comparison.html", "src/comparison.ts", ofCurves,
  ` This page draws with ${listed(libraries.filter(({ name }) => name === "three"))}.`);
const curves = await makePage("src/comparison.html", "src/curves_page.ts", ofCurves, "");

// Octal escapes: unlike hexadecimal ones they end after three digits.
const literal = (bytes) => {
  let text = "";
  for (const byte of bytes) {
    const letter = String.fromCharCode(byte);
    const plain = byte >= 32 && byte < 127 && letter !== '"' && letter !== "\\" && letter !== "?";
    text += plain ? letter : "\\" + byte.toString(8).padStart(3, "0");
  }
  return `"${text}"`;
};
const lines = (page) => {
  const bytes = Buffer.from(page, "utf8");
  const texts = [];
  for (let at = 0; at < bytes.length; at += 4096) texts.push("    " + literal(bytes.subarray(at, at + 4096)));
  return texts.join("\n");
};
writeFileSync(
  process.argv[2],
  `// Generated from pipeline/report/web.
#include "pipeline/report/report_page.h"

namespace blocklift::pipeline {
namespace {
constexpr char report_html[] =
${lines(report)};
constexpr char comparison_html[] =
${lines(comparison)};
constexpr char curves_html[] =
${lines(curves)};
}  // namespace

std::string_view report_page() { return {report_html, sizeof(report_html) - 1}; }
std::string_view comparison_page_template() { return {comparison_html, sizeof(comparison_html) - 1}; }
std::string_view curves_page_template() { return {curves_html, sizeof(curves_html) - 1}; }

}  // namespace blocklift::pipeline
`,
);

writeFileSync(
  process.argv[3],
  "Reports hold these libraries.\n" +
    libraries.map(({ name, version, homepage, text }) => `\n== ${name} ${version}, ${homepage ?? ""}\n\n${text}\n`).join(""),
);
