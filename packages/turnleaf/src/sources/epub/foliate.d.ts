/** The part of foliate-js's EPUB reader that is used here; it has no types of its own. */

declare module "foliate-js/epub.js" {
  export interface ManifestItem {
    readonly id: string;
    readonly href: string;
    readonly mediaType: string;
    readonly properties?: readonly string[];
    /** The id of its media overlay. */
    readonly mediaOverlay?: string | null;
  }
  export interface SpineItem {
    readonly idref: string;
    readonly linear?: string | null;
    readonly properties?: readonly string[];
  }
  export interface TocItem {
    readonly label?: string | null;
    readonly href?: string | null;
    readonly subitems?: readonly TocItem[] | null;
  }
  export interface Loader {
    loadText(name: string): Promise<string | null>;
    loadBlob(name: string): Promise<Blob | null>;
    getSize(name: string): number;
    sha1?(text: string): Promise<Uint8Array>;
  }
  export class EPUB {
    constructor(loader: Loader);
    parser: { parseFromString(text: string, type: string): Document };
    init(): Promise<this>;
    readonly resources: {
      readonly opf: Document;
      readonly manifest: readonly ManifestItem[];
      readonly spine: readonly SpineItem[];
      /** The picture that the package names as its cover. */
      readonly cover?: ManifestItem | null;
    };
    readonly toc?: readonly TocItem[] | null;
    readonly dir?: string | null;
    readonly metadata: {
      readonly title?: unknown;
      readonly language?: unknown;
      readonly identifier?: unknown;
    };
    readonly rendition: Readonly<Record<string, string | undefined>>;
  }
}
