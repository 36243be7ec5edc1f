/** The colours and letters of the controls, by theme. */

/** The dark theme's for a selector: asked for by name, or by the system. */
const dark = (selector: string): string => /* css */ `${selector} {
  --turnleaf-surface: #24211e; --turnleaf-field: #302c28; --turnleaf-page: #d9d3c7;
  --turnleaf-ink: #ece5da; --turnleaf-muted: #b3a99b;
  --turnleaf-line: #3d3832; --turnleaf-track: #5b544b; --turnleaf-hover: rgb(255 236 210 / 0.09); --turnleaf-mark: #e8c25c;
}`;

/**
 * What a page may set otherwise for its controls.
 * @cssproperty --turnleaf-surface Ground of the controls.
 * @cssproperty --turnleaf-field Ground of what is written in.
 * @cssproperty --turnleaf-page A thumbnail that is not drawn yet.
 * @cssproperty --turnleaf-ink Words and icons.
 * @cssproperty --turnleaf-muted Words that matter less.
 * @cssproperty --turnleaf-line Lines between the controls.
 * @cssproperty --turnleaf-track The slider's line, where it is not past yet.
 * @cssproperty --turnleaf-hover What is under the pointer.
 * @cssproperty --turnleaf-mark What was found, in the list of places.
 * @cssproperty --turnleaf-font Letters of the controls.
 * @cssproperty --turnleaf-serif Letters of titles.
 */
export const themes: string = /* css */ `
:host {
  --turnleaf-font: system-ui, sans-serif;
  --turnleaf-serif: "Iowan Old Style", "Palatino Linotype", Palatino, Georgia, serif;
  --turnleaf-surface: #fbfaf7; --turnleaf-field: #fff; --turnleaf-page: #fdfaf3;
  --turnleaf-ink: #2b2622; --turnleaf-muted: #655d54;
  --turnleaf-line: #ded8ce; --turnleaf-track: #cbc3b6; --turnleaf-hover: rgb(96 72 48 / 0.09); --turnleaf-mark: #ffdf7e;
}
:host([theme="paper"]) {
  --turnleaf-surface: #f4ecd9; --turnleaf-field: #fbf5e6; --turnleaf-page: #fbf5e8;
  --turnleaf-ink: #3a2e20; --turnleaf-muted: #69583f;
  --turnleaf-line: #ddcfb1; --turnleaf-track: #cbb98f; --turnleaf-hover: rgb(110 78 32 / 0.11);
}
${dark(':host([theme="dark"])')}
@media (prefers-color-scheme: dark) { ${dark(':host(:not([theme="light"], [theme="paper"]))')} }
@media (prefers-contrast: more) {
  :host { --turnleaf-muted: var(--turnleaf-ink); --turnleaf-line: var(--turnleaf-ink); --turnleaf-track: var(--turnleaf-ink); }
}
`;
