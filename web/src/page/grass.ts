import { SwardError } from "../format/error";
import { Field, openField } from "../format/field";
import { address, callback, checkOptions, expectOption, Rule } from "../format/options";
import { coverAt, noCover } from "../render/cover";
import { enterHost, leaveHost } from "../render/host";
import type { HostInput } from "../render/host";
import { DrawStats, Renderer } from "../render/renderer";
import { sowing as sowingRule } from "./options";
import { Sowing } from "../sow/sowing";
import type { SowOptions } from "../sow/sowing";

/** What Grass.open() opens. */
export interface GrassOptions {
  /** Address of the field. */
  field: string;
  /** Address of what `sward export` wrote beside it; without it blades do not shade one another. */
  cover?: string;
  /** How a field with seeds is sown; false: its stored blades alone are shown. */
  sow?: SowOptions | false;
  /** Called when something new is to be drawn: blades have come. */
  onChange?(): void;
  /** Called if blades cannot be fetched or sown; what is there is still drawn. */
  onError?(error: SwardError): void;
}

const rules: Record<string, Rule> = { field: address, cover: address, sow: sowingRule, onChange: callback, onError: callback };

/** Pages of blades that come before open() returns: 6 MB. */
const firstPages = 384;
const pagesAtOnce = 256;

/** A field of grass in the scene of a host that draws by WebGL 2: three.js, Babylon.js or another. */
export class Grass {
  private constructor(
    readonly field: Field,
    readonly renderer: Renderer,
  ) {}

  /** Opens a field. `gl`: the host's context, whose state the host forgets afterwards as after draw(). */
  static async open(gl: WebGL2RenderingContext, options: GrassOptions): Promise<Grass> {
    checkOptions("Grass.open", options, rules, "field");
    expectOption("Grass.open: gl", gl, "a context of WebGL 2", typeof gl?.createTransformFeedback === "function");
    const { onChange, onError } = options;
    const field = await openField(options.field);
    const [cover, sowing] = await Promise.all([
      options.cover ? coverAt(options.cover) : noCover,
      field.isSown && options.sow !== false ? Sowing.open(field, { onChange, onError, ...options.sow }) : undefined,
      field.loadPages(0, Math.min(firstPages, field.pageCount)),
    ]);
    const before = enterHost(gl);
    const grass = new Grass(field, new Renderer(gl.canvas as HTMLCanvasElement, field, cover, sowing, gl));
    leaveHost(gl, before);
    grass.loadRest(onChange).catch((error: unknown) => {
      if (!(error instanceof SwardError)) throw error;
      onError?.(error);
    });
    return grass;
  }

  /**
   * Draws the grass into the host's framebuffer. Call it after the host has drawn its opaque objects, and let the host
   * forget the state of the context afterwards: `renderer.resetState()` of three.js, `engine.wipeCaches(true)` of
   * Babylon.js.
   */
  draw(input: HostInput): DrawStats {
    return this.renderer.drawInHost(input);
  }

  /** Ends its work. */
  stop(): void {
    this.renderer.sowing?.stop();
  }

  private async loadRest(onChange?: () => void): Promise<void> {
    const { field } = this;
    for (let page = 0; page < field.pageCount; page += pagesAtOnce) {
      await field.loadPages(page, Math.min(page + pagesAtOnce, field.pageCount));
      onChange?.();
    }
  }
}

/** The field's ground as arrays of a mesh of a host, relative to the field's origin. */
export function groundMesh(field: Field): { positions: Float32Array; uvs: Float32Array; colors: Uint8Array; indices: Uint32Array } {
  const { ground } = field;
  const floats = new Float32Array(ground.vertices.buffer, ground.vertices.byteOffset, ground.vertices.length / 4);
  const count = ground.vertexCount;
  const mesh = {
    positions: new Float32Array(3 * count),
    uvs: new Float32Array(2 * count),
    colors: new Uint8Array(4 * count),
    // Level 0 alone: the others are the same ground, coarser.
    indices: Uint32Array.from(
      ground.ranges
        .filter((range) => range.level === 0)
        .flatMap((range) => [...ground.indices.subarray(range.firstIndex, range.firstIndex + range.indexCount)]),
    ),
  };
  for (let v = 0; v < count; ++v) {
    mesh.positions.set(floats.subarray(7 * v, 7 * v + 3), 3 * v);
    mesh.uvs.set(floats.subarray(7 * v + 4, 7 * v + 6), 2 * v);
    mesh.colors.set(ground.vertices.subarray(28 * v + 24, 28 * v + 28), 4 * v);
  }
  return mesh;
}
