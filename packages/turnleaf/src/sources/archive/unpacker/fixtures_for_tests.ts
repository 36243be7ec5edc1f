/** For tests only: the archives in `fixtures`. */

const addresses = import.meta.glob<string>("./fixtures/*.{rar,7z,cb7}", {
  query: "?inline",
  import: "default",
  eager: true,
});

/** Names of all archives. */
export const fixtureNames: readonly string[] = Object.keys(addresses)
  .map((path) => path.replace("./fixtures/", ""))
  .sort();

/** Returns an archive's bytes. */
export function fixture(name: string): Uint8Array<ArrayBuffer> {
  const base64 = addresses[`./fixtures/${name}`].replace(/^[^,]*,/, "");
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
}
