/** The colours and letters of the controls, by theme. */

/** Returns the rules of night for a selector: by the attribute, or by the system. */
const night = (selector: string): string => /* css */ `${selector} {
  --turnleaf-surface: #201e1c; --turnleaf-field: #2b2825; --turnleaf-page: #1c1b1a;
  --turnleaf-ink: #e2dcd2; --turnleaf-muted: #b3a99b;
  --turnleaf-line: #38332e; --turnleaf-track: #5b544b; --turnleaf-hover: rgb(255 236 210 / 0.09); --turnleaf-mark: #e8c25c;
}`;

/**
 * The properties that a page may set for its controls.
 *
 * @cssproperty --turnleaf-surface Background of the controls.
 * @cssproperty --turnleaf-field Background of fields.
 * @cssproperty --turnleaf-page A thumbnail that is not drawn yet.
 * @cssproperty --turnleaf-ink Text and icons.
 * @cssproperty --turnleaf-muted Less important text.
 * @cssproperty --turnleaf-line Lines between the controls.
 * @cssproperty --turnleaf-track The slider's track after the thumb.
 * @cssproperty --turnleaf-hover Background under the pointer.
 * @cssproperty --turnleaf-mark Hits in the list of places.
 * @cssproperty --turnleaf-font Font of the controls.
 * @cssproperty --turnleaf-serif Font of titles.
 */
export const themes: string = /* css */ `
:host {
  --turnleaf-font: system-ui, sans-serif;
  --turnleaf-serif: "Iowan Old Style", "Palatino Linotype", Palatino, Georgia, serif;
  --turnleaf-surface: #fbfaf7; --turnleaf-field: #fff; --turnleaf-page: #fdfaf3;
  --turnleaf-ink: #2b2622; --turnleaf-muted: #5c554d;
  --turnleaf-line: #ded8ce; --turnleaf-track: #cbc3b6; --turnleaf-hover: rgb(96 72 48 / 0.09); --turnleaf-mark: #ffdf7e;
}
:host([theme="sepia"]) {
  --turnleaf-surface: #f4ecd9; --turnleaf-field: #fbf5e6; --turnleaf-page: #fbf5e8;
  --turnleaf-ink: #3a2e20; --turnleaf-muted: #5c4c35;
  --turnleaf-line: #ddcfb1; --turnleaf-track: #cbb98f; --turnleaf-hover: rgb(110 78 32 / 0.11);
}
:host([theme="grey"]) {
  --turnleaf-surface: #3a3937; --turnleaf-field: #454341; --turnleaf-page: #3f3e3d;
  --turnleaf-ink: #f1eeea; --turnleaf-muted: #cfcac3;
  --turnleaf-line: #55524e; --turnleaf-track: #77736d; --turnleaf-hover: rgb(255 245 230 / 0.1); --turnleaf-mark: #e8c25c;
}
${night(':host([theme="night"])')}
@media (prefers-color-scheme: dark) { ${night(':host(:not([theme="light"], [theme="sepia"], [theme="grey"]))')} }
@media (prefers-contrast: more) {
  :host { --turnleaf-muted: var(--turnleaf-ink); --turnleaf-line: var(--turnleaf-ink); --turnleaf-track: var(--turnleaf-ink); }
}
`;
