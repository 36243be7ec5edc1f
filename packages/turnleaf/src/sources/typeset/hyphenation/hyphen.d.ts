/** The package `hyphen`, as far as it is used; it has no types of its own. */
declare module "hyphen/hyphen.js" {
  const createHyphenator: (
    patterns: unknown,
    options: { readonly html: boolean },
  ) => (text: string) => string;
  export default createHyphenator;
}

declare module "hyphen/patterns/*" {
  const patterns: unknown;
  export default patterns;
}
