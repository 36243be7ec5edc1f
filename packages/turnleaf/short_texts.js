/**
 * Shaders and styles as built files carry them: without the comments, line ends
 * and spaces that are for people who read the sources. Does it to the template
 * strings that are marked as GLSL or CSS and to nothing else. Serves both tsdown
 * and vite, whose plugins share this shape.
 */
export function shortTexts() {
  return {
    name: "turnleaf-short-texts",
    enforce: "pre",
    transform(code, id) {
      if (!/\/turnleaf\/src\/.*\.ts$/.test(id.replaceAll("\\", "/").split("?")[0])) return null;
      if (!/\/\* (glsl|css) \*\//.test(code)) return null;
      return { code: shortened(code), map: null };
    },
  };
}

/** A module's text with its marked template strings shortened. */
export function shortened(code) {
  return code.replace(
    /(\/\* (glsl|css) \*\/ `)([^`]*)`/g,
    (_, start, language, text) =>
      `${start}${language === "css" ? shortCss(text) : shortGlsl(text)}\``,
  );
}

/** Directives, and what is put in on a line of its own and may begin with one, keep their lines. */
function shortGlsl(text) {
  return text
    .replace(/\/\/.*/g, "")
    .split("\n")
    .map((line) => line.trim().replace(/\s+/g, " "))
    .filter((line) => line !== "")
    .map((line) => (/^(#|\$\{\w+\}$)/.test(line) ? `\n${line}\n` : `${tight(line)} `))
    .join("")
    .replace(/ ?([;{},]) /g, "$1")
    .replace(/\n+/g, "\n");
}

/**
 * Numbers lose the zeros that say nothing. Where two of + and - stand on end they keep
 * their spaces: without, they would be another thing.
 */
function tight(line) {
  return line
    .replace(/\$\{[^}]*\}|( ?([=*/<>,;(){}?:&|!]+) ?)/g, (found, _, sign) => sign ?? found)
    .replace(/(?<=[\w.)\]]) ?([+-]) ?(?=[\w.(])/g, "$1")
    .replace(/\$\{[^}]*\}|\b0(?=\.\d*[1-9])|(?<=\b\d+\.)0\b/g, (found) =>
      found === "0" ? "" : found,
    );
}

/** A space before a colon parts selectors, and one between values parts these: they stay. */
function shortCss(text) {
  return text
    .replace(/\/\*[\s\S]*?\*\//g, "")
    .replace(/\s+/g, " ")
    .replace(/ ?([{};,]) ?/g, "$1")
    .replace(/: /g, ":")
    .replace(/;}/g, "}")
    .trim();
}
