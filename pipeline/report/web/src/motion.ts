// Where every body is at an instant.
import { locate, Motion, Scene, unpack } from "./data";
import type { Vibration } from "./modes";

export type Vector = [number, number, number];
export interface Pose { p: Vector; q: [number, number, number, number] }  // q = w x y z

const atRest: Pose = { p: [0, 0, 0], q: [1, 0, 0, 0] };

export function rotated({ q: [w, x, y, z] }: Pose, [a, b, c]: Vector): Vector {
  const tx = 2 * (y * c - z * b);
  const ty = 2 * (z * a - x * c);
  const tz = 2 * (x * b - y * a);
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx];
}

/** Point of the body's frame in the world. */
export function inWorld(pose: Pose, point: Vector): Vector {
  const turned = rotated(pose, point);
  return [turned[0] + pose.p[0], turned[1] + pose.p[1], turned[2] + pose.p[2]];
}

/** Poses over time, interpolated: positions along lines, attitudes by normalised quaternions. */
export class Bodies {
  readonly time: Float32Array;
  private poses = new Map<string, Float32Array>();
  private vibration: Vibration | null = null;
  private vibrationSize = 0;

  constructor(motion: Motion) {
    this.time = unpack(motion.time);
    for (const [name, packed] of Object.entries(motion.bodies)) this.poses.set(name, unpack(packed));
  }

  /** From now on every pose is moved along a natural mode, by `size` (m) at most; null: no more. */
  vibrate(vibration: Vibration | null, size: number): void {
    this.vibration = vibration;
    this.vibrationSize = size;
  }

  pose(body: string, time: number): Pose {
    const pose = this.poseAt(body, time);
    return this.vibration ? this.vibration.moved(body, pose, this.vibrationSize) : pose;
  }

  private poseAt(body: string, time: number): Pose {
    const poses = this.poses.get(body);
    if (!poses || this.time.length === 0) return atRest;
    const [low, share] = locate(this.time, time);
    const high = Math.min(low + 1, this.time.length - 1);
    const a = poses.subarray(7 * low, 7 * low + 7);
    const b = poses.subarray(7 * high, 7 * high + 7);
    const sign = a[3] * b[3] + a[4] * b[4] + a[5] * b[5] + a[6] * b[6] < 0 ? -1 : 1;
    const mix = (k: number, s = 1): number => a[k] + share * (s * b[k] - a[k]);
    const q: Pose["q"] = [mix(3, sign), mix(4, sign), mix(5, sign), mix(6, sign)];
    const size = Math.hypot(...q) || 1;
    return { p: [mix(0), mix(1), mix(2)], q: q.map((value) => value / size) as Pose["q"] };
  }
}

/** Points of a rope's path in the world. */
export function ropePath(rope: Scene["ropes"][number], bodies: Bodies, time: number): Vector[] {
  return rope.points.map((point, i) => inWorld(bodies.pose(rope.bodies[i], time), point as Vector));
}

/** Corners of a box in the body's frame: sizes, centre, quaternion of its edges. */
export function boxCorners(box: number[]): Vector[] {
  const corners: Vector[] = [];
  const place: Pose = { p: [box[3], box[4], box[5]], q: [box[6], box[7], box[8], box[9]] };
  for (const x of [-0.5, 0.5]) for (const y of [-0.5, 0.5]) for (const z of [-0.5, 0.5])
    corners.push(inWorld(place, [x * box[0], y * box[1], z * box[2]]));
  return corners;
}
