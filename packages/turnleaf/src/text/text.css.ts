/** How the text over a book looks: not at all, until it is selected. */
export const textStyle: string = `
.reading { position: absolute; inset: 0; overflow: hidden; pointer-events: none; }
.reading[hidden] { display: none; }
.text {
  all: initial; display: block; position: absolute; inset: 0; isolation: isolate; pointer-events: none;
  font: 20px serif; line-height: 1; white-space: pre; color: transparent; text-size-adjust: none;
}
.text span, .text a, .field, .mark { position: absolute; left: 0; top: 0; transform-origin: 0 0; }
.text span { z-index: 1; pointer-events: auto; cursor: text; user-select: text; -webkit-user-select: text; }
.text.uncopied span { pointer-events: none; user-select: none; -webkit-user-select: none; }
.text a { z-index: 2; pointer-events: auto; cursor: pointer; border-radius: 2px; outline: 0 solid rgb(60 110 180); }
.text a:hover { background: rgb(60 110 180 / 0.14); }
.text a:focus-visible { outline-width: 2px; }
.field {
  z-index: 2; box-sizing: border-box; margin: 0; padding: 0 0.2em; pointer-events: auto; resize: none;
  font-family: sans-serif; color: #1d2430; background: #eef3fb; border: 1px solid rgb(60 110 180 / 0.45); border-radius: 2px;
}
.text span::selection { color: transparent; background: rgb(60 110 180 / 0.32); }
.guard { position: absolute; inset: 0; pointer-events: auto; cursor: text; user-select: none; -webkit-user-select: none; }
.mark { background: rgb(255 214 90 / 0.55); mix-blend-mode: multiply; border-radius: 2px; }
.mark.strong { background: rgb(255 176 32 / 0.85); }
`;
