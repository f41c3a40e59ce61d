// The block's surface as triangles and edges.
import { Surface, unpack, unpackIndices } from "./data";

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

  /** Edges where the surface bends, ends or changes its group: the outlines of the plates. */
  outlines(hidden: Set<number> = new Set()): Uint32Array {
    const pointCount = this.points.length / 3;
    const sharp = Math.cos((25 * Math.PI) / 180);
    const first = new Map<number, number>();  // edge -> the quad seen first, or -1 when both are seen
    const lines: number[] = [];
    for (let quad = 0; quad < this.quads.length / 4; ++quad) {
      if (hidden.has(this.groupOfQuad[quad])) continue;
      for (let k = 0; k < 4; ++k) {
        const a = this.quads[4 * quad + k];
        const b = this.quads[4 * quad + ((k + 1) % 4)];
        const edge = Math.min(a, b) * pointCount + Math.max(a, b);
        const other = first.get(edge);
        if (other === undefined) { first.set(edge, quad); continue; }
        if (other < 0) continue;
        first.set(edge, -1);
        const n = this.normal(quad);
        const m = this.normal(other);
        if (n[0] * m[0] + n[1] * m[1] + n[2] * m[2] < sharp || this.groupOfQuad[quad] !== this.groupOfQuad[other]) lines.push(a, b);
      }
    }
    for (const [edge, quad] of first) if (quad >= 0) lines.push(Math.floor(edge / pointCount), edge % pointCount);
    return Uint32Array.from(lines);
  }
}
