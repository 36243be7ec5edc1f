/** The engine's machine code as base64, inlined by the build. */
declare module "*.wasm" {
  const base64: string;
  export default base64;
}
