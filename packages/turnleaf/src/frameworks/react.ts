/** A book in React: `<TurnleafBook src="book.pdf" />`, and types for `<turnleaf-book>` in JSX. */

import {
  createElement,
  type DetailedHTMLProps,
  type ForwardRefExoticComponent,
  forwardRef,
  type HTMLAttributes,
  type RefAttributes,
  useEffect,
  useImperativeHandle,
  useRef,
  useState,
} from "react";
import type { TurnleafBook as BookElement, TurnleafEventMap } from "../index.ts";
import "../index.ts";
import {
  applyProps,
  attributesOf,
  type BookProps,
  bookProps,
  eventOf,
  reportOpen,
} from "./book_props.ts";

type Listeners = {
  [P in keyof typeof eventOf]?: (event: TurnleafEventMap[(typeof eventOf)[P]]) => void;
};

type ElementProps = HTMLAttributes<BookElement>;

/** The properties of `TurnleafBook`: those of the element, listeners of its events, and those of every element. */
export interface TurnleafBookProps
  extends BookProps,
    Listeners,
    Omit<ElementProps, keyof BookProps | keyof Listeners> {
  /**
   * The page that lies open. With `onPageChange` it is controlled, as the value of a field is: the
   * book turns back if the listener does not set it.
   */
  page?: number;
  /** The page at which the book opens if it is not controlled. */
  defaultPage?: number;
}

/** A book. Its `ref` is the element, with all its methods. */
export const TurnleafBook: ForwardRefExoticComponent<
  TurnleafBookProps & RefAttributes<BookElement>
> = forwardRef<BookElement, TurnleafBookProps>((props, ref) => {
  const element = useRef<BookElement>(null);
  const latest = useRef(props);
  const [turns, setTurns] = useState(0);
  const reported = useRef(0);
  // Of the first rendering: what changes is set below, which is the same in every version of React.
  const [attributes] = useState(() =>
    attributesOf({ ...props, page: props.page ?? props.defaultPage }),
  );
  useImperativeHandle(ref, () => element.current as BookElement, []);

  useEffect(() => {
    latest.current = props;
    // The book has turned since: this page would turn it back, and the rendering that follows sets all.
    if (turns !== reported.current) return;
    const values = bookProps.map((name) => [name, props[name]]);
    const page = props.page ?? props.defaultPage;
    if (element.current) applyProps(element.current, { ...Object.fromEntries(values), page });
  });

  useEffect(() => {
    const book = element.current;
    if (!book) return;
    const ended = new AbortController();
    for (const [name, event] of Object.entries(eventOf)) {
      const listen = (said: Event): void => {
        if (event === "pagechange") reported.current += 1;
        const listener = latest.current[name as keyof Listeners];
        (listener as ((event: Event) => void) | undefined)?.(said);
        if (event === "pagechange") setTurns(reported.current);
      };
      book.addEventListener(event, listen as EventListener, { signal: ended.signal });
    }
    reportOpen(book, latest.current.onLoad);
    return () => ended.abort();
  }, []);

  useEffect(() => {
    const { page, onPageChange } = latest.current;
    const isLatest = turns > 0 && turns === reported.current;
    const isControlled = page !== undefined && onPageChange;
    // Setting the page that was reported last does nothing.
    if (isLatest && isControlled && element.current) element.current.page = page;
  }, [turns]);

  const others = Object.entries(props).filter(
    ([name]) =>
      !(name in eventOf || name === "defaultPage" || name === "className" || isOfBook(name)),
  );
  return createElement("turnleaf-book", {
    ...Object.fromEntries(others),
    ...(props.className !== undefined && { class: props.className }),
    ...attributes,
    ref: element,
  });
});
TurnleafBook.displayName = "TurnleafBook";

const isOfBook = (name: string): boolean => (bookProps as readonly string[]).includes(name);

/** The properties of `<turnleaf-book>` itself in JSX, with listeners as React 19 takes them: `onpagechange`. */
export type TurnleafBookElementProps = BookProps &
  Omit<DetailedHTMLProps<ElementProps, BookElement>, keyof BookProps> & {
    [E in keyof TurnleafEventMap as `on${E}`]?: (event: TurnleafEventMap[E]) => void;
  };

declare module "react" {
  namespace JSX {
    interface IntrinsicElements {
      "turnleaf-book": TurnleafBookElementProps;
    }
  }
}
