import { Book } from "./book.jsx";

export default function Page() {
  return <Book />;
}
