/** Keeps the end of a selection at the pointer that drags it. */

/**
 * Between lines and beside them a browser would select everything up to the
 * layer's end. A guard that cannot be selected lies behind the text while the
 * pointer drags, next in order to the piece that the selection has reached.
 *
 * @param signal removes the listeners
 */
export function keepSelection(layer: HTMLElement, signal: AbortSignal): void {
  const guard = document.createElement("div");
  guard.className = "guard";
  layer.addEventListener(
    "pointerdown",
    (event) => {
      const piece = pieceOf(event);
      if (piece === null || event.button !== 0) return;
      piece.after(guard);
      const down = new AbortController();
      const until = AbortSignal.any([signal, down.signal]);
      const over = (at: PointerEvent): void => pieceOf(at)?.after(guard);
      layer.addEventListener("pointerover", over, { signal: until });
      for (const name of ["pointerup", "pointercancel", "blur"]) {
        globalThis.addEventListener(name, () => down.abort(), { signal: until });
      }
      until.addEventListener("abort", () => guard.remove(), { once: true });
    },
    { signal },
  );
}

function pieceOf(event: PointerEvent): HTMLElement | null {
  const { target } = event;
  return target instanceof HTMLElement && target.localName === "span" ? target : null;
}
