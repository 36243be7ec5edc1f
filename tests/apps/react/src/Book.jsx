import { useState } from "react";
import { TurnleafBook } from "turnleaf/react";

/** The page is React's state: the book sets it, and is set by it. */
export function Book() {
  const [page, setPage] = useState(18);
  return (
    <>
      <TurnleafBook
        src="/book.pdf"
        page={page}
        onPageChange={(event) => setPage(event.detail.to)}
        style={{ width: "264px", height: "192px" }}
      />
      <output>{page}</output>
    </>
  );
}
