/** A block of uniforms in memory, written by the paths of its members (src/generated/layout.ts). */
export class Block {
  readonly bytes: ArrayBuffer;
  private readonly asFloats: Float32Array;
  private readonly asWords: Uint32Array;

  constructor(
    private readonly layout: Record<string, number>,
    size: number,
  ) {
    this.bytes = new ArrayBuffer(size);
    this.asFloats = new Float32Array(this.bytes);
    this.asWords = new Uint32Array(this.bytes);
  }

  floats(path: string, values: readonly number[]): void {
    this.asFloats.set(values, this.at(path));
  }

  words(path: string, values: readonly number[]): void {
    this.asWords.set(values, this.at(path));
  }

  private at(path: string): number {
    const offset = this.layout[path];
    if (offset === undefined) throw new Error(`the block has no member ${path}`);
    return offset / 4;
  }
}
