/** A recorded turn in base64, inlined by the build. */
declare module "*.tlkf" {
  const base64: string;
  export default base64;
}
