/**
 * A drop-in for react-pageflip 2.0.3: `HTMLFlipBook`, a component whose children
 * are the pages of a book.
 */

import {
  Children,
  type CSSProperties,
  createElement,
  type ForwardedRef,
  type ForwardRefExoticComponent,
  forwardRef,
  isValidElement,
  type ReactElement,
  type ReactNode,
  type RefAttributes,
  useEffect,
  useImperativeHandle,
  useRef,
  useState,
} from "react";
import { createPortal } from "react-dom";
import {
  type FlipEvents,
  type FlipSetting,
  PageFlip,
  type WidgetEvent,
} from "../page_flip/index.ts";

type Listener<K extends keyof FlipEvents> = (event: WidgetEvent<FlipEvents[K], PageFlip>) => void;

/** The properties of `HTMLFlipBook`: the options of page-flip, its events, and its pages. */
export interface HTMLFlipBookProps extends Partial<FlipSetting> {
  /** Width of a page, CSS pixels. */
  width: number;
  /** Height of a page, CSS pixels. */
  height: number;
  /** Class of the element around the book. */
  className?: string;
  /** Style of the element around the book. */
  style?: CSSProperties;
  /** The pages, one element each. */
  children?: ReactNode;
  /** Kept, and without an effect: pages are changed in place, and the book opens anew only if there are others. */
  renderOnlyPageLengthChange?: boolean;
  /** Other pages are in sight. */
  onFlip?: Listener<"flip">;
  /** The book shows one page instead of two, or two instead of one. */
  onChangeOrientation?: Listener<"changeOrientation">;
  /** The state has changed. */
  onChangeState?: Listener<"changeState">;
  /** The book is open. */
  onInit?: Listener<"init">;
  /** The book is open with other pages. */
  onUpdate?: Listener<"update">;
}

/** What a `ref` to `HTMLFlipBook` gets. */
export interface HTMLFlipBookRef {
  /** Returns the book; undefined before it is mounted. */
  pageFlip(): PageFlip | undefined;
}

/** The event of page-flip behind each property. */
const eventOf = {
  onFlip: "flip",
  onChangeOrientation: "changeOrientation",
  onChangeState: "changeState",
  onInit: "init",
  onUpdate: "update",
} as const;

/** Returns the options among the properties, without the first page: that may follow the page that is open. */
function settingsIn(props: HTMLFlipBookProps): Partial<FlipSetting> {
  const others = ["className", "style", "children", "renderOnlyPageLengthChange", "startPage"];
  const settings = Object.entries(props).filter(
    ([name]) => !others.includes(name) && !Object.hasOwn(eventOf, name),
  );
  return Object.fromEntries(settings);
}

/**
 * Holds one page: React keeps it as the root of a portal, so that the book may
 * move it without React's knowledge.
 */
function pageFrame(): HTMLElement {
  const frame = document.createElement("div");
  // The page fills it.
  frame.style.display = "grid";
  return frame;
}

function FlipBook(props: HTMLFlipBookProps, ref: ForwardedRef<HTMLFlipBookRef>): ReactElement {
  const host = useRef<HTMLDivElement>(null);
  const book = useRef<PageFlip | undefined>(undefined);
  const latest = useRef(props);
  const place = useRef<number | undefined>(undefined);
  const frames = useRef(new Map<string, HTMLElement>());
  // A server renders no portals, and the first render in a browser is to be the same.
  const [isMounted, setMounted] = useState(false);
  const pages = Children.toArray(props.children).filter((child) => isValidElement(child));
  const keys = pages.map(({ key }) => String(key));
  const settings = JSON.stringify(settingsIn(props));
  const list = JSON.stringify(keys);

  useEffect(() => {
    latest.current = props;
  });
  useEffect(() => setMounted(true), []);
  useImperativeHandle(ref, () => ({ pageFlip: () => book.current }), []);

  // A book for each set of options: another takes the place of the first, where that lay.
  useEffect(() => {
    if (!isMounted || host.current === null) return;
    const options: Partial<FlipSetting> = JSON.parse(settings);
    const flip = new PageFlip(host.current, {
      ...options,
      startPage: place.current ?? latest.current.startPage ?? 0,
    });
    for (const [property, event] of Object.entries(eventOf)) {
      flip.on(event, (said) => {
        const listener = latest.current[property as keyof typeof eventOf];
        (listener as ((event: unknown) => void) | undefined)?.(said);
      });
    }
    book.current = flip;
    return () => {
      place.current = flip.getPageCount() > 0 ? flip.getCurrentPageIndex() : undefined;
      flip.destroy();
      for (const frame of frames.current.values()) frame.remove();
      book.current = undefined;
    };
  }, [isMounted, settings]);

  // biome-ignore lint/correctness/useExhaustiveDependencies: another book is given its pages too
  useEffect(() => {
    const flip = book.current;
    if (!flip) return;
    const names: string[] = JSON.parse(list);
    for (const name of frames.current.keys())
      if (!names.includes(name)) frames.current.delete(name);
    const shown = names.flatMap((name) => frames.current.get(name) ?? []);
    for (const frame of shown) {
      const page = frame.firstElementChild;
      frame.dataset.density = page instanceof HTMLElement ? (page.dataset.density ?? "") : "";
    }
    if (flip.getPageCount() > 0 && shown.length > 0) flip.updateFromHtml(shown);
    else if (shown.length > 0) flip.loadFromHTML(shown);
    else if (flip.getPageCount() > 0) flip.clear();
  }, [isMounted, settings, list]);

  const portals = isMounted
    ? pages.map((page, k) => {
        let frame = frames.current.get(keys[k]);
        if (!frame) {
          frame = pageFrame();
          frames.current.set(keys[k], frame);
        }
        return createPortal(page, frame, keys[k]);
      })
    : [];
  const { className, style } = props;
  return createElement("div", { ref: host, className, style }, portals);
}

/** A book whose children are its pages. */
export const HTMLFlipBook: ForwardRefExoticComponent<
  HTMLFlipBookProps & RefAttributes<HTMLFlipBookRef>
> = forwardRef(FlipBook);
HTMLFlipBook.displayName = "HTMLFlipBook";

export default HTMLFlipBook;
