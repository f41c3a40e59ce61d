// One picture of the block: its surface coloured by stress (or another value) and moved by its deformation.
import * as three from "three";

import { Field, StructureState, unpack } from "./data";
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
  uniform float bottom, top, bands, probing;
  uniform vec4 plane;
  varying float vStress;
  varying vec3 vEye;
  varying vec3 vPlace;
  void main() {
    if (dot(plane.xyz, vPlace) > plane.w) discard;
    bool isKnown = vStress > -1.0e20;
    if (probing > 0.0) {  // the value itself, in two bytes
      float whole = clamp((vStress - bottom) / (top - bottom), 0.0, 1.0) * 65535.0;
      float high = floor(whole / 256.0);
      gl_FragColor = isKnown ? vec4(high / 255.0, floor(whole - 256.0 * high) / 255.0, 0.0, 1.0) : vec4(0.0);
      return;
    }
    float share = clamp((vStress - bottom) / (top - bottom), 0.0, 1.0);
    if (bands > 0.0) share = (min(floor(share * bands), bands - 1.0) + 0.5) / bands;
    vec3 colour = isKnown ? texture2D(colours, vec2((share * 255.0 + 0.5) / 256.0, 0.5)).rgb : vec3(0.55);
    vec3 normal = normalize(cross(dFdx(vEye), dFdy(vEye)));
    float light = 0.80 + 0.20 * abs(dot(normal, normalize(vec3(0.3, 0.5, 0.8))));
    gl_FragColor = vec4(colour * light, 1.0);
  }`;
/** What the shader takes for no value: interpolated with any other it stays far below all of them. */
const noValue = -1e30;
const edgeShader = `
  uniform vec4 plane;
  varying vec3 vPlace;
  void main() {
    if (dot(plane.xyz, vPlace) > plane.w) discard;
    gl_FragColor = vec4(0.06, 0.09, 0.14, 0.55);
  }`;

/** What panes share: the deformation's factor and the cut, and those of one kind the colour scale. */
export class StressScale {
  readonly deformation: { value: number };
  readonly plane: { value: three.Vector4 };
  readonly bottom = { value: 0 };
  readonly top = { value: 1 };
  readonly bands = { value: 0 };
  /** @param other scale, whose deformation and cut are this one's too */
  constructor(readonly colours: three.Texture, other?: StressScale) {
    this.deformation = other?.deformation ?? { value: 0 };
    this.plane = other?.plane ?? { value: new three.Vector4(0, 0, 0, 1) };
  }

  get banded(): boolean { return this.bands.value > 0; }
  /** From zero, or from the same below zero, up to a value. */
  setTop(value: number, symmetric = false): void {
    this.top.value = Math.max(value, 1e-30);
    this.bottom.value = symmetric ? -this.top.value : 0;
  }
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
  smallestStress = 0;
  largestStress = 0;
  largestDisplacement = 0;
  private peak = 0;  // points where they are
  private farthest = 0;
  private readonly mesh: three.Mesh;
  private readonly probed = { bottom: { value: 0 }, top: { value: 1 }, probing: { value: 0 } };
  private readonly stressMark: Mark;
  private readonly deformationMark: Mark;

  /** @param name of what it shows, in the words of the probe */
  constructor(readonly surface: BlockSurface, viewer: Viewer, index: number, readonly scale: StressScale, public name: string) {
    const position = new three.BufferAttribute(surface.points, 3);
    const count = surface.points.length / 3;
    const displacement = new three.BufferAttribute(new Float32Array(3 * count), 3);
    const shared = { deformation: scale.deformation, plane: scale.plane };
    const geometry = new three.BufferGeometry().setAttribute("position", position).setAttribute("displacement", displacement)
      .setAttribute("stress", new three.BufferAttribute(new Float32Array(count), 1))
      .setIndex(new three.BufferAttribute(surface.triangles(), 1));
    this.mesh = new three.Mesh(geometry, new three.ShaderMaterial({
      uniforms: { ...shared, colours: { value: scale.colours }, bottom: scale.bottom, top: scale.top, bands: scale.bands, probing: this.probed.probing },
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
    this.show(field && unpack(field.von_mises), field && unpack(field.displacement));
    this.setMark(this.stressMark, field?.checked_stress_point ?? figures?.checked_point_m ?? field?.peak_stress_point, this.peak,
      `${megapascals(figures?.checked_von_mises_Pa ?? this.largestStress)} MPa`);
    this.setMark(this.deformationMark, field?.max_displacement_point ?? figures?.max_displacement_point_m, this.farthest,
      `${millimetres(figures?.max_displacement_m ?? this.largestDisplacement)} mm`);
    this.placeMarks();
  }

  /** Values of any kind with one mark, at a point if one is given, else where they are largest in size. */
  setValues(values: Float32Array, displacement: Float32Array, text: (extreme: number) => string, given?: number[]): void {
    this.show(values, displacement);
    this.setMark(this.stressMark, given, this.peak, text(Math.abs(this.smallestStress) > this.largestStress ? this.smallestStress : this.largestStress));
    this.deformationMark.label.element.textContent = "";
    this.placeMarks();
  }

  /** Whether the mark of the largest value is there. */
  showMark(on: boolean): void {
    if (!on) this.stressMark.label.element.textContent = "";
    this.placeMarks();
  }

  /** Takes values and displacements of the points, zero if there are none; finds where they are largest. */
  private show(values: Float32Array | undefined, moves: Float32Array | undefined): void {
    const { geometry } = this.mesh;
    const stress = geometry.getAttribute("stress") as three.BufferAttribute;
    const displacement = geometry.getAttribute("displacement") as three.BufferAttribute;
    const shown = stress.array as Float32Array;
    const moved = displacement.array as Float32Array;
    const distance = (i: number): number => Math.hypot(moved[3 * i], moved[3 * i + 1], moved[3 * i + 2]);
    if (moves) moved.set(moves); else moved.fill(0);
    [this.smallestStress, this.largestStress, this.peak, this.farthest] = [0, 0, 0, 0];
    for (let i = 0; i < shown.length; ++i) {
      const value = values ? values[i] : 0;
      shown[i] = Number.isNaN(value) ? noValue : value;
      if (Math.abs(value) > Math.max(this.largestStress, -this.smallestStress)) this.peak = i;
      if (value > this.largestStress) this.largestStress = value;
      if (value < this.smallestStress) this.smallestStress = value;
      if (distance(i) > distance(this.farthest)) this.farthest = i;
    }
    this.largestDisplacement = distance(this.farthest);
    stress.needsUpdate = displacement.needsUpdate = true;
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
      label.element.style.display = cutAway || !label.element.textContent ? "none" : "";
    }
  }

  /** Draws values instead of colours while the one under the pointer is read; they lie between the two that are returned. */
  probing(on: boolean): [number, number] {
    const { uniforms } = this.mesh.material as three.ShaderMaterial;
    const [bottom, top] = [this.smallestStress, Math.max(this.largestStress, this.smallestStress + 1e-30)];
    this.probed.bottom.value = bottom;
    this.probed.top.value = top;
    this.probed.probing.value = on ? 1 : 0;
    uniforms.bottom = on ? this.probed.bottom : this.scale.bottom;
    uniforms.top = on ? this.probed.top : this.scale.top;
    this.edges.layers.set(on ? 1 : 0);
    return [bottom, top];
  }

  hide(groups: Set<number>): void {
    this.mesh.geometry.setIndex(new three.BufferAttribute(this.surface.triangles(groups), 1));
    this.edges.geometry.setIndex(new three.BufferAttribute(this.surface.outlines(groups), 1));
  }
}
