declare module "page-flip/dist/js/page-flip.module.js" {
  /** Without types of its own; the tests use it by those of the drop-in. */
  export const PageFlip: unknown;
}
declare module "page-flip/README.md?raw" {
  const text: string;
  export default text;
}
