/** What `npm run types` checks of the built package: how its types are used in frameworks. */

import { type ReactElement, useRef, useState } from "react";
import type { TurnleafBook as BookElement } from "turnleaf";
import { TurnleafBook } from "turnleaf/react";
import type { TurnleafBook as SvelteBook } from "turnleaf/svelte";
import { TurnleafBook as VueBook } from "turnleaf/vue";
import { h } from "vue";

export function Reader(): ReactElement {
  const book = useRef<BookElement>(null);
  const [page, setPage] = useState(1);
  return (
    <>
      <TurnleafBook
        ref={book}
        src="book.pdf"
        page={page}
        controls
        theme="night"
        className="reader"
        style={{ height: "80vh" }}
        aria-label="Reader"
        onPageChange={({ detail }) => setPage(detail.to)}
        onLoad={({ detail }) => setPage(detail.pageCount)}
      />
      <turnleaf-book
        src="book.pdf"
        page={page}
        hard-pages="1-2"
        onpagechange={({ detail }) => setPage(detail.to)}
      />
      {/* @ts-expect-error there is no such theme */}
      <TurnleafBook theme="pink" />
      {/* @ts-expect-error there is no such theme */}
      <turnleaf-book theme="pink" />
    </>
  );
}

export const inVue = h(VueBook, {
  src: "book.pdf",
  onPagechange: ({ detail }) => detail.to.toFixed(),
  "onUpdate:page": (page) => page.toFixed(),
});
// @ts-expect-error there is no such theme
export const notInVue = h(VueBook, { theme: "pink" });

type SvelteProps = Parameters<typeof SvelteBook>[1];
export const inSvelte: SvelteProps = {
  src: "book.pdf",
  onpagechange: ({ detail }) => detail.to.toFixed(),
};
// @ts-expect-error there is no such theme
export const notInSvelte: SvelteProps = { theme: "pink" };
