import { fail } from "./error";

const longestShown = 80;

function shown(value: unknown): string {
  const text = JSON.stringify(value) ?? "nothing";
  return text.length <= longestShown ? text : `${text.slice(0, longestShown)}…`;
}

/** Reads the keys of a JSON object strictly; messages name the key, the value and the bound. */
export class SettingsReader {
  private readonly object: Record<string, unknown>;
  private readonly known = new Set<string>();

  constructor(
    value: unknown,
    readonly place: string,
  ) {
    if (typeof value !== "object" || value === null || Array.isArray(value))
      fail("input", `${place}: expected an object {…}, found ${shown(value)}`);
    this.object = value as Record<string, unknown>;
  }

  /** The value of a key, undefined if it is absent. */
  value(key: string): unknown {
    this.known.add(key);
    return Object.hasOwn(this.object, key) ? this.object[key] : undefined;
  }

  placeOf(key: string): string {
    return `${this.place}.${key}`;
  }

  number(key: string, usual: number, low: number, high: number): number {
    const value = this.value(key);
    return value === undefined ? usual : this.checked(value, key, low, high);
  }

  vector(key: string, usual: number[], low: number, high: number): number[] {
    const value = this.value(key);
    if (value === undefined) return usual;
    if (!Array.isArray(value) || value.length !== usual.length)
      fail("input", `${this.placeOf(key)}: expected an array of ${usual.length} numbers, found ${shown(value)}`);
    return value.map((one) => this.checked(one, key, low, high));
  }

  /** A range of two numbers, or one number for both. */
  range(key: string, usual: number[], low: number, high: number): number[] {
    const value = this.value(key);
    if (typeof value !== "number") return this.vector(key, usual, low, high);
    const one = this.checked(value, key, low, high);
    return [one, one];
  }

  text(key: string, usual: string): string {
    const value = this.value(key);
    if (value === undefined) return usual;
    if (typeof value !== "string")
      fail("input", `${this.placeOf(key)}: expected a text, found ${shown(value)}`);
    return value;
  }

  /** The place of a word among `words`. */
  word(key: string, words: readonly string[], usual: number): number {
    const value = this.value(key);
    if (value === undefined) return usual;
    const found = words.indexOf(value as string);
    if (found < 0)
      fail("input", `${this.placeOf(key)}: ${shown(value)} is none of ${words.join(", ")}`);
    return found;
  }

  array(key: string): unknown[] {
    const value = this.value(key);
    if (!Array.isArray(value))
      fail("input", `${this.placeOf(key)}: expected an array, found ${shown(value)}`);
    return value;
  }

  child(key: string): SettingsReader {
    return new SettingsReader(this.value(key), this.placeOf(key));
  }

  /** Refuses keys that were not read. */
  finish(): void {
    for (const key of Object.keys(this.object))
      if (!this.known.has(key)) fail("input", `${this.place}: unknown key "${key}"`);
  }

  private checked(value: unknown, key: string, low: number, high: number): number {
    if (typeof value !== "number")
      fail("input", `${this.placeOf(key)}: expected a number, found ${shown(value)}`);
    if (!(value >= low && value <= high))
      fail("input", `${this.placeOf(key)}: ${value} is outside [${low}, ${high}]`);
    return value;
  }
}

/** Parses JSON; messages begin with `place`. */
export function parseJson(text: string, place: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    fail("input", `${place}: not valid JSON`);
  }
}
