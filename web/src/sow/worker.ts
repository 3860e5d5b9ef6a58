import { Sower } from "./sower";
import type { ToSower } from "./sower";

/** Name of the worker in which the script sows. */
export const sowerName = "sward-sower";

/** What this script needs of a worker's global scope. */
interface Scope {
  name?: string;
  WorkerGlobalScope?: unknown;
  onmessage: ((event: MessageEvent) => void) | null;
  postMessage(message: unknown, moved: ArrayBuffer[]): void;
}

/** In a worker of this name the script sows; elsewhere it does nothing by itself. */
const scope = globalThis as unknown as Scope;
if (scope.WorkerGlobalScope !== undefined && scope.name === sowerName) {
  const sower = new Sower(
    (message, moved) => scope.postMessage(message, moved),
    // Messages that have come are heard first.
    (step) => setTimeout(step),
  );
  scope.onmessage = (event) => sower.hear(event.data as ToSower);
}
