// Load tables: largest loads, what the other ropes carry at that instant, hoists and cranes.
import { Clock } from "./clock";
import { addToAnnex } from "./annex";
import { known, LoadMaxima, PageData, StageLoads, stageAt, State, states } from "./data";
import { Child, Column, h, table } from "./dom";
import type { Section } from "./section";
import { change, fixed, kilonewtons, missing, ratio, seconds, share, tonnesForce } from "./numbers";

function timeCell(data: PageData, clock: Clock, time: unknown): Child {
  if (!known(time)) return missing;
  if (!data.scene) return seconds(time);
  return h("button", {
    class: "time", type: "button", title: `Show this instant in the drawing (${stageAt(data.stages, time)})`,
    onclick: () => { clock.set(time); document.getElementById("lift")?.scrollIntoView({ behavior: "smooth" }); },
  }, seconds(time));
}

function both(newtons: unknown): Child[] {
  return [kilonewtons(newtons), tonnesForce(newtons)];
}

function ropeTable(data: PageData, clock: Clock): Child {
  const ropes = data.summary.ropes ?? [];
  const timed = ropes.some((rope) => known(rope.time_of_max_dynamic_s));
  const broken = ropes.some((rope) => known(rope.breaking_load_N));
  const lugs = ropes.some((rope) => rope.lug);
  const curved = ropes.some((rope) => known(rope.largest_strain));
  const columns: Column[] = [
    { head: "Rope", align: "left" }, ...(lugs ? [{ head: "Lug", align: "left" } as Column] : []),
    { head: "Static, kN" }, { head: "tonnes" }, ...(timed ? [{ head: "at, s" }, { head: "in stage", align: "left" } as Column] : []),
    { head: "Dynamic, kN" }, { head: "tonnes" }, ...(timed ? [{ head: "at, s" }, { head: "in stage", align: "left" } as Column] : []),
    { head: "Dynamic / static" },
    ...(broken ? [{ head: "Share of breaking load", title: "largest dynamic tension over breaking "
      + "load, less what bends take of it" }] : []),
    ...(curved ? [{ head: "Strain, %", title: "of ropes that stretch by a curve, at the largest "
      + "dynamic tension" }] : []),
  ];
  const instant = (time: unknown): Child[] => timed
    ? [timeCell(data, clock, time), h("span", { class: "stage" }, known(time) ? stageAt(data.stages, time) : missing)] : [];
  const rows = ropes.map((rope) => [
    rope.name, ...(lugs ? [rope.lug ?? missing] : []),
    ...both(rope.max_static_tension_N), ...instant(rope.time_of_max_static_s),
    ...both(rope.max_dynamic_tension_N), ...instant(rope.time_of_max_dynamic_s),
    ratio(rope.dynamic_over_static),
    ...(broken ? [share(known(rope.max_dynamic_tension_N) && known(rope.breaking_load_N)
      ? rope.max_dynamic_tension_N / (rope.breaking_load_N * (rope.bend_efficiency ?? 1)) : null)] : []),
    ...(curved ? [known(rope.largest_strain) ? fixed(100 * rope.largest_strain, 2) : missing] : []),
  ]);
  return table("Largest rope loads", columns, rows);
}

/** Static, dynamic and their ratio of each rope, stage by stage. */
function stageTable(data: PageData): Child {
  const stages = data.summary.stages ?? [];
  if (stages.length < 2 && !stages.some((stage) => known(stage.condition_met_s))) return null;
  const names = [...(stages[0].ropes ?? []).map((rope) => rope.name), ...(stages[0].hoists ?? []).map((hoist) => hoist.name)];
  const columns: Column[] = [{ head: "Stage", align: "left" }, { head: "from, s" }, { head: "to, s" },
    ...names.map((name) => ({ head: name })), { head: "all slings" }];
  const cell = (load: LoadMaxima | undefined): Child => {
    if (!load) return missing;
    const grows = known(load.dynamic_over_static) && (load.max_static_tension_N ?? 0) > 1e3;
    return [tonnesForce(load.max_static_tension_N), h("br", {}), tonnesForce(load.max_dynamic_tension_N),
      h("br", {}), h("span", { class: "stage" }, grows ? change(100 * (load.dynamic_over_static! - 1), 0) : missing)];
  };
  const rows = stages.map((stage) => {
    const loads = [...stage.ropes ?? [], ...stage.hoists ?? []];
    return [stageName(stage), seconds(stage.start_s), seconds(stage.end_s),
      ...names.map((name) => cell(loads.find((load) => load.name === name))), cell(stage.load)];
  });
  const caption = "Stage by stage: largest load at rest and in motion, tonnes, and what motion adds";
  if (names.length <= 8) return table(caption, columns, rows);
  addToAnnex("Loads", table(caption, columns, rows));
  const short = stages.map((stage) => {
    const worst = [...stage.ropes ?? []].sort((a, b) => (b.max_dynamic_tension_N ?? 0) - (a.max_dynamic_tension_N ?? 0))[0];
    return [stageName(stage), seconds(stage.start_s), seconds(stage.end_s), worst?.name ?? missing, ...both3(worst), ...both3(stage.load)];
  });
  return table("Stage by stage: the rope with the largest load, and all slings together (each "
    + "rope: annex)", [
    { head: "Stage", align: "left" }, { head: "from, s" }, { head: "to, s" }, { head: "Rope", align: "left" },
    { head: "Static, tonnes" }, { head: "Dynamic, tonnes" }, { head: "more" },
    { head: "All slings static, tonnes" }, { head: "Dynamic, tonnes" }, { head: "more" }], short);
}

function stageName(stage: StageLoads): Child {
  if (!known(stage.condition_met_s)) return stage.name;
  return [stage.name, h("br", {}), h("span", { class: "stage" }, `its condition at ${seconds(stage.condition_met_s)} s`)];
}

function both3(load: LoadMaxima | undefined): Child[] {
  const grows = known(load?.dynamic_over_static) && (load?.max_static_tension_N ?? 0) > 1e3;
  return [tonnesForce(load?.max_static_tension_N), tonnesForce(load?.max_dynamic_tension_N),
    grows ? change(100 * (load!.dynamic_over_static! - 1), 0) : missing];
}

function comparisonTable(data: PageData): Child {
  const comparison = data.summary.comparison;
  if (!comparison?.ropes?.length) return null;
  const ours = new Map((data.summary.ropes ?? []).map((rope) => [rope.name, rope]));
  const columns: Column[] = [
    { head: "Rope", align: "left" },
    { head: "Static, tonnes" }, { head: "published, tonnes" }, { head: "difference" },
    { head: "Dynamic, tonnes" }, { head: "published, tonnes" }, { head: "difference" },
    { head: "Ratio" }, { head: "published" },
  ];
  const rows = comparison.ropes.map((one) => {
    const rope = ours.get(one.name);
    return [one.name, tonnesForce(rope?.max_static_tension_N), tonnesForce(one.published_static_N), change(one.static_difference_percent),
      tonnesForce(rope?.max_dynamic_tension_N), tonnesForce(one.published_dynamic_N), change(one.dynamic_difference_percent),
      ratio(rope?.dynamic_over_static),
      ratio(known(one.published_dynamic_N) && known(one.published_static_N) ? one.published_dynamic_N / one.published_static_N : null)];
  });
  return [table("Beside published values", columns, rows),
    comparison.source && h("p", { class: "source" }, `Published: ${comparison.source}.`)];
}

function linkedTable(data: PageData, clock: Clock, state: State): Child {
  const ropes = data.summary.ropes ?? [];
  const linked = (rope: LoadMaxima) => (state === "static" ? rope.linked_static_N : rope.linked_dynamic_N);
  if (!ropes.some(linked)) return null;
  const columns: Column[] = [{ head: "Largest in", align: "left" }, { head: "at, s" },
    ...ropes.map((rope) => ({ head: rope.name })), { head: "Sum" }];
  const rows = ropes.map((rope) => {
    const values = ropes.map((other) => linked(rope)?.[other.name]);
    const sum = values.every(known) ? (values as number[]).reduce((total, value) => total + value, 0) : null;
    return [rope.name, timeCell(data, clock, state === "static" ? rope.time_of_max_static_s : rope.time_of_max_dynamic_s),
      ...values.map((value, i) => (ropes[i] === rope ? h("b", {}, kilonewtons(value)) : kilonewtons(value))), kilonewtons(sum)];
  });
  return table(`All ropes at the instant of each rope's largest ${state} load, kN`, columns, rows);
}

function capacityTable(caption: string, head: string, loads: LoadMaxima[] | undefined, data: PageData, clock: Clock): Child {
  if (!loads?.length) return null;
  const swing = loads.some((load) => known(load.max_swing_rad));
  const capacity = loads.some((load) => known(load.capacity_N));
  const columns: Column[] = [{ head, align: "left" }, { head: "Static, kN" }, { head: "tonnes" }, { head: "at, s" },
    { head: "Dynamic, kN" }, { head: "tonnes" }, { head: "at, s" }, { head: "Dynamic / static" },
    ...(capacity ? [{ head: "Capacity, tonnes" }, { head: "Share of capacity" }] : []),
    ...(swing ? [{ head: "Largest swing,\u00a0°" }] : [])];
  const rows = loads.map((load) => {
    const still = load.max_static_tension_N ?? load.max_static_load_N;
    const moving = load.max_dynamic_tension_N ?? load.max_dynamic_load_N;
    return [load.name, ...both(still), timeCell(data, clock, load.time_of_max_static_s),
      ...both(moving), timeCell(data, clock, load.time_of_max_dynamic_s), ratio(load.dynamic_over_static),
      ...(capacity ? [tonnesForce(load.capacity_N),
        share(known(moving) && known(load.capacity_N) ? moving / load.capacity_N : null)] : []),
      ...(swing ? [known(load.max_swing_rad) ? fixed(load.max_swing_rad * 180 / Math.PI, 2) : missing] : [])];
  });
  return table(caption, columns, rows);
}

export function loadsSection(data: PageData, clock: Clock): Section | null {
  if (!data.summary.ropes?.length) return null;
  const moved = data.histories.dynamic !== null;
  for (const state of states) addToAnnex("Loads", linkedTable(data, clock, state));
  return {
    id: "loads", title: "Loads", content: [
      h("p", { class: "lead" }, moved
        ? "Static: equilibrium of the same operation at the same winch lengths and crane "
          + "positions, at rest. Dynamic: the integration in time. Each maximum is over the whole "
          + "operation."
        : "The rope loads were given in the case file; no motion was computed."),
      ropeTable(data, clock), stageTable(data), comparisonTable(data),
      capacityTable("Hoists", "Hoist", data.summary.hoists, data, clock),
      capacityTable("Cranes", "Crane", data.summary.cranes, data, clock),
      capacityTable("Links and equalisers of the cranes", "Link", data.summary.loops, data, clock)],
  };
}
