/** Width of the panel where it does not fill the element, CSS pixels. */
export const panelWidth = 304;

/** How the controls look. Colours are the themes'. */
export const style: string = /* css */ `
.frame { --wide: ${panelWidth}px; }
.ui { color: var(--turnleaf-ink); font: max(14px, 0.875rem)/1.4 var(--turnleaf-font); accent-color: var(--turnleaf-accent); }
/* What is selected is the book's text, and not the title or the number of the page with it. */
.ui { user-select: none; -webkit-user-select: none; }
.ui input:focus { user-select: text; -webkit-user-select: text; }
.ui[hidden], .ui [hidden] { display: none !important; }
.unseen { position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); }
.ui button, .ui input { font: inherit; color: inherit; }
.ui button { border: 0; background: none; padding: 0; cursor: pointer; -webkit-tap-highlight-color: transparent; touch-action: manipulation; }
.ui svg { width: 22px; height: 22px; fill: none; stroke: currentColor; stroke-width: 1.5; stroke-linecap: round; stroke-linejoin: round; display: block; flex: none; }
.ui :focus-visible { outline: 2px solid var(--turnleaf-accent); outline-offset: -2px; }
.frame.pressed .ui :focus-visible:not(input) { outline: none; }
[part~="button"] { width: 44px; height: 44px; display: grid; place-items: center; border-radius: 10px; flex: none; transition: background 0.15s; }
@media (hover: hover) { [part~="button"]:hover, .line:is(button, a):hover, .menu button:hover, .tabs button:hover { background: var(--turnleaf-hover); } }
.ui [aria-disabled="true"] { opacity: 0.35; cursor: default; }
[part~="button"]:is([aria-expanded="true"], [aria-pressed="true"]), .tabs [aria-selected="true"] { color: var(--turnleaf-accent); background: var(--turnleaf-hover); }
[part~="button"][aria-pressed="true"] path { fill: currentColor; }

.bar, .pages, .panel { position: absolute; inset-inline: 0; box-sizing: border-box; background: var(--turnleaf-surface); z-index: 2; }
.bar { top: 0; height: 48px; display: flex; align-items: center; padding-inline: 4px; border-bottom: 1px solid var(--turnleaf-line); z-index: 4; }
.group { display: flex; flex: 1 1 0; min-width: max-content; }
.end { justify-content: flex-end; }
.title { overflow: hidden; white-space: nowrap; text-overflow: ellipsis; padding-inline: 12px; color: var(--turnleaf-muted); font-family: var(--turnleaf-serif); font-size: 1.07em; }
.pages { bottom: 0; height: 52px; display: flex; align-items: center; gap: 2px; padding-inline: 4px; border-top: 1px solid var(--turnleaf-line); }
.pages[dir="rtl"] > button svg { scale: -1 1; }
.place { display: flex; align-items: center; gap: 6px; margin: 0; padding-inline: 8px 10px; font-variant-numeric: tabular-nums; white-space: nowrap; color: var(--turnleaf-muted); }
.ui .entry { box-sizing: border-box; height: 32px; min-width: 44px; max-width: 9ch; width: 6ch; field-sizing: content; padding: 0 8px; border: 1px solid var(--turnleaf-line); border-radius: 7px; background: var(--turnleaf-field); color: var(--turnleaf-ink); text-align: center; }
.ui .entry[aria-invalid="true"] { border-color: var(--turnleaf-accent); color: var(--turnleaf-accent); }

.ui .return { position: absolute; bottom: 60px; inset-inline: 0; width: max-content; margin-inline: auto; min-height: 44px; padding-inline: 18px; border-radius: 22px; background: var(--turnleaf-surface); color: var(--turnleaf-accent); box-shadow: 0 1px 6px rgb(0 0 0 / 0.25); }

.track { position: relative; flex: 1; height: 44px; margin-inline: 6px; }
.track input { appearance: none; width: 100%; height: 100%; margin: 0; background: none; cursor: pointer; touch-action: none; border-radius: 8px; }
.track { --past: linear-gradient(to right, var(--turnleaf-accent) calc(9px + var(--fraction, 0) * (100% - 18px)), var(--turnleaf-track) 0); }
[dir="rtl"] > .track { --past: linear-gradient(to left, var(--turnleaf-accent) calc(9px + var(--fraction, 0) * (100% - 18px)), var(--turnleaf-track) 0); }
.track input::-webkit-slider-runnable-track { height: 4px; border-radius: 2px; background: var(--past); }
.track input::-moz-range-track { height: 4px; border-radius: 2px; background: var(--past); }
.track input::-webkit-slider-thumb { appearance: none; width: 18px; height: 18px; margin-top: -7px; border: 2px solid var(--turnleaf-surface); border-radius: 50%; background: var(--turnleaf-accent); box-shadow: 0 1px 3px rgb(0 0 0 / 0.3); }
.track input::-moz-range-thumb { box-sizing: border-box; width: 18px; height: 18px; border: 2px solid var(--turnleaf-surface); border-radius: 50%; background: var(--turnleaf-accent); }
.bubble { position: absolute; bottom: 54px; inset-inline-start: calc(var(--fraction, 0) * 100%); translate: calc(var(--fraction, 0) * -100%) 0; padding: 3px 12px; border-radius: 8px; background: var(--turnleaf-ink); color: var(--turnleaf-surface); font-variant-numeric: tabular-nums; white-space: nowrap; opacity: 0; pointer-events: none; transition: opacity 0.15s; }
[dir="rtl"] > .track .bubble { translate: calc(var(--fraction, 0) * 100%) 0; }
.held .bubble { opacity: 1; }

.panel { top: 48px; bottom: 52px; inset-inline-end: auto; width: var(--wide); display: flex; flex-direction: column; border-inline-end: 1px solid var(--turnleaf-line); z-index: 3; }
.frame.open.shared > [part="stage"] { inset-inline-start: var(--wide); }
.head { display: flex; padding: 4px; border-bottom: 1px solid var(--turnleaf-line); }
.head h2 { flex: 1; margin: 0; padding-inline: 12px; align-self: center; font: 1.15em var(--turnleaf-serif); }
.tabs { display: flex; flex: 1; gap: 2px; }
.tabs button { flex: 1; height: 44px; display: grid; place-items: center; border-radius: 10px; color: var(--turnleaf-muted); }
.body { flex: 1; min-height: 0; position: relative; }
.view { position: absolute; inset: 0; overflow: auto; overscroll-behavior: contain; padding: 6px; box-sizing: border-box; scrollbar-width: thin; scrollbar-color: var(--turnleaf-track) transparent; }
.remark { margin: 0; padding: 8px 10px; color: var(--turnleaf-muted); }
.contents, .rows { list-style: none; margin: 0; padding: 0; }
.details { list-style: none; margin: 8px 0 0; padding: 8px 10px; border-top: 1px solid var(--turnleaf-line); overflow-wrap: anywhere; }
.details li { margin-block: 4px; }
.details a { color: inherit; }
.warnings { color: var(--turnleaf-muted); }
.warnings summary { min-height: 32px; cursor: pointer; }
.warnings ul { margin: 0; padding-inline-start: 16px; }
.warnings button { color: inherit; text-decoration: underline; }
.contents .contents { padding-inline-start: 14px; }
.line { box-sizing: border-box; width: 100%; min-height: 44px; display: flex; justify-content: space-between; align-items: baseline; gap: 12px; padding: 11px 10px !important; border-radius: 8px; text-align: start; text-decoration: none; color: inherit; overflow-wrap: anywhere; }
.line .label { color: var(--turnleaf-muted); font-variant-numeric: tabular-nums; flex: none; }
.line[aria-current] { background: var(--turnleaf-hover); color: var(--turnleaf-accent); }
.line[aria-current] .label { color: inherit; }
.row { display: flex; }
.row [part~="button"] svg { width: 16px; }
.hit { display: block; }
.hit .label { display: block; font-size: 0.86em; }
.hit mark { background: var(--turnleaf-mark); color: #2b2116; border-radius: 2px; padding: 0 1px; }
.sample { box-sizing: border-box; height: 108px; margin: 0 4px 8px; padding: 12px 16px; overflow: hidden; border: 1px solid var(--turnleaf-line); border-radius: 10px; overflow-wrap: break-word; }
.choice { display: flex; flex-wrap: wrap; align-items: center; justify-content: space-between; gap: 2px 12px; min-height: 48px; padding-inline: 8px; }
.what { color: var(--turnleaf-muted); }
.segments, .stepper { display: flex; align-items: stretch; border-radius: 10px; background: var(--turnleaf-hover); }
.segments { flex: 1 1 100%; padding: 2px; margin-bottom: 8px; }
.segments button { flex: 1 1 auto; min-height: 40px; padding-inline: 6px; border-radius: 8px; font-size: 0.93em; overflow-wrap: anywhere; }
.segments [aria-checked="true"] { background: var(--turnleaf-surface); color: var(--turnleaf-accent); box-shadow: 0 1px 3px rgb(0 0 0 / 0.22); }
.faces .segments { display: grid; grid-template-columns: repeat(auto-fit, minmax(100px, 1fr)); gap: 2px; }
.faces button { display: flex; flex-direction: column; align-items: center; justify-content: center; padding: 6px 2px; font-size: 0.8em; }
.faces b { font-size: 22px; font-weight: normal; line-height: 1.3; }
.stepper { margin-block: 2px; }
.stepper button { width: 48px; min-height: 40px; font-size: 1.3em; border-radius: 10px; }
.stepper .value { min-width: 76px; align-self: center; text-align: center; font-variant-numeric: tabular-nums; font-size: 0.93em; }
.sizes .stepper { flex: 1 1 100%; }
.sizes .what { display: none; }
.sizes .stepper button { flex: 1; min-height: 44px; font-family: var(--turnleaf-serif); font-size: 15px; }
.sizes .stepper button:last-child { font-size: 24px; }
@media (hover: hover) { .segments button:not([aria-checked="true"]):hover, .stepper button:hover { background: var(--turnleaf-hover); } }
.found { display: flex; flex-direction: column; }
.ask { display: flex; align-items: center; margin: 0; position: sticky; top: 0; z-index: 1; }
.ask svg { position: absolute; inset-inline-start: 10px; width: 18px; color: var(--turnleaf-muted); pointer-events: none; }
.ui .query { flex: 1; min-width: 0; height: 44px; padding-inline: 36px 8px; border: 1px solid var(--turnleaf-line); border-radius: 10px; background: var(--turnleaf-field); appearance: none; }
.query::-webkit-search-cancel-button { filter: grayscale(1); }
.ui .query::placeholder { color: var(--turnleaf-muted); opacity: 1; }
.thumbnails { padding: 0; }
.sheet { position: relative; list-style: none; margin: 0 12px; padding: 0; }
.sheet li { position: absolute; width: 50%; height: 192px; }
.sheet button { width: 100%; height: 100%; display: flex; flex-direction: column; align-items: center; justify-content: flex-end; gap: 6px; padding-bottom: 8px; border-radius: 10px; color: var(--turnleaf-muted); font-variant-numeric: tabular-nums; }
.small { max-width: 104px; max-height: 150px; background: var(--turnleaf-page); box-shadow: 0 1px 4px rgb(0 0 0 / 0.28); }
.small:not(.drawn) { width: 100px; height: 140px; opacity: 0.45; }
.sheet .seen .small { box-shadow: 0 0 0 2px var(--turnleaf-surface), 0 0 0 4px var(--turnleaf-track); }
.sheet [aria-current] { color: var(--turnleaf-accent); font-weight: 600; }
.sheet [aria-current] .small { box-shadow: 0 0 0 2px var(--turnleaf-surface), 0 0 0 4px var(--turnleaf-accent); }

.menu, .dialog { background: var(--turnleaf-surface); color: var(--turnleaf-ink); border: 1px solid var(--turnleaf-line); border-radius: 12px; box-shadow: 0 6px 28px rgb(0 0 0 / 0.22); }
.menu { position: absolute; top: 46px; inset-inline-end: 6px; min-width: 220px; max-height: min(70vh, 480px); overflow: auto; padding: 6px; z-index: 5; }
.menu button { width: 100%; min-height: 44px; display: flex; align-items: center; gap: 12px; padding: 0 12px 0 10px; border-radius: 8px; text-align: start; }
.menu svg { color: var(--turnleaf-muted); }
.menu [aria-checked="true"] { color: var(--turnleaf-accent); }
.menu [aria-checked="true"] svg { color: inherit; }
.menu [role="menuitemcheckbox"][aria-checked="true"]::after { content: ""; width: 11px; height: 6px; margin-inline-start: auto; border: solid currentColor; border-width: 0 0 2px 2px; rotate: -45deg; translate: 0 -2px; }
.themes { margin-top: 6px; padding-top: 6px; border-top: 1px solid var(--turnleaf-line); }
.swatches { display: grid; grid-template-columns: repeat(5, 1fr); }
.themes button { min-height: 44px; border-radius: 8px; }
.swatches button { display: flex; flex-direction: column; align-items: center; justify-content: center; gap: 5px; padding: 8px 2px; font-size: 0.86em; }
.dark-pages { display: flex; align-items: center; gap: 4px; padding-inline-start: 10px; }
.dark-pages .label { flex: 1; color: var(--turnleaf-muted); }
.dark-pages button { width: auto; padding: 0 12px; }
.themes [aria-checked="true"] { color: var(--turnleaf-accent); background: var(--turnleaf-hover); }
.swatch { width: 26px; height: 26px; border-radius: 50%; border: 1px solid var(--turnleaf-muted); box-sizing: border-box; }
[aria-checked="true"] .swatch { outline: 2px solid; outline-offset: 2px; }
.swatch.light { background: #fbfaf8; }
.swatch.sepia { background: #ecdcb8; }
.swatch.grey { background: #55534f; }
.swatch.night { background: #171614; }
.swatch.auto { background: linear-gradient(135deg, #fbfaf8 50%, #171614 50%); }
.dialog { padding: 20px 24px; min-width: 260px; box-sizing: border-box; max-width: calc(100vw - 32px); }
.dialog::backdrop { background: rgb(0 0 0 / 0.35); }
.dialog h2 { margin: 0 0 12px; font: 1.2em var(--turnleaf-serif); }
.dialog label { display: flex; align-items: center; justify-content: space-between; gap: 16px; min-height: 44px; }
.dialog .entry { width: 12ch; max-width: none; }
.dialog .remark { padding-inline: 0; max-width: 30ch; }
.dialog progress { width: 100%; }
.keys { display: grid; grid-template-columns: 1fr auto; gap: 8px 24px; margin: 0; max-height: calc(100vh - 200px); overflow: auto; }
.keys dd { margin: 0; display: flex; gap: 6px; justify-content: flex-end; }
.keys kbd { min-width: 1.1em; padding: 1px 7px; border: 1px solid var(--turnleaf-line); border-radius: 6px; background: var(--turnleaf-hover); font: inherit; text-align: center; white-space: nowrap; }
.choices { display: flex; justify-content: flex-end; gap: 8px; margin-top: 12px; }
.ui .plain { min-height: 44px; padding-inline: 16px; border: 1px solid var(--turnleaf-line); border-radius: 10px; }
.view > .plain { margin: 4px 10px; }
.ui .strong { background: var(--turnleaf-accent); color: var(--turnleaf-surface); border-color: transparent; }

.narrow { display: none !important; }
@container turnleaf (max-width: 719px) {
  .narrow:not([hidden]) { display: flex !important; }
  .wide { display: none !important; }
  .panel { width: 100%; border: 0; }
  /* The book is seen above, as it is set. */
  .panel[data-tab="type"] { top: auto; height: min(58%, 460px); border-radius: 16px 16px 0 0; box-shadow: 0 -4px 24px rgb(0 0 0 / 0.2); }
  .panel[data-tab="type"] .tabs { display: none !important; }
  .panel[data-tab="type"] h2 { display: block !important; }
  .ui :is(.entry, .query) { font-size: 16px; }
  .place { padding-inline: 2px 4px; }
}
.frame:is(.full, .bare) > [part="stage"], .frame.full > .home { inset-block: 0; }
.frame > :is(.bar, .pages) { transition: translate 0.25s, visibility 0.25s; }
:is(.full:not(.awake, .open), .bare:not(.open)) > .bar:not(:focus-within) { translate: 0 -100%; visibility: hidden; }
:is(.full:not(.awake, .open), .bare:not(.open)) > .pages:not(:focus-within) { translate: 0 100%; visibility: hidden; }
@media (prefers-reduced-motion: reduce) { .ui, .ui * { transition: none !important; } }
@media print { .ui { display: none !important; } }
@media (forced-colors: active) {
  .ui, .menu { border-color: CanvasText; }
  [part~="button"]:is([aria-expanded="true"], [aria-pressed="true"]), .tabs [aria-selected="true"], .ui [aria-current], .menu [aria-checked="true"], .segments [aria-checked="true"] { outline: 2px solid Highlight; outline-offset: -3px; }
  .ui [aria-disabled="true"] { color: GrayText; opacity: 1; }
  .track input::-webkit-slider-runnable-track { background: CanvasText; forced-color-adjust: none; }
  .track input::-webkit-slider-thumb { background: Highlight; forced-color-adjust: none; }
}
`;
