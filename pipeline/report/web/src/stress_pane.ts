// One picture of the block: its surface coloured by stress and moved by its deformation.
import * as three from "three";

import { Field, State, StructureState, unpack } from "./data";
import { megapascals, millimetres } from "./numbers";
import { BlockSurface } from "./surface";
import { Pane, Viewer } from "./viewer";

// Stress is interpolated as a number and coloured in each pixel: the isolines are true, whatever the scale.
const vertexShader = `
  attribute vec3 displacement;
  attribute float stress;
  uniform float deformation;
  varying float vStress;
  varying vec3 vEye;
  varying vec3 vPlace;
  void main() {
    vStress = stress;
    vPlace = position;
    vec4 eye = modelViewMatrix * vec4(position + deformation * displacement, 1.0);
    vEye = eye.xyz;
    gl_Position = projectionMatrix * eye;
  }`;
const fragmentShader = `
  uniform sampler2D colours;
  uniform float top, bands, probeRange;
  uniform vec4 plane;
  varying float vStress;
  varying vec3 vEye;
  varying vec3 vPlace;
  void main() {
    if (dot(plane.xyz, vPlace) > plane.w) discard;
    if (probeRange > 0.0) {  // the value itself, in two bytes
      float whole = clamp(vStress / probeRange, 0.0, 1.0) * 65535.0;
      float high = floor(whole / 256.0);
      gl_FragColor = vec4(high / 255.0, floor(whole - 256.0 * high) / 255.0, 0.0, 1.0);
      return;
    }
    float share = clamp(vStress / top, 0.0, 1.0);
    if (bands > 0.0) share = (min(floor(share * bands), bands - 1.0) + 0.5) / bands;
    vec3 normal = normalize(cross(dFdx(vEye), dFdy(vEye)));
    float light = 0.80 + 0.20 * abs(dot(normal, normalize(vec3(0.3, 0.5, 0.8))));
    gl_FragColor = vec4(texture2D(colours, vec2((share * 255.0 + 0.5) / 256.0, 0.5)).rgb * light, 1.0);
  }`;
const edgeShader = `
  uniform vec4 plane;
  varying vec3 vPlace;
  void main() {
    if (dot(plane.xyz, vPlace) > plane.w) discard;
    gl_FragColor = vec4(0.06, 0.09, 0.14, 0.55);
  }`;

/** What all panes share: the colour scale, the deformation's factor, the cut. */
export class StressScale {
  readonly deformation = { value: 0 };
  readonly top = { value: 1 };
  readonly bands = { value: 0 };
  readonly plane = { value: new three.Vector4(0, 0, 0, 1) };
  constructor(readonly colours: three.Texture) {}

  get banded(): boolean { return this.bands.value > 0; }
  setTop(pascals: number): void { this.top.value = Math.max(pascals, 1e-30); }
  setBanded(on: boolean): void { this.bands.value = on ? 10 : 0; }

  /** Takes away what lies beyond `at` along an axis (0 x, 1 y, 2 z; negative: nothing). */
  cut(axis: number, at: number): void {
    this.plane.value.set(axis === 0 ? 1 : 0, axis === 1 ? 1 : 0, axis === 2 ? 1 : 0, axis < 0 ? 1 : at);
  }
}

/** A label at a point of the block, and how far that point moves. */
interface Mark { label: Pane["labels"][number]; place: three.Vector3; displacement: three.Vector3 }

export class StressPane {
  readonly edges: three.LineSegments;
  largestStress = 0;
  largestDisplacement = 0;
  private readonly mesh: three.Mesh;
  private readonly probeRange = { value: 0 };
  private readonly stressMark: Mark;
  private readonly deformationMark: Mark;

  constructor(private surface: BlockSurface, viewer: Viewer, index: number, private scale: StressScale, readonly state: State) {
    const position = new three.BufferAttribute(surface.points, 3);
    const count = surface.points.length / 3;
    const displacement = new three.BufferAttribute(new Float32Array(3 * count), 3);
    const shared = { deformation: scale.deformation, plane: scale.plane };
    const geometry = new three.BufferGeometry().setAttribute("position", position).setAttribute("displacement", displacement)
      .setAttribute("stress", new three.BufferAttribute(new Float32Array(count), 1))
      .setIndex(new three.BufferAttribute(surface.triangles(), 1));
    this.mesh = new three.Mesh(geometry, new three.ShaderMaterial({
      uniforms: { ...shared, colours: { value: scale.colours }, top: scale.top, bands: scale.bands, probeRange: this.probeRange },
      vertexShader, fragmentShader, side: three.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
    }));
    this.edges = new three.LineSegments(
      new three.BufferGeometry().setAttribute("position", position).setAttribute("displacement", displacement)
        .setAttribute("stress", geometry.getAttribute("stress")).setIndex(new three.BufferAttribute(surface.outlines(), 1)),
      new three.ShaderMaterial({ uniforms: shared, vertexShader, fragmentShader: edgeShader, transparent: true }));
    // The shader moves the points: the boxes that three.js would cull by do not hold.
    this.mesh.frustumCulled = this.edges.frustumCulled = false;
    viewer.panes[index].scene.add(this.mesh, this.edges);
    const mark = (className: string): Mark =>
      ({ label: viewer.addLabel(index, "", className), place: new three.Vector3(), displacement: new three.Vector3() });
    this.stressMark = mark("maximum");
    this.deformationMark = mark("maximum deformation");
  }

  setField(field: Field | undefined, figures: StructureState | undefined): void {
    const { geometry } = this.mesh;
    const stress = geometry.getAttribute("stress") as three.BufferAttribute;
    const displacement = geometry.getAttribute("displacement") as three.BufferAttribute;
    (stress.array as Float32Array).fill(0);
    (displacement.array as Float32Array).fill(0);
    if (field) {
      (stress.array as Float32Array).set(unpack(field.von_mises));
      (displacement.array as Float32Array).set(unpack(field.displacement));
    }
    stress.needsUpdate = displacement.needsUpdate = true;
    const values = stress.array as Float32Array;
    const moved = displacement.array as Float32Array;
    let peak = 0;
    let farthest = 0;
    const distance = (i: number): number => Math.hypot(moved[3 * i], moved[3 * i + 1], moved[3 * i + 2]);
    for (let i = 0; i < values.length; ++i) {
      if (values[i] > values[peak]) peak = i;
      if (distance(i) > distance(farthest)) farthest = i;
    }
    this.largestStress = values[peak];
    this.largestDisplacement = distance(farthest);
    this.setMark(this.stressMark, field?.checked_stress_point ?? figures?.checked_point_m ?? field?.peak_stress_point, peak,
      `${megapascals(figures?.checked_von_mises_Pa ?? this.largestStress)} MPa`);
    this.setMark(this.deformationMark, field?.max_displacement_point ?? figures?.max_displacement_point_m, farthest,
      `${millimetres(figures?.max_displacement_m ?? this.largestDisplacement)} mm`);
    this.placeMarks();
  }

  /** Puts a mark at a point if one is given, else at a point of the mesh; it moves as the mesh does there. */
  private setMark(mark: Mark, given: number[] | undefined, otherwise: number, text: string): void {
    const { points } = this.surface;
    let nearest = otherwise;
    if (given?.length === 3) {
      let best = Infinity;
      for (let i = 0; i < points.length / 3; ++i) {
        const distance = (points[3 * i] - given[0]) ** 2 + (points[3 * i + 1] - given[1]) ** 2 + (points[3 * i + 2] - given[2]) ** 2;
        if (distance < best) { best = distance; nearest = i; }
      }
    }
    mark.place.fromArray(given?.length === 3 ? given : points, given?.length === 3 ? 0 : 3 * nearest);
    mark.displacement.fromArray(this.mesh.geometry.getAttribute("displacement").array, 3 * nearest);
    mark.label.element.textContent = text;
  }

  /** To be called when the deformation's factor or the cut has changed. */
  placeMarks(): void {
    const { plane, deformation } = this.scale;
    for (const { label, place, displacement } of [this.stressMark, this.deformationMark]) {
      label.point.copy(place).addScaledVector(displacement, deformation.value);
      const cutAway = place.x * plane.value.x + place.y * plane.value.y + place.z * plane.value.z > plane.value.w + 1e-6;
      label.element.style.display = cutAway ? "none" : "";
    }
  }

  /** Draws values instead of colours while the stress under the pointer is read. */
  probing(on: boolean, range: number): void {
    this.probeRange.value = on ? Math.max(range, 1e-30) : 0;
    this.edges.layers.set(on ? 1 : 0);
  }

  hide(groups: Set<number>): void {
    this.mesh.geometry.setIndex(new three.BufferAttribute(this.surface.triangles(groups), 1));
    this.edges.geometry.setIndex(new three.BufferAttribute(this.surface.outlines(groups), 1));
  }
}
