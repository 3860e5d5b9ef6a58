/** Kinds of errors, as the exit codes of `sward`: usage 1, io 2, input 3, runtime 4, unsupported 5. */
export type ErrorKind = "usage" | "io" | "input" | "runtime" | "unsupported";

/** An error with its kind. The message names the file, the thing, the value and the bound. */
export class SwardError extends Error {
  readonly kind: ErrorKind;

  constructor(kind: ErrorKind, message: string) {
    super(message);
    this.name = "SwardError";
    this.kind = kind;
  }
}

/** Throws a SwardError. */
export function fail(kind: ErrorKind, message: string): never {
  throw new SwardError(kind, message);
}
