/** The files of an archive by the addresses with which documents in it name them. */

/** An address with a scheme, which leads out of the archive. */
const withScheme = /^(?:[a-z][a-z\d+.-]*:|[/\\]{2})/i;

/** A run of escaped bytes. */
const escapes = /(?:%[\da-f]{2})+/gi;

/**
 * Resolves addresses as browsers do, and then as the makers of books mean them: names escaped in any
 * part or in none, in another case, with backslashes, or composed of other characters of Unicode.
 */
export class FilePaths {
  readonly #names: ReadonlySet<string>;
  /** Names by what they have in common with others that are meant by the same address. */
  readonly #alike: ReadonlyMap<string, string>;

  /** @param names paths from the archive's root, as the archive has them */
  constructor(names: readonly string[]) {
    this.#names = new Set(names);
    // Of several that are alike the first counts.
    this.#alike = new Map([...names].reverse().map((name) => [folded(name), name]));
  }

  /**
   * Returns the name of the file that an address leads to, whatever stands behind "#"; null if the
   * archive has none.
   *
   * @param from name of the file that the address is in; "" for the archive's root
   */
  resolve(address: string, from: string): string | null {
    const [whole = ""] = address.trim().split("#", 1);
    const [path = ""] = whole.split("?", 1);
    if (path === "") return null;
    if (withScheme.test(whole)) return this.#named(joined(whole, from));
    for (const one of [path, whole]) {
      // Some programs escape what is escaped already.
      for (const meant of [decoded(one), one, decoded(decoded(one))]) {
        const name = this.#named(joined(meant, from));
        if (name !== null) return name;
      }
    }
    return null;
  }

  /**
   * Returns how a file is named that an address leads to, or would if the archive had it: by its path
   * from the root. An address that leads out of the archive is its own name.
   */
  nameOf(address: string, from: string): string {
    const path = address.trim().split(/[?#]/, 1)[0] ?? "";
    if (withScheme.test(path)) return address.trim();
    return this.resolve(address, from) ?? joined(decoded(path), from);
  }

  #named(path: string): string | null {
    return this.#names.has(path) ? path : (this.#alike.get(folded(path)) ?? null);
  }
}

/** Returns a path relative to a file as one from the root. */
function joined(path: string, from: string): string {
  const steps = /^[/\\]/.test(path) ? [] : from.split("/").slice(0, -1);
  for (const step of path.split(/[/\\]/)) {
    if (step === "..") steps.pop();
    else if (step !== "." && step !== "") steps.push(step);
  }
  return steps.join("/");
}

/** Returns an address with its escapes decoded: as UTF-8, or as systems of Western Europe once wrote them. */
function decoded(address: string): string {
  return address.replace(escapes, (run) => {
    try {
      return decodeURIComponent(run);
    } catch {
      const bytes = run
        .slice(1)
        .split("%")
        .map((byte) => Number.parseInt(byte, 16));
      return new TextDecoder("windows-1252").decode(Uint8Array.from(bytes));
    }
  });
}

function folded(name: string): string {
  return name.normalize("NFC").toLowerCase();
}
