// The annex: long tables in full, of which the sections show what governs.
import { append, Child, Column, h, table } from "./dom";

const parts: { title: string; content: Child[] }[] = [];

export function addToAnnex(title: string, content: Child): void {
  if (!content) return;
  const part = parts.find((one) => one.title === title);
  if (part) part.content.push(content);
  else parts.push({ title, content: [content] });
}

/** The first rows of a sorted table, and all of it in the annex if there are more. */
export function folded(part: string, caption: string, columns: Column[], rows: Child[][], kept: number, className = ""): Child {
  if (rows.length <= kept + 1) return table(caption, columns, rows, className);
  addToAnnex(part, table(`${caption}: all ${rows.length}`, columns, rows.map((row) => row.map(copied)), className));
  return table(`${caption}: the first ${kept} of ${rows.length}, the rest in the annex`, columns, rows.slice(0, kept), className);
}

/** A cell's own copy: an element stands in one place only. */
function copied(cell: Child): Child {
  if (Array.isArray(cell)) return cell.map(copied);
  return cell instanceof Node ? cell.cloneNode(true) : cell;
}

/** Puts what was collected before what the annex already holds. */
export function fillAnnex(annex: HTMLElement): void {
  const added = h("div", {});
  for (const { title, content } of parts) append(added, [h("h3", {}, title), content]);
  annex.querySelector("h2")!.after(...added.childNodes);
}
