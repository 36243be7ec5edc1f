/** A book in Vue: `<TurnleafBook src="book.pdf" v-model:page="page" />`. */

import {
  type DefineSetupFnComponent,
  defineComponent,
  h,
  onMounted,
  shallowRef,
  toRaw,
  watch,
} from "vue";
import type { TurnleafBook as BookElement, TurnleafEventMap } from "../index.ts";
import "../index.ts";
import {
  applyProps,
  attributesOf,
  type BookProps,
  bookProps,
  booleanProps,
  eventOf,
  reportOpen,
} from "./book_props.ts";

/** The events of `TurnleafBook`: those of the element, and `update:page` for `v-model:page`. */
export type TurnleafBookEmits = {
  [E in keyof TurnleafEventMap]: (event: TurnleafEventMap[E]) => void;
} & { "update:page": (page: number) => void };

/** The properties of `TurnleafBook`: those of the element. */
export type TurnleafBookProps = BookProps;

const events = Object.values(eventOf);

// A property of true or false that is missing is neither, as some are true if they are missing.
const declaredProps = Object.fromEntries(
  bookProps.map((name) => {
    return [name, booleanProps.includes(name) ? { type: Boolean, default: undefined } : null];
  }),
);

/** A book. A template ref to it has the element, with all its methods, as `element`. */
export const TurnleafBook: DefineSetupFnComponent<TurnleafBookProps, TurnleafBookEmits> =
  defineComponent<TurnleafBookProps, TurnleafBookEmits>(
    (props, { emit, expose, slots }) => {
      const element = shallowRef<BookElement | null>(null);
      const say = emit as (event: string, detail: unknown) => void;
      // Of the first rendering: what changes is set below.
      const attributes = attributesOf(props);
      const listeners = events.map((event) => {
        const listen = (said: Event): void => {
          say(event, said);
          if (event === "pagechange") say("update:page", (said.target as BookElement).page);
        };
        return [`on${event[0].toUpperCase()}${event.slice(1)}`, listen] as const;
      });
      const apply = (): void => {
        // Vue's proxies are not what the element expects.
        const values = bookProps.map((name) => [name, toRaw(props[name])]);
        if (element.value) applyProps(element.value, Object.fromEntries(values));
      };
      onMounted(() => {
        apply();
        if (element.value) reportOpen(element.value, (event) => say("load", event));
      });
      watch(() => bookProps.map((name) => props[name]), apply, { flush: "post" });
      expose({ element });
      return () =>
        h(
          "turnleaf-book",
          { ...attributes, ...Object.fromEntries(listeners), ref: element },
          slots.default?.(),
        );
    },
    { name: "TurnleafBook", props: declaredProps as never, emits: [...events, "update:page"] },
  );
