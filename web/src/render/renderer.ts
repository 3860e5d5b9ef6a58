import { bladeShadowSegments, bladeShadowTexels, cullDistance, cullFrustum, leaveThinned, unsettledTurn } from "../generated/layout";
import * as shaders from "../generated/shaders";
import { bladeWords } from "../format/blades";
import { fail } from "../format/error";
import { Field, pageBlades } from "../format/field";
import { Camera, Vec3 } from "../format/texts";
import { Block } from "./block";
import { sownPagePatches } from "../sow/pages";
import type { Sowing } from "../sow/sowing";
import { View, viewOf } from "./camera";
import { Cover, noCover, sownCover } from "./cover";
import {
  frameBlock, FrameInput, frameSettings, looksBlock, minWidthOf, Scene, shadowPlanes, shadowRows, sunMapSize,
} from "./frame";
import { bindTexture, firstBlock, Gl, imageTexture, makeTarget, makeTexture, Picture, Program, samplePlaces, tableWidth, wordTable } from "./gl";
import { enterHost, HostInput, hostView, leaveHost } from "./host";
import { Light, usualLight, turnedWith } from "./light";
import { sceneOf } from "./scene";
import { groundArrayOf, patchesOfRow, patchTable, patchTexels, patchTexelsOf, ribbonIndices } from "./tables";
import { classes, groupBlades, Groups, PatchTree, shadowClass, TreeView } from "./tree";
import { scaled, size, unit } from "./vector";

/** What a picture shows. */
export interface DrawInput {
  camera: Camera;
  /** [s] of the wind. */
  time: number;
  /** [s] since the picture before; 0: nothing moves. */
  elapsed: number;
  light?: Light;
  /** Factor of the field's wind; 1 by default. */
  wind?: number;
  /** Blades at most; beyond it level of detail leaves out more. */
  maxBlades?: number;
  /** Whether each of a pixel's four samples is drawn alone, as the viewer does: finer, and slower. */
  isFine?: boolean;
}

/** What a picture took. */
export interface DrawStats {
  /** Blades of the visible patches that were moved and posed. */
  blades: number;
  /** Pages of blades that are visible and not here, the most wanted first. */
  missing: number[];
}

const captured = ["recordV0", "recordV1", "recordV2", "recordSurface", "recordFrame", "recordBend"];
const recordBytes = 16 * captured.length;
const usualMax = 400_000;

/** Draws a field by WebGL 2. The shaders are the viewer's: see web/generate.mjs. */
export class Renderer {
  readonly kind = "webgl";
  readonly scene: Scene;
  private readonly gl: Gl;
  private readonly tree: PatchTree;
  private parts!: Parts;
  private lodThreshold = frameSettings.lodThreshold;

  /** `cover`: what `sward export` wrote into field.cover; without it blades do not shade one another. */
  constructor(
    readonly canvas: HTMLCanvasElement,
    readonly field: Field,
    readonly cover: Cover = noCover,
    /** The blades between the stored ones of a field with seeds. */
    readonly sowing?: Sowing,
    /** The context of a host that draws on the canvas, too: see drawInHost(). */
    host?: Gl,
  ) {
    const options = { antialias: false, alpha: false, depth: false, powerPreference: "high-performance" };
    const gl = host ?? (canvas.getContext("webgl2", options) as Gl | null);
    if (!gl) fail("unsupported", "this browser has no WebGL 2, or its graphics driver is blocked");
    this.gl = gl;
    this.tree = new PatchTree(field, sowing);
    this.scene = sceneOf(field, sowing ? sownCover(cover, sowing.areaPerStored) : cover, sowing?.patches);
    this.restore();
  }

  /** Makes all that lies on the device, first or after the device was lost. */
  restore(): void {
    this.parts = new Parts(this.gl, this.field, this.scene, this.sowing);
    this.sowing?.forget();
  }

  /** The sun as the viewer has it by default. */
  get usualLight(): Light {
    const up = unit(scaled(this.field.defaults.gravity.direction, -1));
    return { ...usualLight, sunDirection: turnedWith(up, usualLight.sunDirection) };
  }

  /** Draws a picture as large as the canvas. */
  draw(input: DrawInput): DrawStats {
    const { canvas, field, scene } = this;
    const view = viewOf(input.camera, field.origin, canvas.width, canvas.height, scene.content);
    const { groups, stats } = this.prepare(input, view);
    this.parts.draw(groups, canvas.width, canvas.height, input.isFine ?? false);
    return stats;
  }

  /** Waits until all is sown that a camera wants, of a field with seeds. */
  async sowFor(input: DrawInput): Promise<void> {
    const { canvas, field, scene, sowing } = this;
    const view = viewOf(input.camera, field.origin, canvas.width, canvas.height, scene.content);
    while (sowing) {
      this.choose(input, view);
      if (sowing.isSettled) return;
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
  }

  /** Draws into a framebuffer of a host, whose depth hides grass and is hidden by it. */
  drawInHost(input: HostInput): DrawStats {
    const { gl } = this;
    const width = input.width ?? gl.drawingBufferWidth;
    const height = input.height ?? gl.drawingBufferHeight;
    const { view, camera, light } = hostView(input, height, this.usualLight);
    const before = enterHost(gl);
    const { groups, stats } = this.prepare({ ...input, camera, light }, view);
    gl.bindFramebuffer(gl.FRAMEBUFFER, input.framebuffer ?? null);
    gl.viewport(0, 0, width, height);
    this.parts.drawInHost(groups, input.isLinear ?? false, input.ground ?? false);
    leaveHost(gl, before);
    return stats;
  }

  /** Chooses the groups of blades of a view, and brings what has come onto the device. */
  private choose(input: DrawInput, view: View): { frame: FrameInput; treeView: TreeView; groups: Groups } {
    const { field, scene, sowing } = this;
    const frame: FrameInput = {
      view,
      camera: input.camera,
      light: input.light ?? this.usualLight,
      wind: input.wind ?? 1,
      time: input.time,
      shadowDistance,
      lodThreshold: this.lodThreshold,
      sparseFrom: 0,
      sparseLeast: field.seeds?.meadow.stored ?? 0,
    };
    const treeView: TreeView = {
      eye: view.eye,
      planes: view.planes,
      drawDistance: field.defaults.drawDistance,
      pixelsPerUnit: view.pixelsPerUnit,
      lodThreshold: this.lodThreshold,
      lodWidth: scene.bladeWidth,
      minWidth: minWidthOf(view),
      sparseFrom: 0,
      sparseLeast: frame.sparseLeast,
    };
    // What depends on the threshold of level of detail, which is raised while blades are missing.
    const find = () => {
      frame.sparseFrom = treeView.sparseFrom = sowing ? this.sparseFrom(view) : 0;
      treeView.lodThreshold = frame.lodThreshold = this.lodThreshold * (sowing?.thinning ?? 1);
      return this.tree.groupsOf(treeView, Infinity);
    };
    if (sowing) sowing.update({ ...treeView, lodThreshold: this.lodThreshold, sparseFrom: this.sparseFrom(view) });
    this.parts.uploadPages();
    const most = input.maxBlades ?? usualMax;
    let groups = find();
    // Far too many blades, or far too few: change level of detail at once. Else slowly, so that nothing flickers.
    const usual = frameSettings.lodThreshold;
    for (let i = 0; i < 12; ++i) {
      const ratio = Math.sqrt(groups.blades / most);
      if (ratio > 1.15) this.lodThreshold *= Math.min(ratio, 2);
      else if (ratio < 0.7 && this.lodThreshold > usual)
        this.lodThreshold = Math.max(this.lodThreshold * Math.max(1.2 * ratio, 0.5), usual);
      else break;
      groups = find();
    }
    if (groups.blades > most) this.lodThreshold *= 1.02;
    else if (groups.blades < 0.8 * most) this.lodThreshold = Math.max(this.lodThreshold / 1.02, usual);
    return { frame, treeView, groups };
  }

  /** Chooses, moves and poses blades, and draws the maps of shadows. */
  private prepare(input: DrawInput, view: View): { groups: Groups; stats: DrawStats } {
    const { frame, treeView, groups } = this.choose(input, view);
    const rows = shadowRows(view, input.camera, frame.light.sunDirection, frame.shadowDistance);
    const casters =
      frame.light.sunColor[0] > 0
        ? this.tree.groupsOf({ ...treeView, planes: shadowPlanes(rows), minWidth: 0 }, input.maxBlades ?? usualMax, shadowClass)
        : undefined;
    this.parts.prepare(frame, groups, casters, shadowPlanes(rows), input.elapsed);
    return { groups, stats: { blades: groups.blades, missing: groups.missing } };
  }

  /** Distance beyond which a sown field is drawn sparsely: frameOf() of src/render/frame/frame.cpp. */
  private sparseFrom(view: View): number {
    const { low, high } = this.scene.content;
    const gap = [0, 1, 2].map((i) => Math.max(low[i] - view.eye[i], view.eye[i] - high[i], 0)) as Vec3;
    const full = (this.scene.bladeWidth * view.pixelsPerUnit) / this.lodThreshold;
    return this.sowing!.sparseDistance(low, high, full, size(gap));
  }

  /** Records of the blades that the last draw() posed; 24 words each. For tests. */
  readRecords(): Uint32Array {
    return this.parts.readRecords();
  }

  get isLost(): boolean {
    return this.gl.isContextLost();
  }
}

/** Distance to which blades cast shadows of their own shape [m], as in the viewer. */
export const shadowDistance = 8;

/** A part of the ground with one material. */
interface GroundPart {
  first: number;
  count: number;
  color: number[];
  isDoubleSided: boolean;
  image: WebGLTexture;
}

/** All that lies on the device. */
class Parts {
  private readonly move: Program;
  private readonly pose: Program;
  private readonly blade: Program;
  private readonly ground: Program;
  private readonly sky: Program;
  private readonly film: Program;
  private readonly sun: Program;
  private readonly bladeShadow: Program;
  private readonly blades: WebGLTexture;
  private readonly states: WebGLTexture[];
  private readonly stateTargets: WebGLFramebuffer[];
  private readonly stateRows: number;
  private readonly patches: WebGLTexture;
  private readonly cover: WebGLTexture;
  private readonly sunMap: WebGLTexture;
  private readonly sunTarget: WebGLFramebuffer;
  private readonly shadowMap: WebGLTexture;
  private readonly shadowTarget: WebGLFramebuffer;
  private readonly frame: WebGLBuffer;
  private readonly looks: WebGLBuffer;
  private readonly groupBuffer: WebGLBuffer;
  private readonly groupArray: WebGLVertexArrayObject;
  private readonly records: WebGLBuffer;
  private readonly feedback: WebGLTransformFeedback;
  private readonly ribbonArray: WebGLVertexArrayObject;
  private readonly indices: WebGLBuffer[];
  private readonly groundArray: WebGLVertexArrayObject;
  private readonly groundParts: GroundPart[];
  private readonly nothing: WebGLVertexArrayObject;
  private readonly uploaded: Uint8Array;
  /** First row of blades, and of patches, that are sown. */
  private readonly sownRow: number;
  private picture: Picture | undefined;
  private hostPrograms: { blade: Program; ground: Program } | undefined;
  private recordRoom = 0;
  private recordCount = 0;
  private newest = 0;
  private sunOf = "";

  constructor(
    private readonly gl: Gl,
    private readonly field: Field,
    private readonly scene: Scene,
    private readonly sowing: Sowing | undefined,
  ) {
    const programs = {
      move: new Program(gl, "move", shaders.moveVert, shaders.moveFrag),
      pose: new Program(gl, "pose", shaders.poseVert, shaders.nothingFrag, captured),
      blade: new Program(gl, "blade", shaders.bladeVert, shaders.bladeFrag),
      ground: new Program(gl, "ground", shaders.groundVert, shaders.groundFrag),
      sky: new Program(gl, "sky", shaders.skyVert, shaders.skyFrag),
      film: new Program(gl, "film", shaders.filmVert, shaders.filmFrag),
      sun: new Program(gl, "sun", shaders.sunVert, shaders.nothingFrag),
      bladeShadow: new Program(gl, "blade shadow", shaders.bladeShadowVert, shaders.bladeShadowFrag),
    };
    this.move = programs.move.finish();
    this.pose = programs.pose.finish();
    this.blade = programs.blade.finish();
    this.ground = programs.ground.finish();
    this.sky = programs.sky.finish();
    this.film = programs.film.finish();
    this.sun = programs.sun.finish();
    this.bladeShadow = programs.bladeShadow.finish();

    this.uploaded = new Uint8Array(field.pageCount);
    this.sownRow = (sowing?.firstBlade ?? 0) / tableWidth;
    this.stateRows = sowing ? this.sownRow + sowing.pageCount : Math.max(Math.ceil(field.bladeCount / tableWidth), 1);
    const most = gl.getParameter(gl.MAX_TEXTURE_SIZE) as number;
    if (this.stateRows > most)
      fail("unsupported", `${field.name}: ${this.stateRows * tableWidth} blades, more than ${most * tableWidth} on this device`);
    this.blades = makeTexture(gl, gl.RGBA32UI, tableWidth, this.stateRows);
    this.states = [0, 1].map(() => makeTexture(gl, gl.R32UI, tableWidth, this.stateRows));
    this.stateTargets = this.states.map((states) => {
      const target = makeTarget(gl, states);
      gl.clearBufferuiv(gl.COLOR, 0, [unsettledTurn, 0, 0, 0]);
      return target;
    });
    this.patches = patchTable(gl, sowing?.patches ?? field.patches);
    this.cover = wordTable(gl, scene.cover.corners);
    this.sunMap = makeTexture(gl, gl.DEPTH_COMPONENT24, sunMapSize, sunMapSize);
    this.sunTarget = makeTarget(gl, null, this.sunMap);
    this.shadowMap = makeTexture(gl, gl.RG32UI, bladeShadowTexels, bladeShadowTexels);
    const shadowDepth = makeTexture(gl, gl.DEPTH_COMPONENT24, bladeShadowTexels, bladeShadowTexels);
    this.shadowTarget = makeTarget(gl, this.shadowMap, shadowDepth);

    this.frame = gl.createBuffer()!;
    this.looks = gl.createBuffer()!;
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.looks);
    gl.bufferData(gl.UNIFORM_BUFFER, looksBlock(field).bytes, gl.STATIC_DRAW);
    this.groupBuffer = gl.createBuffer()!;
    this.groupArray = gl.createVertexArray()!;
    this.records = gl.createBuffer()!;
    this.feedback = gl.createTransformFeedback()!;
    this.ribbonArray = gl.createVertexArray()!;
    this.indices = classes.map(({ segments, columns }) => ribbonIndices(gl, segments, columns));
    this.nothing = gl.createVertexArray()!;
    this.groundArray = groundArrayOf(gl, field);
    const white = imageTexture(gl);
    const images = field.ground.images.map((image) => imageTexture(gl, image));
    this.groundParts = field.ground.ranges
      .filter((range) => range.level === 0 && range.indexCount > 0)
      .map((range) => {
        const material = field.ground.materials[range.material];
        return {
          first: range.firstIndex,
          count: range.indexCount,
          color: material.baseColor.slice(0, 3),
          isDoubleSided: material.isDoubleSided,
          image: images[material.image] ?? white,
        };
      });
    gl.bindVertexArray(null);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(gl.LEQUAL);
  }

  /** Copies the pages that have come to the device. */
  uploadPages(): void {
    const { gl, field } = this;
    if (this.sowing) this.uploadSown(this.sowing);
    if (field.presentPages === 0) return;
    const words = pageBlades * bladeWords;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.blades);
    for (let page = 0; page < field.pageCount; ++page) {
      if (this.uploaded[page] || !field.has(page * pageBlades, 1)) continue;
      // Whole rows at once, if many pages have come.
      let end = page + 1;
      if (page % 2 === 0)
        while (end < field.pageCount && !this.uploaded[end] && field.has(end * pageBlades, 1)) ++end;
      let data = field.packed.subarray(page * words, end * words);
      const width = end - page > 1 ? tableWidth : pageBlades;
      const rows = Math.ceil((end - page) / 2);
      if (data.length < width * rows * bladeWords) {
        const padded = new Uint32Array(width * rows * bladeWords);
        padded.set(data);
        data = padded;
      }
      const x = (page % 2) * pageBlades;
      gl.texSubImage2D(gl.TEXTURE_2D, 0, x, page >> 1, width, rows, gl.RGBA_INTEGER, gl.UNSIGNED_INT, data);
      this.uploaded.fill(1, page, end);
    }
  }

  /** The same for what is sown: a row of blades, unsettled, and a quarter of a row of patches each. */
  private uploadSown(sowing: Sowing): void {
    const { gl } = this;
    const unsettled = new Uint32Array(tableWidth).fill(unsettledTurn);
    gl.activeTexture(gl.TEXTURE0);
    for (const { page, blades } of sowing.changed) {
      const row = this.sownRow + page;
      gl.bindTexture(gl.TEXTURE_2D, this.blades);
      gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, row, tableWidth, 1, gl.RGBA_INTEGER, gl.UNSIGNED_INT, blades);
      for (const states of this.states) {
        gl.bindTexture(gl.TEXTURE_2D, states);
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, row, tableWidth, 1, gl.RED_INTEGER, gl.UNSIGNED_INT, unsettled);
      }
      const first = sowing.firstPatch + sownPagePatches * page;
      const texels = patchTexelsOf(sowing.patches, first, first + sownPagePatches);
      gl.bindTexture(gl.TEXTURE_2D, this.patches);
      const [x, y] = [patchTexels * (first % patchesOfRow), Math.floor(first / patchesOfRow)];
      gl.texSubImage2D(gl.TEXTURE_2D, 0, x, y, patchTexels * sownPagePatches, 1, gl.RGBA_INTEGER, gl.UNSIGNED_INT, texels);
    }
    sowing.changed = [];
  }

  /** Moves and poses the blades, and draws the maps of shadows. */
  prepare(input: FrameInput, groups: Groups, casters: Groups | undefined, sunPlanes: number[][], elapsed: number): void {
    const { gl } = this;
    const block = frameBlock(this.scene, input);
    this.setFrame(block);
    bindTexture(gl, "bladeTexture", this.blades);
    bindTexture(gl, "patchTexture", this.patches);
    bindTexture(gl, "coverTexture", this.cover);
    bindTexture(gl, "sunTexture", this.sunMap);
    bindTexture(gl, "bladeShadowTexture", this.shadowMap);
    gl.disable(gl.BLEND);
    this.drawSunMap(input.light.sunDirection);
    this.setGroups(groups);
    this.moveBlades(groups, elapsed);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget);
    gl.clearBufferuiv(gl.COLOR, 0, [0, 0, 0, 0]);
    if (casters) {
      // The same frame as the sun sees it: blades have the widths that the eye's level of detail gives them.
      const bySun = frameBlock(this.scene, input);
      sunPlanes.forEach((plane, i) => bySun.floats(`view.planes[${i}]`, plane));
      bySun.floats("view.minWidth", [0]);
      bySun.floats("fixedTessellation", [bladeShadowSegments]);
      bySun.words("view.cullMask", [cullDistance | cullFrustum | leaveThinned]);
      this.setFrame(bySun);
      this.setGroups(casters);
      this.poseBlades(casters);
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowTarget);
      gl.viewport(0, 0, bladeShadowTexels, bladeShadowTexels);
      gl.clearBufferfv(gl.DEPTH, 0, [1]);
      this.drawRibbons(this.bladeShadow, casters);
      this.setFrame(block);
      this.setGroups(groups);
    }
    this.poseBlades(groups);
  }

  /** Draws a picture of what is prepared onto the canvas. */
  draw(groups: Groups, width: number, height: number, isFine: boolean): void {
    const { gl } = this;
    let picture = this.picture;
    if (!picture || picture.width !== width || picture.height !== height || picture.isFine !== isFine) {
      picture?.delete();
      picture = this.picture = new Picture(gl, width, height, isFine);
    }
    picture.resolved.forEach((_, sample) => {
      const place = isFine ? samplePlaces[sample] : [0.5, 0.5];
      const jitter = [(2 * place[0] - 1) / width, (2 * place[1] - 1) / height];
      const offset = [place[0] - 0.5, place[1] - 0.5];
      picture.begin();
      this.blade.use();
      gl.uniform2fv(this.blade.place("jitter"), jitter);
      gl.uniform2fv(this.blade.place("sampleOffset"), offset);
      gl.uniform1ui(this.blade.place("samples"), picture.resolved.length);
      gl.uniform1ui(this.blade.place("sampleOfPixel"), sample);
      this.drawRibbons(this.blade, groups);
      // Ground and sky are lit where no blade hides them.
      this.ground.use();
      gl.uniform2fv(this.ground.place("jitter"), jitter);
      gl.uniform2fv(this.ground.place("sampleOffset"), offset);
      this.drawGround(this.ground);
      this.sky.use();
      gl.bindVertexArray(this.nothing);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
      picture.end(sample);
    });

    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, width, height);
    gl.disable(gl.DEPTH_TEST);
    for (const [i, unit] of (["resolved", "resolved1", "resolved2", "resolved3"] as const).entries())
      bindTexture(gl, unit, picture.resolved[i] ?? picture.resolved[0]);
    this.film.use();
    gl.uniform1i(this.film.place("hasSamples"), isFine ? 1 : 0);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.DEPTH_TEST);
    gl.bindVertexArray(null);
  }

  /** Draws what is prepared into the framebuffer that is bound, with its depth. */
  drawInHost(groups: Groups, isLinear: boolean, hasGround: boolean): void {
    const { gl } = this;
    const { blade, ground } = (this.hostPrograms ??= {
      blade: new Program(gl, "blade of a host", shaders.bladeVert, shaders.hostBladeFrag).finish(),
      ground: new Program(gl, "ground of a host", shaders.groundVert, shaders.hostGroundFrag).finish(),
    });
    blade.use();
    gl.uniform2f(blade.place("jitter"), 0, 0);
    gl.uniform1ui(blade.place("samples"), 1);
    gl.uniform1ui(blade.place("sampleOfPixel"), 0);
    gl.uniform1i(blade.place("isLinear"), isLinear ? 1 : 0);
    this.drawRibbons(blade, groups);
    if (!hasGround) return;
    ground.use();
    gl.uniform2f(ground.place("jitter"), 0, 0);
    gl.uniform1i(ground.place("isLinear"), isLinear ? 1 : 0);
    this.drawGround(ground);
  }

  readRecords(): Uint32Array {
    const { gl } = this;
    const words = new Uint32Array((recordBytes / 4) * this.recordCount);
    gl.bindBuffer(gl.COPY_READ_BUFFER, this.records);
    gl.getBufferSubData(gl.COPY_READ_BUFFER, 0, words);
    gl.bindBuffer(gl.COPY_READ_BUFFER, null);
    return words;
  }

  private setFrame(block: Block): void {
    const { gl } = this;
    gl.bindBuffer(gl.UNIFORM_BUFFER, this.frame);
    gl.bufferData(gl.UNIFORM_BUFFER, block.bytes, gl.DYNAMIC_DRAW);
    gl.bindBufferBase(gl.UNIFORM_BUFFER, firstBlock, this.frame);
    gl.bindBufferBase(gl.UNIFORM_BUFFER, firstBlock + 1, this.looks);
  }

  /** The ground as the sun sees it, when the sun has moved. */
  private drawSunMap(sun: Vec3): void {
    const { gl } = this;
    if (this.sunOf === sun.join()) return;
    this.sunOf = sun.join();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.sunTarget);
    gl.viewport(0, 0, sunMapSize, sunMapSize);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    this.sun.use();
    gl.bindVertexArray(this.groundArray);
    for (const part of this.groundParts) gl.drawElements(gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 4 * part.first);
  }

  private setGroups(groups: Groups): void {
    const { gl } = this;
    gl.bindVertexArray(this.groupArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.groupBuffer);
    gl.bufferData(gl.ARRAY_BUFFER, groups.words, gl.DYNAMIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribDivisor(0, 1);
  }

  /** Draws a point for each blade of the groups of some classes. */
  private drawGroups(begin: number, end: number): void {
    const { gl } = this;
    gl.vertexAttribIPointer(0, 3, gl.UNSIGNED_INT, 12, 12 * begin);
    gl.drawArraysInstanced(gl.POINTS, 0, groupBlades, end - begin);
  }

  private moveBlades(groups: Groups, elapsed: number): void {
    const { gl } = this;
    const all = groups.begins[classes.length];
    if (all === 0) return;
    bindTexture(gl, "stateTexture", this.states[this.newest]);
    this.newest = 1 - this.newest;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.stateTargets[this.newest]);
    gl.viewport(0, 0, tableWidth, this.stateRows);
    gl.disable(gl.DEPTH_TEST);
    this.move.use();
    gl.uniform1f(this.move.place("elapsed"), elapsed);
    gl.uniform1f(this.move.place("stateRows"), this.stateRows);
    gl.bindVertexArray(this.groupArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.groupBuffer);
    this.drawGroups(0, all);
    gl.enable(gl.DEPTH_TEST);
  }

  private poseBlades(groups: Groups): void {
    const { gl } = this;
    const all = groups.begins[classes.length];
    this.recordCount = all * groupBlades;
    if (all === 0) return;
    if (this.recordRoom < this.recordCount) {
      this.recordRoom = Math.ceil(1.25 * all) * groupBlades;
      gl.bindBuffer(gl.COPY_WRITE_BUFFER, this.records);
      gl.bufferData(gl.COPY_WRITE_BUFFER, this.recordRoom * recordBytes, gl.DYNAMIC_COPY);
      gl.bindBuffer(gl.COPY_WRITE_BUFFER, null);
    }
    bindTexture(gl, "stateTexture", this.states[this.newest]);
    this.pose.use();
    gl.bindVertexArray(this.groupArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.groupBuffer);
    gl.bindTransformFeedback(gl.TRANSFORM_FEEDBACK, this.feedback);
    gl.enable(gl.RASTERIZER_DISCARD);
    classes.forEach(({ segments }, i) => {
      const [begin, end] = [groups.begins[i], groups.begins[i + 1]];
      if (begin === end) return;
      const step = recordBytes * groupBlades;
      gl.bindBufferRange(gl.TRANSFORM_FEEDBACK_BUFFER, 0, this.records, begin * step, (end - begin) * step);
      gl.uniform1f(this.pose.place("maxSegments"), segments);
      gl.beginTransformFeedback(gl.POINTS);
      this.drawGroups(begin, end);
      gl.endTransformFeedback();
    });
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, null);
    gl.bindTransformFeedback(gl.TRANSFORM_FEEDBACK, null);
    gl.disable(gl.RASTERIZER_DISCARD);
  }

  private drawRibbons(program: Program, groups: Groups): void {
    const { gl } = this;
    program.use();
    gl.bindVertexArray(this.ribbonArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.records);
    classes.forEach(({ segments, columns }, i) => {
      const [begin, end] = [groups.begins[i], groups.begins[i + 1]];
      if (begin === end) return;
      for (let attribute = 0; attribute < captured.length; ++attribute) {
        gl.enableVertexAttribArray(attribute);
        gl.vertexAttribDivisor(attribute, 1);
        const at = begin * groupBlades * recordBytes + 16 * attribute;
        gl.vertexAttribIPointer(attribute, 4, gl.UNSIGNED_INT, recordBytes, at);
      }
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.indices[i]);
      gl.uniform1ui(program.place("columns"), columns);
      const count = 6 * segments * (columns - 1);
      gl.drawElementsInstanced(gl.TRIANGLES, count, gl.UNSIGNED_SHORT, 0, (end - begin) * groupBlades);
    });
  }

  private drawGround(program: Program): void {
    const { gl } = this;
    gl.bindVertexArray(this.groundArray);
    for (const part of this.groundParts) {
      bindTexture(gl, "baseColor", part.image);
      gl.uniform3fv(program.place("materialColor"), part.color);
      gl.uniform1i(program.place("isDoubleSided"), part.isDoubleSided ? 1 : 0);
      if (part.isDoubleSided) gl.disable(gl.CULL_FACE);
      else gl.enable(gl.CULL_FACE);
      gl.drawElements(gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 4 * part.first);
    }
    gl.disable(gl.CULL_FACE);
  }
}
