// Small helpers that make elements.
import { saveTable, tableLines } from "./download";

export type Child = Node | string | null | undefined | false | Child[];
type Attributes = Record<string, string | number | boolean | null | undefined | ((event: any) => void)>;

export function h(tag: string, attributes: Attributes = {}, ...children: Child[]): HTMLElement {
  const element = document.createElement(tag);
  setAttributes(element, attributes);
  append(element, children);
  return element;
}

export function svg(tag: string, attributes: Attributes = {}, ...children: Child[]): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  setAttributes(element, attributes);
  append(element, children);
  return element;
}

function setAttributes(element: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) element.setAttribute(name, String(value));
  }
}

export function append(parent: Node, children: Child[]): void {
  for (const child of children) {
    if (Array.isArray(child)) append(parent, child);
    else if (child) parent.appendChild(typeof child === "string" ? document.createTextNode(child) : child);
  }
}

export interface Column { head: Child; align?: "left" | "right" | "centre"; title?: string }

/** A table that can be copied as tab-separated text and saved as CSV. */
export function table(caption: string, columns: Column[], rows: Child[][], className = ""): HTMLElement {
  const align = (column: number): string => columns[column].align ?? "right";
  const body = h("table", { class: className },
    h("caption", {}, h("span", {}, caption)),
    h("thead", {}, h("tr", {}, columns.map((column, i) => column.head === ""
      ? h("td", { class: align(i) }) : h("th", { scope: "col", class: align(i), title: column.title }, column.head)))),
    h("tbody", {}, rows.map((row) => h("tr", {}, row.map((cell, i) =>
      i === 0 && cell !== "" ? h("th", { scope: "row", class: align(i) }, cell) : h("td", { class: align(i) }, cell))))));
  const element = h("div", { class: "table" }, body);
  equip(element);
  return element;
}

/** Gives a table of the page its buttons, and the keyboard a way to scroll it where it is too wide. */
export function equip(element: HTMLElement): void {
  const body = element.querySelector("table")!;
  const caption = body.caption!;
  const name = caption.textContent ?? "";
  caption.append(h("button", { class: "copy", type: "button", title: "Copy this table, for a "
    + "spreadsheet", "aria-label": `Copy: ${name}`,
    onclick: (event: MouseEvent) => copyTable(body, event.currentTarget as HTMLButtonElement) }, "copy"),
  h("button", { class: "copy csv", type: "button", title: "Save this table as CSV", "aria-label": `Save as CSV: ${name}`,
    onclick: () => saveTable(body, name) }, "CSV"));
  new ResizeObserver(() => {
    if (element.scrollWidth > element.clientWidth) element.tabIndex = 0;
    else element.removeAttribute("tabindex");
  }).observe(element);
}

function copyTable(element: HTMLTableElement, button: HTMLButtonElement): void {
  const text = tableLines(element, (cells) => cells.join("\t"));
  const done = (): void => {
    button.textContent = "copied";
    setTimeout(() => { button.textContent = "copy"; }, 1500);
  };
  const byHand = (): void => {  // pages opened from a disk may lack the clipboard interface
    const area = h("textarea", { class: "off-screen" }) as HTMLTextAreaElement;
    area.value = text;
    document.body.appendChild(area);
    area.select();
    document.execCommand("copy");
    area.remove();
    button.focus();
    done();
  };
  if (navigator.clipboard) navigator.clipboard.writeText(text).then(done, byHand);
  else byHand();
}

/** One of several, as a row of buttons; keyboard and screen readers see radio buttons. */
export function choice<T extends string>(
  label: string, options: [T, string][], chosen: T, change: (value: T) => void): { element: HTMLElement; set: (value: T) => void } {
  const name = `choice-${++choiceCount}`;
  const inputs = new Map<T, HTMLInputElement>();
  const element = h("fieldset", { class: "choice" }, h("legend", {}, label), options.map(([value, text]) => {
    const input = h("input", {
      type: "radio", name, value, checked: value === chosen, onchange: () => change(value),
    }) as HTMLInputElement;
    inputs.set(value, input);
    return h("label", {}, input, h("span", {}, text));
  }));
  return { element, set: (value) => { const input = inputs.get(value); if (input) input.checked = true; } };
}
let choiceCount = 0;

export function checkbox(text: string, checked: boolean, change: (checked: boolean) => void): HTMLElement {
  const input = h("input", { type: "checkbox", checked, onchange: () => change(input.checked) }) as HTMLInputElement;
  return h("label", { class: "checkbox" }, input, text);
}

export function slider(
  label: string, from: number, to: number, step: number | "any", value: number, input: (value: number) => void): HTMLInputElement {
  const element = h("input", {
    type: "range", min: from, max: to, step, "aria-label": label, title: label,
    oninput: () => input(Number(element.value)),
  }) as HTMLInputElement;
  element.value = String(value);
  return element;
}
