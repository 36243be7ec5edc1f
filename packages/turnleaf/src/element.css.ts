/** The desk in the dark theme: by the attribute, or by the system. */
const dark = (selector: string): string => /* css */ `${selector} {
  --turnleaf-desk: radial-gradient(ellipse at 50% 38%, #35302b, #191715 95%);
  --turnleaf-accent: #eba58d; --turnleaf-dim: brightness(0.86); color-scheme: dark;
}`;

/**
 * The element's own style; outside it the page decides. The controls bring
 * their own.
 *
 * @cssproperty --turnleaf-desk Background of the book, if the element has
 * controls or a theme.
 * @cssproperty --turnleaf-accent Selected items, and the focus outline.
 * @cssproperty --turnleaf-dim A filter over the book and its thumbnails.
 */
export const style: string = /* css */ `
:host {
  display: block; position: relative; overflow: hidden; min-height: 12rem;
  --turnleaf-desk: radial-gradient(ellipse at 50% 38%, #efece6, #cfc9be 95%);
  --turnleaf-accent: #8a3324; --turnleaf-dim: none; color-scheme: light;
}
:host([theme="paper"]) {
  --turnleaf-desk: radial-gradient(ellipse at 50% 38%, #dcd5c9, #aba294 90%);
  --turnleaf-accent: #7f2f20;
}
${dark(':host([theme="dark"])')}
@media (prefers-color-scheme: dark) { ${dark(':host(:not([theme="light"], [theme="paper"]))')} }
:host(:is([controls], [theme])) { background: var(--turnleaf-desk); }
.frame:focus { outline: none; }
.frame:focus-visible { outline: 2px solid var(--turnleaf-accent); outline-offset: -2px; }
:host([hidden]) { display: none; }
.frame { position: absolute; inset: 0; container: turnleaf / inline-size; }
.room {
  width: 20rem; padding-top: min(100% / var(--ratio, 1.2), 90vh); visibility: hidden; pointer-events: none;
}
:host([controls]) .room { padding-bottom: 100px; }
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
