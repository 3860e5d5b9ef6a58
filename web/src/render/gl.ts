import { fail } from "../format/error";

/** Texture units, by the names of samplers. */
const units = [
  "bladeTexture", "stateTexture", "patchTexture", "coverTexture", "sunTexture", "bladeShadowTexture", "baseColor",
  "resolved", "resolved1", "resolved2", "resolved3",
] as const;

/**
 * Blocks of uniforms, by their binding points from the first on. These are the last ones that every device has: hosts
 * begin with the first, and Babylon.js does not look again at what it has bound.
 */
const blocks = ["FrameConstants", "LookTables"];
export const firstBlock = 22;

export type Gl = WebGL2RenderingContext;

/** A linked program with its uniforms. */
export class Program {
  readonly program: WebGLProgram;
  private readonly places = new Map<string, WebGLUniformLocation | null>();

  /** `captured`: outputs of the vertex stage that transform feedback keeps, in this order. */
  constructor(
    private readonly gl: Gl,
    readonly name: string,
    vertex: string,
    fragment: string,
    captured: readonly string[] = [],
  ) {
    this.program = gl.createProgram()!;
    const shaders = [
      [gl.VERTEX_SHADER, vertex],
      [gl.FRAGMENT_SHADER, fragment],
    ].map(([kind, text]) => {
      const shader = gl.createShader(kind as number)!;
      gl.shaderSource(shader, text as string);
      gl.compileShader(shader);
      gl.attachShader(this.program, shader);
      return shader;
    });
    if (captured.length > 0) gl.transformFeedbackVaryings(this.program, captured, gl.INTERLEAVED_ATTRIBS);
    gl.linkProgram(this.program);
    // Compilers of all programs run side by side until the first one is asked.
    this.check = () => {
      if (gl.getProgramParameter(this.program, gl.LINK_STATUS) || gl.isContextLost()) return;
      const log = [...shaders.map((shader) => gl.getShaderInfoLog(shader)), gl.getProgramInfoLog(this.program)];
      console.warn(log.join("\n"));
      fail("runtime", `the program ${name} does not compile on this device`);
    };
  }

  private check: () => void;

  /** Waits for the compiler, and sets samplers and blocks. */
  finish(): this {
    this.check();
    const gl = this.gl;
    gl.useProgram(this.program);
    units.forEach((sampler, unit) => {
      const place = gl.getUniformLocation(this.program, sampler);
      if (place) gl.uniform1i(place, unit);
    });
    blocks.forEach((block, binding) => {
      const index = gl.getUniformBlockIndex(this.program, block);
      if (index !== gl.INVALID_INDEX) gl.uniformBlockBinding(this.program, index, firstBlock + binding);
    });
    return this;
  }

  use(): void {
    this.gl.useProgram(this.program);
  }

  place(name: string): WebGLUniformLocation | null {
    if (!this.places.has(name)) this.places.set(name, this.gl.getUniformLocation(this.program, name));
    return this.places.get(name)!;
  }
}

/** Binds a texture to the unit of a sampler. */
export function bindTexture(gl: Gl, sampler: (typeof units)[number], texture: WebGLTexture): void {
  gl.activeTexture(gl.TEXTURE0 + units.indexOf(sampler));
  gl.bindTexture(gl.TEXTURE_2D, texture);
}

/** A texture of whole texels, without levels. */
export function makeTexture(gl: Gl, format: number, width: number, height: number): WebGLTexture {
  const texture = gl.createTexture()!;
  gl.activeTexture(gl.TEXTURE0 + units.length);
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  return texture;
}

/** Width of tables that are textures: tableWidth of web/shaders/frame.glsl. */
export const tableWidth = 2048;

/** A table of words as a texture of R32UI. */
export function wordTable(gl: Gl, words: Uint32Array): WebGLTexture {
  const rows = Math.max(Math.ceil(words.length / tableWidth), 1);
  const texture = makeTexture(gl, gl.R32UI, tableWidth, rows);
  const whole = new Uint32Array(rows * tableWidth);
  whole.set(words);
  gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, tableWidth, rows, gl.RED_INTEGER, gl.UNSIGNED_INT, whole);
  return texture;
}

/** An image of the ground with its levels; white if there is none. */
export function imageTexture(gl: Gl, image?: { width: number; height: number; pixels: Uint8Array }): WebGLTexture {
  let { width, height, pixels } = image ?? { width: 1, height: 1, pixels: new Uint8Array([255, 255, 255, 255]) };
  const most = gl.getParameter(gl.MAX_TEXTURE_SIZE) as number;
  // Larger images lose every other row and column.
  while (width > most || height > most) {
    const [w, h] = [Math.max(width >> 1, 1), Math.max(height >> 1, 1)];
    const from = new Uint32Array(pixels.slice().buffer);
    const half = new Uint32Array(w * h);
    for (let y = 0; y < h; ++y)
      for (let x = 0; x < w; ++x)
        half[y * w + x] = from[Math.min(2 * y, height - 1) * width + Math.min(2 * x, width - 1)];
    [width, height, pixels] = [w, h, new Uint8Array(half.buffer)];
  }
  const texture = gl.createTexture()!;
  gl.activeTexture(gl.TEXTURE0 + units.length);
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  gl.generateMipmap(gl.TEXTURE_2D);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
  return texture;
}

/** A framebuffer over these attachments. */
export function makeTarget(gl: Gl, color: WebGLTexture | null, depth: WebGLTexture | null = null): WebGLFramebuffer {
  const target = gl.createFramebuffer()!;
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  if (color) gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, color, 0);
  else gl.drawBuffers([gl.NONE]);
  if (depth) gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, depth, 0);
  return target;
}

/** Places of the four samples of a pixel, as Vulkan has them, from its upper left corner. */
export const samplePlaces = [
  [0.375, 0.125],
  [0.875, 0.375],
  [0.125, 0.625],
  [0.625, 0.875],
];

/** The picture before its film: multisampled and then resolved, or each sample drawn alone. */
export class Picture {
  /** One texture, or one for each sample. */
  readonly resolved: WebGLTexture[];
  private readonly drawn: WebGLFramebuffer;
  private readonly buffers: WebGLRenderbuffer[];
  private readonly targets: WebGLFramebuffer[];

  constructor(
    private readonly gl: Gl,
    readonly width: number,
    readonly height: number,
    readonly isFine: boolean,
  ) {
    const samples = isFine ? 0 : samplePlaces.length;
    this.drawn = gl.createFramebuffer()!;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.drawn);
    this.buffers = [
      [gl.SRGB8_ALPHA8, gl.COLOR_ATTACHMENT0],
      [gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT],
    ].map(([format, place]) => {
      const buffer = gl.createRenderbuffer()!;
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples, format, width, height);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, buffer);
      return buffer;
    });
    this.resolved = (isFine ? samplePlaces : [0]).map(() => makeTexture(gl, gl.SRGB8_ALPHA8, width, height));
    this.targets = this.resolved.map((texture) => makeTarget(gl, texture));
  }

  begin(): void {
    const gl = this.gl;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.drawn);
    gl.viewport(0, 0, this.width, this.height);
    gl.clearDepth(1);
    gl.clear(gl.DEPTH_BUFFER_BIT | gl.COLOR_BUFFER_BIT);
  }

  /** Copies what is drawn into a texture of `resolved`. */
  end(sample: number): void {
    const gl = this.gl;
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, this.drawn);
    gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, this.targets[sample]);
    const { width, height } = this;
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
  }

  delete(): void {
    const gl = this.gl;
    gl.deleteFramebuffer(this.drawn);
    for (const target of this.targets) gl.deleteFramebuffer(target);
    for (const texture of this.resolved) gl.deleteTexture(texture);
    for (const buffer of this.buffers) gl.deleteRenderbuffer(buffer);
  }
}
