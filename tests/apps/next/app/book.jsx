"use client";

import { useEffect, useRef, useState } from "react";
import "turnleaf";

/**
 * Rendered on the server, too; the page is React's state. The listener is added
 * by hand: React does not attach those of custom elements when it hydrates
 * (https://github.com/facebook/react/issues/35446).
 */
export function Book() {
  const [page, setPage] = useState(18);
  const book = useRef(null);
  useEffect(() => {
    const turned = (event) => setPage(event.detail.to);
    const element = book.current;
    element.addEventListener("pagechange", turned);
    return () => element.removeEventListener("pagechange", turned);
  }, []);
  return (
    <>
      <turnleaf-book
        ref={book}
        src="/book.pdf"
        page={page}
        style={{ width: "264px", height: "192px" }}
      />
      <output>{page}</output>
    </>
  );
}
