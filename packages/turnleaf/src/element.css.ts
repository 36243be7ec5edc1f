/** The element's own style; what it looks like outside is the page's to say. */
export const style: string = `
:host { display: block; position: relative; overflow: hidden; min-height: 12rem; outline: none; }
:host(:focus-visible) { outline: 2px solid rgb(60 110 180 / 0.7); outline-offset: -2px; }
:host([hidden]) { display: none; }
[part="stage"] { position: absolute; inset: 0; overflow: hidden; }
canvas { position: absolute; inset: 0; width: 100%; height: 100%; display: block; touch-action: pan-y; }
[part="message"] {
  position: absolute; inset: 0; margin: auto; width: min(20rem, 70%); aspect-ratio: 2 / 3; max-height: 84%;
  display: grid; place-content: center; box-sizing: border-box; padding: 2rem; text-align: center;
  background: #fbf5e8; color: #211d1a; font: italic 1.05rem/1.5 Georgia, serif; text-wrap: balance;
  border-radius: 1px 3px 3px 1px; box-shadow: 0 0.1rem 0.4rem rgb(40 30 20 / 0.25), 0 1rem 3rem rgb(40 30 20 / 0.2);
}
[part="message"][role="status"] { color: rgb(33 29 26 / 0.5); }
[part="message"][hidden] { display: none; }
.live { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
`;
