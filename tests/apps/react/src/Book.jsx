import { useState } from "react";
import "turnleaf";

/** The page is React's state: the book sets it, and is set by it. */
export function Book() {
  const [page, setPage] = useState(18);
  return (
    <>
      <turnleaf-book
        src="/book.pdf"
        page={page}
        onpagechange={(event) => setPage(event.detail.to)}
        style={{ width: "264px", height: "192px" }}
      />
      <output>{page}</output>
    </>
  );
}
