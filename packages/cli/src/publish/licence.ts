/** Licences by their usual names. */

/** A licence as it is shown. */
export interface Licence {
  readonly name: string;
  /** Its address; null if only words are known. */
  readonly href: string | null;
}

/** Returns a licence by an SPDX name, by its address, or by words. */
export function parseLicence(text: string): Licence {
  const given = text.trim();
  const spdx = /^CC-(BY(?:-NC)?(?:-ND|-SA)?)-(\d\.\d)$/i.exec(given);
  if (spdx) return creativeCommons(spdx[1] ?? "", spdx[2] ?? "");
  if (/^CC0(-1\.0)?$/i.test(given)) return zero;
  if (/^(public[ -]domain|PDM(-1\.0)?|CC-PDDC)$/i.test(given)) return publicDomain;
  const url = addressOf(given);
  if (url === null) return { name: given, href: null };
  const own = /^creativecommons\.org\/licenses\/([a-z-]+)\/(\d\.\d)/.exec(url.host + url.pathname);
  if (own) return { ...creativeCommons(own[1] ?? "", own[2] ?? ""), href: url.href };
  const isOf = (path: string): boolean =>
    (url.host + url.pathname).startsWith(`creativecommons.org/publicdomain/${path}`);
  if (isOf("zero")) return { ...zero, href: url.href };
  if (isOf("mark")) return { ...publicDomain, href: url.href };
  return { name: url.host + url.pathname.replace(/\/$/, ""), href: url.href };
}

/** Returns an address that IIIF's `rights` takes: of Creative Commons or RightsStatements.org. */
export function rightsAddress({ href }: Licence): string | null {
  if (href === null) return null;
  const rest = href.replace(/^https?:/, "");
  return /^\/\/(creativecommons\.org|rightsstatements\.org)\//.test(rest) ? `http:${rest}` : null;
}

const zero: Licence = {
  name: "CC0 1.0",
  href: "https://creativecommons.org/publicdomain/zero/1.0/",
};
const publicDomain: Licence = {
  name: "Public domain",
  href: "https://creativecommons.org/publicdomain/mark/1.0/",
};

function creativeCommons(kind: string, version: string): Licence {
  return {
    name: `CC ${kind.toUpperCase()} ${version}`,
    href: `https://creativecommons.org/licenses/${kind.toLowerCase()}/${version}/`,
  };
}

function addressOf(text: string): URL | null {
  try {
    const url = new URL(text);
    return /^https?:$/.test(url.protocol) ? url : null;
  } catch {
    return null;
  }
}
