/** The dark theme's colours for a selector: asked for by name, or by the system. */
const dark = (selector: string): string => /* css */ `${selector} {
  --turnleaf-desk: radial-gradient(ellipse at 50% 38%, #35302b, #191715 95%);
  --turnleaf-surface: #24211e; --turnleaf-field: #302c28; --turnleaf-page: #d9d3c7;
  --turnleaf-ink: #ece5da; --turnleaf-muted: #b3a99b; --turnleaf-accent: #eba58d;
  --turnleaf-line: #3d3832; --turnleaf-track: #5b544b; --turnleaf-hover: rgb(255 236 210 / 0.09); --turnleaf-mark: #e8c25c;
  --turnleaf-dim: brightness(0.86); color-scheme: dark;
}`;

/**
 * The element's own style; what it looks like outside is the page's to say.
 * @cssproperty --turnleaf-desk What lies about the book, where the element has controls or a theme.
 * @cssproperty --turnleaf-surface Ground of the controls.
 * @cssproperty --turnleaf-field Ground of what is written in.
 * @cssproperty --turnleaf-page A thumbnail that is not drawn yet.
 * @cssproperty --turnleaf-ink Words and icons.
 * @cssproperty --turnleaf-muted Words that matter less.
 * @cssproperty --turnleaf-accent What is chosen, and the outline of what has the focus.
 * @cssproperty --turnleaf-line Lines between the controls.
 * @cssproperty --turnleaf-track The slider's line, where it is not past yet.
 * @cssproperty --turnleaf-hover What is under the pointer.
 * @cssproperty --turnleaf-mark What was found, in the list of places.
 * @cssproperty --turnleaf-dim A filter over the book and its thumbnails.
 * @cssproperty --turnleaf-font Letters of the controls.
 * @cssproperty --turnleaf-serif Letters of titles.
 */
export const style: string = /* css */ `
:host {
  display: block; position: relative; overflow: hidden; min-height: 12rem; outline: none;
  --turnleaf-font: system-ui, sans-serif;
  --turnleaf-serif: "Iowan Old Style", "Palatino Linotype", Palatino, Georgia, serif;
  --turnleaf-desk: radial-gradient(ellipse at 50% 38%, #efece6, #cfc9be 95%);
  --turnleaf-surface: #fbfaf7; --turnleaf-field: #fff; --turnleaf-page: #fdfaf3;
  --turnleaf-ink: #2b2622; --turnleaf-muted: #655d54; --turnleaf-accent: #8a3324;
  --turnleaf-line: #ded8ce; --turnleaf-track: #cbc3b6; --turnleaf-hover: rgb(96 72 48 / 0.09); --turnleaf-mark: #ffdf7e;
  --turnleaf-dim: none; color-scheme: light;
}
:host([theme="paper"]) {
  --turnleaf-desk: radial-gradient(ellipse at 50% 38%, #dcd5c9, #aba294 90%);
  --turnleaf-surface: #f4ecd9; --turnleaf-field: #fbf5e6; --turnleaf-page: #fbf5e8;
  --turnleaf-ink: #3a2e20; --turnleaf-muted: #69583f; --turnleaf-accent: #7f2f20;
  --turnleaf-line: #ddcfb1; --turnleaf-track: #cbb98f; --turnleaf-hover: rgb(110 78 32 / 0.11);
}
${dark(':host([theme="dark"])')}
@media (prefers-color-scheme: dark) { ${dark(':host(:not([theme="light"], [theme="paper"]))')} }
@media (prefers-contrast: more) {
  :host { --turnleaf-muted: var(--turnleaf-ink); --turnleaf-line: var(--turnleaf-ink); --turnleaf-track: var(--turnleaf-ink); }
}
:host(:is([controls], [theme])) { background: var(--turnleaf-desk); }
:host(:focus-visible) { outline: 2px solid var(--turnleaf-accent); outline-offset: -2px; }
:host([hidden]) { display: none; }
.frame { position: absolute; inset: 0; container: turnleaf / inline-size; }
[part="stage"] { position: absolute; inset: 0; overflow: hidden; color-scheme: light; }
:host([controls]) [part="stage"] { inset-block: 48px 52px; }
[part="canvas"] { position: absolute; inset: 0; width: 100%; height: 100%; display: block; }
:host(:is([controls], [theme])) [part="canvas"] { filter: var(--turnleaf-dim); }
[part="message"] {
  position: absolute; inset: 0; margin: auto; width: min(20rem, 70%); aspect-ratio: 2 / 3; max-height: 84%;
  display: grid; place-content: center; box-sizing: border-box; padding: 2rem; text-align: center;
  background: #fbf5e8; color: #211d1a; font: italic 1.05rem/1.5 Georgia, serif; text-wrap: balance;
  border-radius: 1px 3px 3px 1px; box-shadow: 0 0.1rem 0.4rem rgb(40 30 20 / 0.25), 0 1rem 3rem rgb(40 30 20 / 0.2);
}
[part="message"][role="status"] { color: rgb(33 29 26 / 0.7); }
[part="message"][hidden] { display: none; }
.live { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
`;
