/** A worker's script with all that it imports, as gzip in base64; see worker_inline.js of this package. */
declare module "worker:*" {
  const base64: string;
  export default base64;
}
