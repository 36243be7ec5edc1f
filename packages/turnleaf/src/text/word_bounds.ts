/** Finds words in texts of any script. */

/** Divides a text into words and what lies between them. */
export const wordsOf: Intl.Segmenter = new Intl.Segmenter(undefined, { granularity: "word" });

/** Returns from where to where a text's word at a place reaches; beside a space or a mark, the word next to it. */
export function wordAround(
  text: string,
  at: number,
): { readonly from: number; readonly to: number } {
  const segments = wordsOf.segment(text);
  const here = segments.containing(at);
  if (here === undefined) return { from: at, to: at };
  const end = here.index + here.segment.length;
  const around = [here, segments.containing(here.index - 1), segments.containing(end)];
  const { index, segment } = around.find((one) => one?.isWordLike) ?? here;
  return { from: index, to: index + segment.length };
}
