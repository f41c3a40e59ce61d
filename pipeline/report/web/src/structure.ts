// What the loads do to the block: three ways of taking maxima, lugs, balance, masses.
import { addToAnnex, folded } from "./annex";
import { Buckling, CheckedAccuracy, known, PageData, Structure, StructureWay } from "./data";
import { Child, Column, h, table } from "./dom";
import type { Section } from "./section";
import { change, fixed, kilonewtons, megapascals, millimetres, missing, point, scientific, seconds, tonnes } from "./numbers";

const left = (head: string): Column => ({ head, align: "left" });

/** What the last refinement changed, as the error that stands beside the checked stress. */
function accuracyText(accuracy: CheckedAccuracy | undefined): string {
  const steps = accuracy?.steps ?? [];
  if (!accuracy || steps.length === 0) return "";
  if (steps.length === 1) return "one mesh only: how far the stress moves with the mesh is not "
    + "known";
  return `the last of ${steps.length} meshes moved the stress by ${fixed(100 * (accuracy.stress_change ?? 0), 1)}\u202f%, `
    + `the increase by ${fixed(accuracy.increase_change_percent, 1)} points`
    + (accuracy.is_reached ? "" : `: the ${fixed(100 * (accuracy.asked ?? 0), 0)}\u202f% that are asked for are not reached`);
}

/** The published pair belongs to the way in which it was computed: each rope at its own maximum. */
function waysTable(data: PageData, structure: Structure): Child {
  const rows: Child[][] = [];
  const row = (name: Child, way: StructureWay | undefined): void => {
    if (!way) return;
    rows.push([name,
      megapascals(way.static?.checked_von_mises_Pa), megapascals(way.dynamic?.checked_von_mises_Pa), change(way.stress_increase_percent),
      millimetres(way.static?.max_displacement_m), millimetres(way.dynamic?.max_displacement_m), change(way.deformation_increase_percent)]);
  };
  if (structure.history) row(h("b", {}, "The whole lift, every instant"), structure.history);
  row(structure.load_table ? "The loads of the table" : "The worst of the instants of each rope's "
    + "largest load", structure.simultaneous);
  if (!structure.load_table) row("Per-rope maxima, all at once", structure.per_rope_maxima);
  const published = data.summary.comparison;
  if (published && (known(published.stress_increase_percent) || known(published.deformation_increase_percent))) {
    rows.push([h("i", {}, "Published, per-rope maxima"), missing, missing, change(published.stress_increase_percent, 2),
      missing, missing, change(published.deformation_increase_percent, 2)]);
  }
  return [
    table("Checked stress and largest deformation of the block", [left("Loads"),
      { head: "Static, MPa" }, { head: "Dynamic, MPa" }, { head: "Increase" },
      { head: "Static, mm" }, { head: "Dynamic, mm" }, { head: "Increase" }], rows),
    structure.load_table ? null : h("p", { class: "source" },
      "An increase compares the worst instant at rest with the worst in motion, wherever on the "
        + "block each is.")];
}

/** The instants of each rope's largest load, one by one. */
function instantsTable(structure: Structure): Child {
  const ways = structure.simultaneous_by_rope ?? [];
  if (ways.length === 0) return null;
  return table("Checked stress and deformation at the instant of each rope's largest load", [left("Rope"),
    { head: "Static, MPa" }, { head: "Dynamic, MPa" }, { head: "Increase" }, { head: "Static, mm" }, { head: "Dynamic, mm" }, { head: "Increase" }],
  ways.map((way) => [way.rope ?? missing,
    megapascals(way.static?.checked_von_mises_Pa), megapascals(way.dynamic?.checked_von_mises_Pa), change(way.stress_increase_percent),
    millimetres(way.static?.max_displacement_m), millimetres(way.dynamic?.max_displacement_m), change(way.deformation_increase_percent)]));
}

/** Every instant of the lift: the envelope, what simpler practices make of it, and the wear. */
function historyTables(structure: Structure): Child {
  const history = structure.history;
  if (!history) return null;
  const percent = (share: unknown): string => known(share) ? fixed(share * 100, 0) : missing;
  const states = (["static", "dynamic"] as const).filter((state) => history[state]).map((state) => {
    const one = history[state]!;
    return [`${state.charAt(0).toUpperCase()}${state.slice(1)}, ${fixed(one.instants, 0)} instants`,
      megapascals(one.checked_von_mises_Pa), one.checked_group ?? missing, megapascals(one.field_von_mises_Pa), seconds(one.time_s), one.rope ?? missing,
      percent(one.rope_share), megapascals(one.peak_von_mises_Pa), millimetres(one.max_displacement_m)];
  });
  const practices = ([["Every rope at its own largest load, at once", history.practice?.per_rope_maxima],
    ["Only the instants of each rope's largest load", history.practice?.rope_instants]] as const)
    .filter(([, one]) => one).map(([name, one]) => [name, one!.safe ? "yes" : "no", change(one!.largest_difference_percent),
      change(one!.worst_difference_percent), one!.worst_part ?? missing, percent(one!.share_of_patches_short)]);
  const wear = (history.points ?? []).map((one) => [one.name, one.part ?? missing, point(one.point_m),
    megapascals(one.max_static_von_mises_Pa), megapascals(one.max_dynamic_von_mises_Pa), megapascals(one.largest_range_Pa),
    fixed(one.cycles_per_lift, 0), scientific(one.damage_per_lift), scientific(one.damage)]);
  return [
    table("Every instant: the largest stress and deformation of the whole lift", [left("History"), { head: "Checked, MPa" }, left("in"),
      { head: "Away from corners, MPa", title: "largest of the squares that no corner of plates, "
        + "lugs or openings is near" }, { head: "at, s" }, left("Rope"), { head: "its share, %" }, { head: "Raw peak, MPa" }, { head: "Deformation, mm" }], states),
    table("What simpler practices give in its place (negative: too little)", [left("Practice"), left("Safe"),
      { head: "Largest stress" }, { head: "Where it falls short most" }, left("in"), { head: "Plate area short, %",
        title: "of the patches that see at least half of the largest stress, those more than 1 % "
          + "short" }], practices),
    table(`Stress in time and wear, ${history.fatigue?.source ?? ""} curve ${history.fatigue?.curve ?? missing}, ${
      fixed(history.fatigue?.lifts, 0)} ${history.fatigue?.lifts === 1 ? "lift" : "lifts"}`, [left("Place"), left("in"), { head: "at x, y, z" }, { head: "Static, MPa" },
      { head: "Dynamic, MPa" }, { head: "Largest range, MPa" }, { head: "Cycles a lift" }, { head: "Damage a lift" }, { head: "Damage" }], wear)];
}

/** One phase does not hide another: a blow at lifting off says nothing of how the block fares on the hook. */
function stagesTable(structure: Structure): Child {
  const stages = structure.stages ?? [];
  if (stages.length < 2) return null;
  const cells = (one: (typeof stages)[number]["static_checked_von_mises"]): Child[] =>
    [megapascals(one?.value), seconds(one?.time_s), one?.part ?? missing];
  return table("Stage by stage: the largest checked stress at rest and in motion", [left("Stage"),
    { head: "Static, MPa" }, { head: "at, s" }, left("in"), { head: "Dynamic, MPa" }, { head: "at, s" }, left("in"), { head: "more" }],
  stages.map((stage) => [stage.name, ...cells(stage.static_checked_von_mises), ...cells(stage.dynamic_checked_von_mises),
    change(stage.stress_increase_percent)]));
}

function placesTable(structure: Structure): Child {
  const rows: Child[][] = [];
  for (const [name, way] of [["Simultaneous", structure.simultaneous], ["Per-rope maxima", structure.per_rope_maxima],
    ["The whole lift", structure.history]] as const)
    for (const state of ["static", "dynamic"] as const) {
      const one = way?.[state];
      if (!one) continue;
      rows.push([`${name}, ${state}`, one.rope ?? missing, seconds(one.time_s), megapascals(one.peak_von_mises_Pa),
        megapascals(one.checked_von_mises_Pa), one.checked_group ?? missing, point(one.checked_point_m),
        millimetres(one.max_displacement_m), point(one.max_displacement_point_m)]);
    }
  return table("Where it is largest (points in the block's frame, m)", [left("Loads"), left("Rope"), { head: "at, s" },
    { head: "Raw peak, MPa" }, { head: "Checked, MPa" }, left("in"), { head: "at x, y, z" }, { head: "Deformation, mm" },
    { head: "at x, y, z" }], rows);
}

function lugsTable(structure: Structure): Child {
  const lugs = structure.lugs ?? [];
  if (lugs.length === 0) return null;
  const cells = (one: (typeof lugs)[number]["simultaneous"]): Child[] => [
    megapascals(one?.static_checked_von_mises_Pa), megapascals(one?.dynamic_checked_von_mises_Pa), change(one?.stress_increase_percent)];
  return table("Checked stress around each lug", [left("Lug"), left("Rope"),
    { head: "Simultaneous: static, MPa" }, { head: "dynamic, MPa" }, { head: "increase" },
    { head: "Per-rope maxima: static, MPa" }, { head: "dynamic, MPa" }, { head: "increase" }],
  lugs.map((lug) => [lug.name, lug.rope ?? missing, ...cells(lug.simultaneous), ...cells(lug.per_rope_maxima)]));
}

type BuckledPanel = NonNullable<Buckling["panels"]>[number];

/** "1 along 1, 0 along 2": an edge along a side holds its panel up or lies free. */
function freeEdges(panel: BuckledPanel): string {
  const [first, second] = panel.free_edges_along_sides ?? [];
  if (!known(first) || !known(second)) return fixed(panel.free_edges, 0);
  return first + second === 0 ? "none" : [[first, 1], [second, 2]].filter(([count]) => count > 0).map(([count, side]) => `${count} along ${side}`).join(", ");
}

/** What compresses a panel's edges: the mean and its fall to the sides, tension positive. */
function edgeStresses(panel: BuckledPanel): string {
  const edge = (mean: unknown, fall: unknown): string => known(mean) && known(fall) ? megapascals(mean - Math.abs(fall)) : missing;
  return `${edge(panel.s11_Pa, panel.s11_gradient_Pa)}, ${edge(panel.s22_Pa, panel.s22_gradient_Pa)}`;
}

function bucklingTable(structure: Structure): Child {
  const panels = structure.buckling?.panels ?? [];
  if (panels.length === 0) return null;
  return folded("Block", `Panels nearest to buckling, of ${structure.buckling?.panels_looked_at ?? panels.length}, over the whole lift`, [left("Plate"),
    { head: "Centre x, y, z, m" }, { head: "Field, m" }, { head: "thickness, mm" }, { head: "Free edges", align: "left", title: "edges where no plate crosses; the others are simply supported. Side 1 is the field's first length, side 2 its second" },
    { head: "Mean stress 11, 22, 12, MPa", title: "tension positive" }, { head: "At the most "
      + "compressed edge 11, 22, MPa" }, left("State"), { head: "at, s" },
    { head: "Elastic utilisation" }, { head: "Johnson-Ostenfeld" }],
  panels.map((panel) => [panel.plate, point(panel.centre_m), panel.field_m?.map((side) => fixed(side, 2)).join(" x ") ?? missing,
    millimetres(panel.thickness_m), freeEdges(panel), [panel.s11_Pa, panel.s22_Pa, panel.s12_Pa].map(megapascals).join(", "), edgeStresses(panel), panel.state ?? missing,
    seconds(panel.time_s), fixed(panel.elastic_utilisation, 2), fixed(panel.utilisation, 2)]), 4);
}

/** Bars, and stiffeners with their plates, as columns: what they bear over what they may, forces times a factor. */
function barsTable(structure: Structure): Child {
  const buckling = structure.buckling;
  const bars = buckling?.bars ?? [];
  if (bars.length === 0) return null;
  return folded("Block", `Bars and stiffeners as columns: those that bear most of ${buckling?.bars_looked_at ?? bars.length}, over the whole lift`, [left("Bar"),
    { head: "From x, y, z, m" }, { head: "To, m" }, { head: "With plate, mm" }, { head: "Buckling "
      + "length, m" }, { head: "Compression, kN" }, { head: "Moments, kNm" },
    { head: "Buckling load, kN" }, left("State"), { head: "at, s" }, { head: `Utilisation, forces times ${fixed(buckling?.bar_factor, 2)}` }, { head: "Tripping: length, m" }, { head: "compression, MPa" }, { head: "strength, MPa" }, { head: "utilisation" }],
  bars.map((bar) => [bar.bar, point(bar.from_m), point(bar.to_m), bar.plate_width_m ? millimetres(bar.plate_width_m) : missing,
    fixed(bar.buckling_length_m, 2), kilonewtons(bar.compression_N),
    bar.moments_Nm?.map(kilonewtons).join(", ") ?? missing, kilonewtons(bar.buckling_resistance_N), bar.state ?? missing, seconds(bar.time_s),
    fixed(bar.utilisation, 2), fixed(bar.tripping_length_m, 2), megapascals(bar.tripping_compression_Pa), megapascals(bar.tripping_strength_Pa), fixed(bar.tripping_utilisation, 2)]), 4);
}

function balanceTable(structure: Structure): Child {
  const rows: Child[][] = [];
  const row = (name: string, way: StructureWay | undefined): void => {
    for (const state of ["static", "dynamic"] as const) {
      const one = way?.[state];
      if (one) rows.push([`${name}, ${state}`, scientific(one.force_residual), scientific(one.moment_residual), scientific(one.reaction_over_weight)]);
    }
  };
  row("Simultaneous", structure.simultaneous);
  row("Per-rope maxima", structure.per_rope_maxima);
  return table("Balance: what must vanish for a hanging block", [left("Loads"),
    { head: "Force residual / load" }, { head: "Moment residual / load" }, { head: "Support "
      + "reactions / weight" }], rows);
}

/** Mesh after mesh about what governs: by how much the checked stress and its increase still move. */
function accuracyTable(structure: Structure): Child {
  const steps = structure.accuracy?.steps ?? [];
  if (steps.length === 0) return null;
  return [
    table("Checked stress, mesh after mesh", [{ head: "Mesh" }, { head: "Shells and beams" }, { head: "Unknowns" },
      { head: "Smallest element, mm" }, { head: "Static, MPa" }, { head: "Dynamic, MPa" }, { head: "Increase" }],
    steps.map((step, i) => [fixed(i + 1, 0), fixed(step.elements, 0), fixed(step.unknowns, 0), millimetres(step.smallest_edge_m),
      megapascals(step.static_checked_von_mises_Pa), megapascals(step.dynamic_checked_von_mises_Pa), change(step.stress_increase_percent)])),
    h("p", { class: "source" }, accuracyText(structure.accuracy))];
}

function massTable(structure: Structure): Child {
  const mass = structure.mass;
  if (!mass) return null;
  const part = (kilograms: unknown): string =>
    known(kilograms) && known(mass.total_kg) ? fixed(kilograms / mass.total_kg * 100, 1) : missing;
  return table("Mass of the block", [left("Part"), { head: "tonnes" }, { head: "%" }, { head: "Centre x, y, z, m" }], [
    ["Steel of the mesh", tonnes(mass.steel_kg), part(mass.steel_kg), point(mass.steel_centre_of_mass_m)],
    ["Outfitting, spread over the plates", tonnes(mass.outfitting_kg), part(mass.outfitting_kg), missing],
    [h("b", {}, "Total"), tonnes(mass.total_kg), part(mass.total_kg), point(mass.centre_of_mass_m)]]);
}

function modelText(structure: Structure): string {
  const parts: string[] = [];
  if (known(structure.elements)) parts.push(`${fixed(structure.elements, 0)} elements${known(structure.element_degree)
    ? ` of degree ${structure.element_degree}` : ""}`);
  if (known(structure.unknowns)) parts.push(`${fixed(structure.unknowns, 0)} unknowns`);
  if (known(structure.mesh_size_m)) parts.push(`largest element ${fixed(structure.mesh_size_m, 2)} m`);
  if (structure.material) parts.push(structure.material + (known(structure.yield_Pa) ? ` (yield ${megapascals(structure.yield_Pa)} MPa)` : ""));
  const error = structure.estimated_error;
  if (known(error?.relative) && !error!.worst_part) parts.push("bars alone, whose elements hold "
    + "end loads and even loads exactly");
  else if (known(error?.relative)) parts.push(`estimated error of the stress field ${fixed(100 * error!.relative!, 1)}\u202f% in the energy norm, `
    + `most of it in ${error!.worst_part}`);
  return parts.length ? `Model: ${parts.join(", ")}.` : "";
}

export function structureSection(data: PageData): Section | null {
  const structure = data.summary.structure;
  if (!structure) return null;
  addToAnnex("Block", instantsTable(structure));
  addToAnnex("Block", placesTable(structure));
  addToAnnex("Block", balanceTable(structure));
  return {
    id: "structure", title: "Block stress and deformation", short: "Block", content: [
      h("p", { class: "lead" }, (structure.history ? "The whole lift: every instant; what is "
        + "checked and leads the page. " : "")
        + (structure.load_table ? "The loads of the case's table, which has no instants: "
        + "simultaneous and per-rope maxima are the same. "
          : "Simultaneous: the instant of one rope's largest load, every other rope at its value "
            + "then; the "
        + "largest of these instants. Per-rope maxima: every rope at its own largest load, all at "
        + "once. "), modelText(structure)),
      waysTable(data, structure), accuracyTable(structure), historyTables(structure), stagesTable(structure), lugsTable(structure), bucklingTable(structure), barsTable(structure), massTable(structure)],
  };
}
