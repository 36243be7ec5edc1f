/**
 * The style of the text over a book: invisible until it is selected. Then it
 * darkens the page as a marker would: overlaps of pieces do not show. (A fully
 * opaque colour would be thinned by the browser.)
 */
export const textStyle: string = /* css */ `
.reading { position: absolute; inset: 0; overflow: hidden; pointer-events: none; }
.reading[hidden] { display: none; }
.text {
  all: initial; display: block; position: absolute; inset: 0; pointer-events: none;
  font: 20px serif; line-height: 1; white-space: pre; color: transparent; text-size-adjust: none;
}
/* What lies on the page has the page's colours: a theme of high contrast would print the text over it. */
.text, .mark { forced-color-adjust: none; }
.text span, .text a, .field, .medium, .mark { position: absolute; left: 0; top: 0; transform-origin: 0 0; }
.text span { z-index: 1; pointer-events: auto; cursor: text; user-select: text; -webkit-user-select: text; }
.text > div, .print { position: absolute; inset: 0; }
.text .heading, .text .pieces { display: contents; }
/* Generated text is read by assistive technology, and neither selected nor found. */
.text .spoken { position: absolute; overflow: clip; white-space: normal; }
.text .spoken::before { content: attr(data-text); }
.text.uncopied span { pointer-events: none; user-select: none; -webkit-user-select: none; }
.text .formula { position: absolute; left: 0; top: 0; transform-origin: 0 0; overflow: hidden; opacity: 0; user-select: none; -webkit-user-select: none; }
.text a { pointer-events: auto; cursor: pointer; border-radius: 2px; outline: 0 solid rgb(60 110 180); }
.text a:hover { background: rgb(60 110 180 / 0.14); }
.text a:focus-visible { outline-width: 2px; }
.field {
  box-sizing: border-box; margin: 0; padding: 0 0.2em; pointer-events: auto; resize: none;
  font-family: sans-serif; color: #1d2430; background: #eef3fb; border: 1px solid rgb(60 110 180 / 0.45); border-radius: 2px;
}
.medium { pointer-events: auto; font: 13px/1.3 sans-serif; color: #1d2430; white-space: normal; overflow: hidden; }
.medium > * { width: 100%; height: 100%; margin: 0; padding: 0; border: 0; background: none; cursor: pointer; }
.medium button { font-size: 20px; color: #fff; text-shadow: 0 0 4px #000, 0 0 2px #000; }
.medium button:disabled { opacity: 0.5; }
.medium video { object-fit: contain; background: #000; }
.print { mix-blend-mode: var(--lay); }
.text ::selection { background: none; }
.text span::selection { color: transparent; background: var(--selected); }
.guard { position: absolute; inset: 0; pointer-events: auto; cursor: text; user-select: none; -webkit-user-select: none; }
.note {
  position: fixed; inset: auto; box-sizing: border-box; margin: 0; padding: 0.9em 1.1em 0.7em; pointer-events: auto;
  width: max-content; max-width: min(26em, calc(100vw - 16px)); max-height: 50vh; overflow: auto;
  font: 15px/1.5 var(--turnleaf-serif, Georgia, serif); color: var(--turnleaf-ink, #2b2622);
  background: var(--turnleaf-surface, #fbfaf7); border: 1px solid var(--turnleaf-line, #ded8ce); border-radius: 6px;
  box-shadow: 0 4px 20px rgb(0 0 0 / 0.22); user-select: text; -webkit-user-select: text;
}
.note:focus { outline: none; }
.note p { margin: 0; overflow-wrap: break-word; white-space: pre-line; }
.note button {
  display: block; margin: 0.6em 0 0 auto; padding: 0.2em 0; border: 0; background: none; cursor: pointer;
  font: 13px var(--turnleaf-font, system-ui, sans-serif); color: var(--turnleaf-accent, #8a3324); text-decoration: underline;
}
.mark { background: var(--hit); mix-blend-mode: var(--lay); border-radius: 2px; }
.mark.here { background: var(--here); }
`;
