/** A file or folder of an npm package as gzip in base64; see packed_files.js of this package, and packed.ts. */
declare module "packed:*" {
  const base64: string;
  export default base64;
}
