/**
 * What showField() makes fills its element, whatever the styles of the host. The element itself gets the weakest rules:
 * those of the host win. Without a height of its own it is as high as a picture of 16:9.
 */
const text = `
:where(.sward) { position: relative; overflow: hidden; isolation: isolate; }
:where(.sward)::before { content: ""; display: block; padding-top: 56.25%; }
.sward > canvas { position: absolute; left: 0; top: 0; width: 100%; height: 100%; margin: 0; display: block; touch-action: none;
  outline-offset: -3px; }
.sward-poster { position: absolute; inset: 0; width: 100%; height: 100%; object-fit: cover; pointer-events: none;
  transition: opacity .4s; }
.sward-gone { opacity: 0; }
@media (prefers-reduced-motion: reduce) { .sward-poster { transition: none; } }
.sward-message, .sward-tools, .sward-note { box-sizing: border-box; color: #fff; font: 15px/1.4 system-ui, sans-serif; text-align: left; }
.sward-message { position: absolute; left: 50%; top: 45%; transform: translate(-50%, -50%); margin: 0; padding: .6em 1em;
  width: max-content; max-width: min(44em, 88%); border-radius: .5em; background: #0009; overflow-wrap: anywhere; }
.sward-message:not(.sward-error):has(~ .sward-tools) { left: auto; right: .8em; top: .8em; transform: none; font-size: 13px; }
.sward-message[hidden], .sward-progress[hidden] { display: none; }
.sward-progress { position: absolute; left: 0; top: 0; width: 100%; height: 4px; border: 0; appearance: none;
  background: #0003; accent-color: #8bc34a; }
.sward-tools { position: absolute; left: .8em; bottom: .8em; max-width: calc(100% - 1.6em); max-height: calc(100% - 1.6em);
  overflow: auto; padding: .3em .7em; border-radius: .6em; background: #0a140a99; }
.sward-tools summary { cursor: pointer; }
.sward-tools > div { display: flex; flex-wrap: wrap; gap: .5em; align-items: center; padding: .3em 0; }
.sward-tools button, .sward-tools select { font: inherit; color: inherit; background: #fff2; border: 1px solid #fff4;
  border-radius: .4em; padding: .2em .7em; min-height: 2em; max-width: 100%; cursor: pointer; }
.sward-tools option { color: #000; background: #fff; }
.sward-tools button[aria-pressed=true] { background: #6a9a3c; }
.sward-tools :focus-visible { outline: 2px solid #fff; outline-offset: 1px; }
.sward-tools label { display: flex; gap: .4em; align-items: center; }
.sward-tools input { width: 7em; accent-color: #8bc34a; }
.sward-tools output { min-width: 3.2em; font-variant-numeric: tabular-nums; }
.sward-note:empty { display: none; }
.sward-note { position: absolute; left: .8em; top: .6em; max-width: 60%; font-size: 13px; opacity: .85; text-shadow: 0 0 3px #000;
  pointer-events: none; }
`;

const styled = new WeakSet<Node>();

/** Brings the styles into the document, or the shadow tree, of an element. */
export function addStyles(element: HTMLElement): void {
  const own = element.getRootNode();
  const root = own instanceof ShadowRoot ? own : element.ownerDocument;
  if (styled.has(root)) return;
  styled.add(root);
  try {
    // A policy for styles that a page has does not forbid these.
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(text);
    root.adoptedStyleSheets = [...root.adoptedStyleSheets, sheet];
  } catch {
    // Browsers before 2023, and documents of a frame.
    const style = element.ownerDocument.createElement("style");
    style.textContent = text;
    (root instanceof ShadowRoot ? root : root.head).append(style);
  }
}
