import { fail } from "./error";

/** What an option may be: in words for the message, and the test. */
export type Rule = readonly [allowed: string, test: (value: never) => boolean];

/** A value in a message. */
function shown(value: unknown): string {
  const text = typeof value === "function" ? "a function" : (JSON.stringify(value) ?? String(value));
  return text.length > 80 ? `${text.slice(0, 79)}…` : text;
}

/** Fails with what is allowed, unless `isAllowed`. */
export function expectOption(place: string, value: unknown, allowed: string, isAllowed: boolean): void {
  if (!isAllowed) fail("usage", `${place}: ${shown(value)} is not ${allowed}`);
}

/** A number of a range, or an error that names it. */
export function numberIn(place: string, value: unknown, low: number, high: number): number {
  expectOption(place, value, `a number from ${low} to ${high}`, typeof value === "number" && value >= low && value <= high);
  return value as number;
}

/** Checks the options of a call: `needed` one must be there, all must be known and as `rules` say. */
export function checkOptions(place: string, options: unknown, rules: Record<string, Rule>, needed?: string): void {
  const isObject = typeof options === "object" && options !== null;
  expectOption(place, options, `an object with some of ${Object.keys(rules).join(", ")}`, isObject);
  const values = options as Record<string, unknown>;
  for (const name of Object.keys(values))
    if (!Object.hasOwn(rules, name)) fail("usage", `${place}: no option ${name}; there are ${Object.keys(rules).join(", ")}`);
  for (const [name, [allowed, test]] of Object.entries(rules))
    if (values[name] !== undefined || name === needed)
      expectOption(`${place}: option ${name}`, values[name], allowed, test(values[name] as never));
}

/** Rules that several calls share. */
export const address: Rule = ["the address of a file", (value: unknown) => (typeof value === "string" && value !== "") || value instanceof URL];
export const flag: Rule = ["true or false", (value: unknown) => typeof value === "boolean"];
export const callback: Rule = ["a function", (value: unknown) => typeof value === "function"];
