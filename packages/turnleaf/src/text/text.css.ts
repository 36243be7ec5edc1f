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
.text span, .text a, .field, .mark { position: absolute; left: 0; top: 0; transform-origin: 0 0; }
.text span { z-index: 1; pointer-events: auto; cursor: text; user-select: text; -webkit-user-select: text; }
.text.uncopied span { pointer-events: none; user-select: none; -webkit-user-select: none; }
.text a { pointer-events: auto; cursor: pointer; border-radius: 2px; outline: 0 solid rgb(60 110 180); }
.text a:hover { background: rgb(60 110 180 / 0.14); }
.text a:focus-visible { outline-width: 2px; }
.field {
  box-sizing: border-box; margin: 0; padding: 0 0.2em; pointer-events: auto; resize: none;
  font-family: sans-serif; color: #1d2430; background: #eef3fb; border: 1px solid rgb(60 110 180 / 0.45); border-radius: 2px;
}
.print { mix-blend-mode: multiply; }
.text span::selection { color: transparent; background: rgb(178 203 238 / 0.996); }
.guard { position: absolute; inset: 0; pointer-events: auto; cursor: text; user-select: none; -webkit-user-select: none; }
.mark { background: rgb(255 214 90 / 0.55); mix-blend-mode: multiply; border-radius: 2px; }
.mark.here { background: rgb(255 176 32 / 0.85); }
`;
