// Tables as CSV and drawings as SVG, made in the page and saved by the browser.
import { h } from "./dom";

function save(name: string, type: string, text: string): void {
  const address = URL.createObjectURL(new Blob([text], { type }));
  const link = h("a", { href: address, download: name, hidden: true });
  document.body.appendChild(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

const fileName = (title: string, ending: string): string =>
  `${title.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "").slice(0, 60) || "blocklift"}.${ending}`;

/** The text of a cell: notes apart, thousands together, a plain minus, so that programs read numbers. */
function cellText(cell: HTMLTableCellElement): string {
  const copy = cell.cloneNode(true) as HTMLElement;
  for (const note of copy.querySelectorAll(".note")) note.prepend("; ");
  return (copy.textContent ?? "").trim().replace(/\u202f(?=\d{3})/g, "").replace(/\u202f/g, " ").replace(/\u2212/g, "-");
}

export function tableLines(table: HTMLTableElement, join: (cells: string[]) => string): string {
  return [...table.rows].map((row) => join([...row.cells].map(cellText))).join("\n");
}

/** RFC 4180: quotes about what holds a comma, a quote or a line's end. */
export function tableCsv(table: HTMLTableElement): string {
  const field = (text: string): string => (/[",\n\r]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);
  return tableLines(table, (cells) => cells.map(field).join(",")) + "\n";
}

export function saveTable(table: HTMLTableElement, caption: string): void {
  save(fileName(caption, "csv"), "text/csv;charset=utf-8", "\ufeff" + tableCsv(table));
}

export function svgText(drawing: SVGElement): string {
  const copy = drawing.cloneNode(true) as SVGElement;
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.removeAttribute("class");
  const [, , width, height] = (copy.getAttribute("viewBox") ?? "0 0 0 0").split(" ");
  const ground = document.createElementNS("http://www.w3.org/2000/svg", "rect");
  for (const [name, value] of [["width", width], ["height", height], ["fill", "#ffffff"]]) ground.setAttribute(name, value);
  copy.prepend(ground);
  return `<?xml version="1.0" encoding="UTF-8"?>\n${new XMLSerializer().serializeToString(copy)}\n`;
}

/** A button that saves a drawing, as it is when it is pressed. */
export function svgButton(title: string, drawing: () => SVGElement): HTMLElement {
  return h("button", { type: "button", class: "copy svg", "aria-label": `Save ${title} as SVG`, title: "Save this drawing as SVG",
    onclick: () => save(fileName(title, "svg"), "image/svg+xml", svgText(drawing())) }, "SVG");
}
