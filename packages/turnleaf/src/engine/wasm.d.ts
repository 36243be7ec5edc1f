/** A WASM as gzip in base64, inlined by the build. */
declare module "*.wasm" {
  const base64: string;
  export default base64;
}
