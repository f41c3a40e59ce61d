// What the program puts into the page; the twin of pipeline/report/page_data.h. SI units throughout.

export type State = "static" | "dynamic";
export type Way = "simultaneous" | "per_rope_maxima" | "history";
export const states: State[] = ["static", "dynamic"];
type Maybe<T> = T | null | undefined;

export interface Packed { type: "f32" | "u16" | "i16" | "u32"; data: string; scale?: number; absent?: number }

export interface PackedSeries {
  name: string; quantity: string; units: string; description: string; time: Packed; values: Packed;
}
export interface History {
  start: number; end: number; samples: number;
  ropes: PackedSeries[]; hoists: PackedSeries[]; drives: PackedSeries[]; energy: PackedSeries[];
  measures?: PackedSeries[];
}
export interface Motion { time: Packed; bodies: Record<string, Packed> }
export interface Stage { name: string; start: number; end: number }
export interface Scene {
  load: string;
  bodies: { name: string; kind: string; boxes: number[][] }[];
  ropes: { name: string; kind: string; bodies: string[]; points: number[][] }[];
  lugs: { name: string; point: number[] }[];
}
export interface Field {
  von_mises: Packed; displacement: Packed; rope?: string; time?: number;
  peak_stress_point?: number[]; checked_stress_point?: number[]; max_displacement_point?: number[];
}
export interface Surface {
  points?: Packed; quads?: Packed; quad_group?: Packed; groups?: string[];
  fields?: Partial<Record<Way, Partial<Record<State, Field>>>>; note?: string;
}

export interface Check {
  name: string; demand?: Maybe<number>; limit?: Maybe<number>; unit?: string; utilisation?: Maybe<number>;
  pass: boolean; time_s?: Maybe<number>; note?: string;
}
export interface LoadMaxima {
  name: string; lug?: string; hoist?: string; crane?: string;
  breaking_load_N?: Maybe<number>; bend_efficiency?: Maybe<number>; largest_strain?: Maybe<number>; capacity_N?: Maybe<number>; max_swing_rad?: Maybe<number>;
  max_static_tension_N?: Maybe<number>; max_dynamic_tension_N?: Maybe<number>;
  max_static_load_N?: Maybe<number>; max_dynamic_load_N?: Maybe<number>;
  time_of_max_static_s?: Maybe<number>; time_of_max_dynamic_s?: Maybe<number>;
  dynamic_over_static?: Maybe<number>;
  linked_static_N?: Record<string, Maybe<number>>; linked_dynamic_N?: Record<string, Maybe<number>>;
}
/** The loads of one stage of the operation. */
export interface StageLoads {
  name: string; start_s?: number; end_s?: number; condition_met_s?: number; ropes?: LoadMaxima[]; hoists?: LoadMaxima[]; load?: LoadMaxima;
}
/** A figure that follows from the motion, where it is furthest out. */
export interface Measure {
  name: string; subject: string; kind: string; unit: string; extreme?: string; meaning?: string;
  static?: Maybe<number>; time_of_static_s?: Maybe<number>; dynamic?: Maybe<number>; time_of_dynamic_s?: Maybe<number>;
}
/** The lift at rest with slings of some lengths. */
export interface SlingState {
  tensions_N?: Record<string, Maybe<number>>; tilt_rad?: Maybe<number>; trim_rad?: Maybe<number>; list_rad?: Maybe<number>;
}
export interface SlingLengths {
  tolerance?: number; time_s?: number; trouble?: string; lengths_m?: Record<string, number>; meant?: SlingState;
  errors?: { sling: string; longer: SlingState; shorter: SlingState }[];
  worst?: { tensions_N?: Record<string, Maybe<number>>; tilt_rad?: Maybe<number> };
  level?: SlingState & { lengths_m?: Record<string, number> };
}
export interface StructureState {
  checked_von_mises_Pa?: Maybe<number>; peak_von_mises_Pa?: Maybe<number>; max_displacement_m?: Maybe<number>;
  force_residual?: Maybe<number>; moment_residual?: Maybe<number>; reaction_over_weight?: Maybe<number>;
  rope?: string; time_s?: Maybe<number>; checked_group?: string; peak_group?: string;
  checked_point_m?: number[]; peak_point_m?: number[]; max_displacement_point_m?: number[];
}
export interface StructureWay {
  rope?: string; static?: StructureState; dynamic?: StructureState;
  stress_increase_percent?: Maybe<number>; deformation_increase_percent?: Maybe<number>;
}
export interface Practice {
  safe?: boolean; largest_difference_percent?: Maybe<number>; worst_difference_percent?: Maybe<number>;
  worst_part?: string; worst_point_m?: number[]; worst_envelope_Pa?: Maybe<number>; share_of_patches_short?: Maybe<number>;
}
export interface StructureHistory extends StructureWay {
  static?: StructureState & { instants?: number; rope_share?: number; field_von_mises_Pa?: Maybe<number> };
  dynamic?: StructureState & { instants?: number; rope_share?: number; field_von_mises_Pa?: Maybe<number> };
  places?: number; practice?: { per_rope_maxima?: Practice; rope_instants?: Practice };
  fatigue?: { curve?: string; source?: string; stress_concentration?: number; lifts?: number };
  points?: {
    name: string; part?: string; point_m?: number[]; max_static_von_mises_Pa?: Maybe<number>;
    max_dynamic_von_mises_Pa?: Maybe<number>; cycles_per_lift?: Maybe<number>; largest_range_Pa?: Maybe<number>;
    damage_per_lift?: Maybe<number>; damage?: Maybe<number>;
  }[];
}
interface LugStress {
  static_checked_von_mises_Pa?: Maybe<number>; dynamic_checked_von_mises_Pa?: Maybe<number>;
  stress_increase_percent?: Maybe<number>;
}
export interface Buckling {
  panels_looked_at?: number;
  panels?: {
    plate: string; centre_m?: number[]; field_m?: number[]; thickness_m?: number; free_edges?: number; free_edges_along_sides?: number[];
    s11_Pa?: number; s22_Pa?: number; s12_Pa?: number; s11_gradient_Pa?: number; s22_gradient_Pa?: number;
    utilisation?: Maybe<number>; elastic_utilisation?: Maybe<number>; state?: string; time_s?: Maybe<number>;
  }[];
  bars_looked_at?: number; bar_factor?: Maybe<number>;
  bars?: {
    bar: string; from_m?: number[]; to_m?: number[]; plate_width_m?: number; buckling_length_m?: number; compression_N?: Maybe<number>; moments_Nm?: number[];
    buckling_resistance_N?: Maybe<number>; utilisation?: Maybe<number>; state?: string; time_s?: Maybe<number>;
    tripping_length_m?: number; tripping_strength_Pa?: Maybe<number>; tripping_compression_Pa?: Maybe<number>; tripping_utilisation?: Maybe<number>;
  }[];
}
export interface PadeyeSummary {
  lug: string; rope?: string; padeye?: string; consequence_factor?: number; unknowns?: number; governing_state?: number; file?: string;
  formulas?: {
    name: string; demand?: Maybe<number>; limit?: Maybe<number>; unit?: string; utilisation?: Maybe<number>; pass?: boolean;
    source?: string; time_s?: Maybe<number>;
  }[];
  states?: {
    name: string; time_s?: Maybe<number>; force_N?: number[]; main_plate_checked_von_mises_Pa?: Maybe<number>;
    cheeks_checked_von_mises_Pa?: Maybe<number>; peak_von_mises_Pa?: Maybe<number>; force_residual?: Maybe<number>;
  }[];
}
/** Side view of a padeye: four corners (x, y a corner, m) and the stress of each column of elements. */
export interface PadeyePicture {
  lug: string; state: string; rope: string; time?: number; force: number[]; plate: number[]; von_mises: number[]; corners: number[][];
}
export interface AccuracyStep {
  unknowns?: number; elements?: number; smallest_edge_m?: Maybe<number>;
  static_checked_von_mises_Pa?: Maybe<number>; dynamic_checked_von_mises_Pa?: Maybe<number>; stress_increase_percent?: Maybe<number>;
}
/** The block in one stage of the operation. */
export interface StageStress {
  name: string; start_s?: number; end_s?: number; static_checked_von_mises?: TimedStress; dynamic_checked_von_mises?: TimedStress;
  stress_increase_percent?: Maybe<number>;
}
export interface TimedStress {
  value?: Maybe<number>; time_s?: number; point_m?: number[]; part?: string;
}
export interface CheckedAccuracy {
  asked?: number; is_reached?: boolean; stress_change?: Maybe<number>; increase_change_percent?: Maybe<number>; steps?: AccuracyStep[];
}
export interface Structure {
  accuracy?: CheckedAccuracy;
  unknowns?: number; elements?: number; element_degree?: number; mesh_size_m?: number;
  material?: string; yield_Pa?: Maybe<number>;
  per_rope_maxima?: StructureWay; simultaneous?: StructureWay; history?: StructureHistory; simultaneous_by_rope?: StructureWay[];
  stages?: StageStress[]; padeyes?: PadeyeSummary[]; buckling?: Buckling; load_table?: unknown;
  estimated_error?: { relative?: Maybe<number>; worst_part?: string; worst_point_m?: number[] };
  lugs?: { name: string; rope?: string; simultaneous?: LugStress; per_rope_maxima?: LugStress }[];
  mass?: {
    total_kg?: Maybe<number>; steel_kg?: Maybe<number>; outfitting_kg?: Maybe<number>;
    centre_of_mass_m?: number[]; steel_centre_of_mass_m?: number[];
  };
}
export interface Comparison {
  source?: string; stress_increase_percent?: Maybe<number>; deformation_increase_percent?: Maybe<number>;
  ropes?: {
    name: string; published_static_N?: Maybe<number>; published_dynamic_N?: Maybe<number>;
    static_difference_percent?: Maybe<number>; dynamic_difference_percent?: Maybe<number>;
  }[];
  series?: {
    name: string; points?: number; mean_difference_percent?: Maybe<number>; largest_difference_percent?: Maybe<number>;
    time_of_largest_s?: Maybe<number>;
  }[];
}
export interface NaturalMode {
  name: string; kind: string; period_s?: Maybe<number>; frequency_Hz?: Maybe<number>; damping_ratio?: Maybe<number>;
  elastic_share?: Maybe<number>; energy_share_by_body?: Record<string, number>;
  /** What of those shares bodies have by vibrating, not by moving as a whole. */
  energy_share_by_elastic_mode?: Record<string, number>;
  /** Of one that grows: the wind turns a load that nothing holds. */
  turned_by_wind?: boolean;
}
export interface ModeShapes { time: number; bodies: Record<string, Packed> }
export interface ChainStep {
  name: string; kind: "load" | "factor" | "result" | "told"; unit: string; standard?: Maybe<number>; simulated?: Maybe<number>;
  clause?: string; formula?: string;
}
export interface Chain {
  name: string; kind: string; unit: string; standard?: Maybe<number>; simulated?: Maybe<number>;
  limit?: Maybe<number>; simulated_limit?: Maybe<number>; limit_text?: string; limit_clause?: string;
  standard_utilisation?: Maybe<number>; simulated_utilisation?: Maybe<number>; pass?: boolean; steps: ChainStep[];
}
export interface Standard {
  name: string; title?: string; edition?: string; source?: string; notes?: string[]; governing?: string; chains: Chain[];
}
export interface TriedInstant { time_s?: number; rope: string; share?: Maybe<number>; peak_time_s?: number }
export interface WorstInstant extends TriedInstant { undisturbed?: TriedInstant; tried?: TriedInstant[] }
export interface Summary {
  sling_lengths?: SlingLengths;
  standard?: Maybe<Standard>;
  verdict?: string; verdict_reasons?: string[]; checks?: Check[];
  ropes?: LoadMaxima[]; hoists?: LoadMaxima[]; cranes?: LoadMaxima[]; loops?: LoadMaxima[];
  stages?: StageLoads[]; measures?: Measure[]; worst_instant?: Maybe<WorstInstant>;
  comparison?: Maybe<Comparison>; structure?: Maybe<Structure>;
  natural_periods?: { instant: string; time_s: number; modes: NaturalMode[] }[];
  energy?: Maybe<{ largest_energy_J?: number; largest_imbalance_J?: number; relative_imbalance?: number }>;
  solver?: Maybe<Record<string, unknown>>; timing?: Maybe<Record<string, unknown>>;
  assumptions?: string[]; warnings?: string[]; files?: { name: string; content: string }[];
}
export interface PageData {
  summary: Summary;
  case: { name: string; title: string; created: string; program_version: string; yaml: string };
  stages: Stage[];
  histories: Record<State, History | null>;
  motion: Record<State, Motion | null>;
  outputs?: PackedSeries[];
  measured?: PackedSeries[];
  modes: ModeShapes[];
  scene: Scene | null;
  surface: Surface | null;
  padeyes?: PadeyePicture[];
}

export function readPageData(): PageData {
  const element = document.getElementById("data")!;
  const data = JSON.parse(element.textContent!) as PageData;
  element.textContent = "";  // the text would keep megabytes alive
  return data;
}

function bytesOf(text: string): ArrayBuffer {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  return bytes.buffer;
}

/** Numbers of a packed array, scaled back to their units; NaN where there is none. */
export function unpack(array: Packed): Float32Array {
  const buffer = bytesOf(array.data);
  if (array.type === "f32" && array.scale === undefined) return new Float32Array(buffer);
  const source = array.type === "f32" ? new Float32Array(buffer)
    : array.type === "u16" ? new Uint16Array(buffer)
    : array.type === "i16" ? new Int16Array(buffer) : new Uint32Array(buffer);
  const scale = array.scale ?? 1;
  return Float32Array.from(source, (value) => value === array.absent ? NaN : value * scale);
}

/** Indices of a packed array, exact. */
export function unpackIndices(array: Packed): Uint32Array {
  const buffer = bytesOf(array.data);
  return array.type === "u16" ? Uint32Array.from(new Uint16Array(buffer)) : new Uint32Array(buffer);
}

/** A series in memory, with linear interpolation between its samples. */
export class Series {
  readonly time: Float32Array;
  readonly values: Float32Array;
  constructor(packed: PackedSeries) {
    this.time = unpack(packed.time);
    this.values = unpack(packed.values);
  }

  at(time: number): number {
    const { time: t, values: v } = this;
    if (t.length === 0 || time < t[0] - 1e-3 || time > t[t.length - 1] + 1e-3) return NaN;
    const [low, share] = locate(t, time);
    return low + 1 < t.length ? v[low] + share * (v[low + 1] - v[low]) : v[low];
  }
}

/** The sample at or before `time`, and how far towards the next one it lies (0 to 1). */
export function locate(times: Float32Array, time: number): [number, number] {
  let low = 0;
  let high = times.length - 1;
  if (time <= times[0] || high === 0) return [0, 0];
  if (time >= times[high]) return [high - 1, 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle; else high = middle;
  }
  const step = times[high] - times[low];
  return [low, step > 0 ? (time - times[low]) / step : 0];
}

export function known(value: unknown): value is number {
  return typeof value === "number" && Number.isFinite(value);
}

/** The stage of an instant, as the tables have it: a pause belongs to the stage that it stands before, the end to the last. */
export function stageAt(stages: Stage[], time: number): string {
  return (stages.find((one) => time <= one.end) ?? stages[stages.length - 1])?.name ?? "";
}
