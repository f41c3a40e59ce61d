// The block's surface as triangles and edges.
import { Surface, unpack, unpackIndices } from "./data";

const sharp = Math.cos((25 * Math.PI) / 180);     // a bend of the surface that is drawn
const straight = Math.cos((15 * Math.PI) / 180);  // of edges in a row beside one that may be a chord of an arc

/** An edge of the surface that one quadrangle has. */
interface Edge { a: number; b: number; quad: number; }

export class BlockSurface {
  readonly points: Float32Array;
  readonly quads: Uint32Array;
  readonly groupOfQuad: Uint32Array;
  readonly groups: string[];
  readonly low: [number, number, number] = [Infinity, Infinity, Infinity];
  readonly high: [number, number, number] = [-Infinity, -Infinity, -Infinity];

  constructor(surface: Surface) {
    this.points = unpack(surface.points!);
    this.quads = unpackIndices(surface.quads!);
    this.groups = surface.groups ?? [];
    this.groupOfQuad = surface.quad_group ? unpackIndices(surface.quad_group) : new Uint32Array(this.quads.length / 4);
    for (let i = 0; i < this.points.length; ++i) {
      this.low[i % 3] = Math.min(this.low[i % 3], this.points[i]);
      this.high[i % 3] = Math.max(this.high[i % 3], this.points[i]);
    }
  }

  get size(): number { return Math.hypot(...[0, 1, 2].map((k) => this.high[k] - this.low[k])); }

  triangles(hidden: Set<number> = new Set()): Uint32Array {
    const triangles: number[] = [];
    const { quads } = this;
    for (let quad = 0; quad < quads.length / 4; ++quad) {
      if (hidden.has(this.groupOfQuad[quad])) continue;
      const [a, b, c, d] = [quads[4 * quad], quads[4 * quad + 1], quads[4 * quad + 2], quads[4 * quad + 3]];
      triangles.push(a, b, c, a, c, d);
    }
    return Uint32Array.from(triangles);
  }

  private normal(quad: number): [number, number, number] {
    const { points, quads } = this;
    const corner = (k: number): number => 3 * quads[4 * quad + k];
    const [a, b, c, d] = [corner(0), corner(1), corner(2), corner(3)];
    const u = [0, 1, 2].map((k) => points[c + k] - points[a + k]);
    const v = [0, 1, 2].map((k) => points[d + k] - points[b + k]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    const size = Math.hypot(...n) || 1;
    return [n[0] / size, n[1] / size, n[2] / size];
  }

  /** Whether the surface bends or changes its group between two quadrangles beside each other. */
  private parts(quad: number, other: number): boolean {
    if (this.groupOfQuad[quad] !== this.groupOfQuad[other]) return true;
    const n = this.normal(quad), m = this.normal(other);
    return n[0] * m[0] + n[1] * m[1] + n[2] * m[2] < sharp;
  }

  /** Edges where the surface bends, ends or changes its group: the outlines of the plates. */
  outlines(hidden: Set<number> = new Set()): Uint32Array {
    const pointCount = this.points.length / 3;
    const first = new Map<number, number>();  // edge -> the quad seen first, or -1 when both are seen
    const lines: number[] = [];
    for (let quad = 0; quad < this.quads.length / 4; ++quad) {
      if (hidden.has(this.groupOfQuad[quad])) continue;
      for (let k = 0; k < 4; ++k) {
        const a = this.quads[4 * quad + k];
        const b = this.quads[4 * quad + ((k + 1) % 4)];
        if (a === b) continue;
        const edge = Math.min(a, b) * pointCount + Math.max(a, b);
        const other = first.get(edge);
        if (other === undefined) { first.set(edge, quad); continue; }
        if (other < 0) continue;
        first.set(edge, -1);
        if (this.parts(quad, other)) lines.push(a, b);
      }
    }
    const ends = [...first].filter(([, quad]) => quad >= 0)
      .map(([edge, quad]): Edge => ({ a: Math.floor(edge / pointCount), b: edge % pointCount, quad }));
    this.dropDivided(ends);
    for (const { a, b } of ends) lines.push(a, b);
    return Uint32Array.from(lines);
  }

  /**
   * Takes out of edges with one quadrangle those where the mesh is divided on one side alone: there the edge of a large
   * quadrangle lies beside shorter ones in a row. Neither is an end of the surface. Where it bends there the short ones stay.
   */
  private dropDivided(edges: Edge[]): void {
    const at = new Map<number, Edge[]>();
    for (const edge of edges) for (const end of [edge.a, edge.b]) at.set(end, [...(at.get(end) ?? []), edge]);
    const inside = new Set<Edge>();
    for (const edge of edges) {
      const row = this.rowBeside(edge, at);
      if (row.length === 0) continue;
      inside.add(edge);
      for (const short of row) if (!this.parts(edge.quad, short.quad)) inside.add(short);
    }
    edges.splice(0, edges.length, ...edges.filter((edge) => !inside.has(edge)));
  }

  /** The shorter edges that lead one after the other from one end of `edge` to the other, along it; none if there are none. */
  private rowBeside(edge: Edge, at: Map<number, Edge[]>): Edge[] {
    const way = this.between(edge.a, edge.b), length = Math.hypot(...way);
    const row: Edge[] = [];
    for (let here = edge.a, gone = 0; here !== edge.b;) {
      let next: Edge | undefined, along = 0;
      for (const short of at.get(here) ?? []) {
        const step = this.between(here, short.a === here ? short.b : short.a);
        const size = Math.hypot(...step);
        along = (step[0] * way[0] + step[1] * way[1] + step[2] * way[2]) / length;
        if (short !== edge && along > straight * size && gone + along < 1.02 * length && size < 0.98 * length) { next = short; break; }
      }
      if (!next) return [];
      row.push(next);
      gone += along;
      here = next.a === here ? next.b : next.a;
    }
    return row;
  }

  private between(from: number, to: number): [number, number, number] {
    const { points } = this;
    return [points[3 * to] - points[3 * from], points[3 * to + 1] - points[3 * from + 1], points[3 * to + 2] - points[3 * from + 2]];
  }
}
