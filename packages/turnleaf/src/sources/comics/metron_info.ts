/** MetronInfo.xml: what programs that sort comics write into an archive, from the data of Metron. */

import { cleanLanguage } from "../book_text.ts";
import { limits } from "../limits.ts";
import { type ComicMetadata, comicTitle, noMetadata } from "./comic_metadata.ts";
import { metadataRoot, textIn, textsIn } from "./metadata_markup.ts";

/** Returns what a MetronInfo.xml says; nothing of another document. */
export async function readMetronInfo(xml: string): Promise<ComicMetadata> {
  const root = await metadataRoot(xml, "MetronInfo");
  if (root === null) return noMetadata;
  const [series] = root.getElementsByTagNameNS("*", "Series");
  const credits = [...root.getElementsByTagNameNS("*", "Credit")].slice(0, mostCredits);
  const writers = credits.filter((one) => textsIn(one, "Role", limits.authors).includes("Writer"));
  const names = (writers.length > 0 ? writers : credits).map((one) => textIn(one, "Creator"));
  return {
    ...noMetadata,
    title: comicTitle(
      textIn(series, "Name"),
      textIn(root, "Number"),
      textIn(root, "CollectionTitle") || textIn(root, "Story"),
    ),
    authors: names.filter((name) => name !== "").slice(0, limits.authors),
    language: cleanLanguage(series?.getAttribute("lang")),
  };
}

/** Credits that are looked at. */
const mostCredits = 200;
