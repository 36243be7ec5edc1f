import { readdir, realpath, stat } from "node:fs/promises";
import { join, sep } from "node:path";
import { imageSizeFromFile } from "image-size/fromFile";
import { imageTypeOfName, kindOfName, type NamedKind } from "./file_names.ts";
import { fileProblem, Problem, printable } from "./problem.ts";

/** Pages beyond this are not read. */
const mostPages = 20_000;
/** Files whose headers are read at the same time. */
const atOnce = 16;

/** The files of a folder by their kind: absolute paths without links, in the order of their names. */
export type FolderContent = Readonly<Record<NamedKind, readonly string[]>>;

/**
 * Lists the books, images and texts directly in `folder`; hidden files, and
 * links out of the folder, are left out.
 *
 * @param given how the user named the folder
 * @throws Problem
 */
export async function listFolder(
  folder: string,
  given: string,
  warn: (sentence: string) => void,
): Promise<FolderContent> {
  const names = await readdir(folder).catch((error: unknown) => {
    throw fileProblem(given, error);
  });
  const order = new Intl.Collator("en", { numeric: true }).compare;
  const content: Record<NamedKind, string[]> = { book: [], image: [], text: [] };
  for (const name of names.sort((a, b) => order(a, b) || (a < b ? -1 : 1))) {
    const kind = name.startsWith(".") ? null : kindOfName(name);
    const file = kind && (await insideFile(folder, name, warn));
    if (file) content[kind].push(file);
  }
  const images = content.image.length;
  if (images > mostPages) {
    throw new Problem(
      `${printable(given)} holds ${images} images; split it into folders of at most ${mostPages}.`,
    );
  }
  return content;
}

/** Returns the files of a folder that are books each; its images, if any, are one more. */
export function booksIn({ book, image, text }: FolderContent): readonly string[] {
  return book.length + image.length > 0 ? book : text;
}

/** Returns the file without links; null if it is none or lies outside of the folder. */
async function insideFile(
  folder: string,
  name: string,
  warn: (sentence: string) => void,
): Promise<string | null> {
  try {
    const real = await realpath(join(folder, name));
    const root = folder.endsWith(sep) ? folder : folder + sep;
    if (!real.startsWith(root)) {
      warn(`${printable(name)} is a link that leads out of the folder; it is left out.`);
      return null;
    }
    return (await stat(real)).isFile() ? real : null;
  } catch (error) {
    warn(`${fileProblem(name, error).message} It is left out.`);
    return null;
  }
}

/** An image of the folder as the manifest lists it. */
export interface FolderPage {
  readonly file: string;
  readonly type: string;
  /** Pixels, upright; empty if the header does not say: the browser then finds them. */
  readonly size: { readonly width: number; readonly height: number } | Record<string, never>;
}

/** Reads the images' sizes from their headers. */
export async function imagePages(images: readonly string[]): Promise<FolderPage[]> {
  const pages: FolderPage[] = [];
  for (let i = 0; i < images.length; i += atOnce) {
    pages.push(...(await Promise.all(images.slice(i, i + atOnce).map(imagePage))));
  }
  return pages;
}

async function imagePage(file: string): Promise<FolderPage> {
  const type = imageTypeOfName(file) ?? "application/octet-stream";
  const size = await imageSizeFromFile(file).catch(() => null);
  if (!size || !(size.width > 0) || !(size.height > 0)) return { file, type, size: {} };
  // EXIF orientations from 5 on are turned by a quarter; browsers turn them upright.
  const lies = (size.orientation ?? 1) >= 5;
  const { width, height } = lies ? { width: size.height, height: size.width } : size;
  return { file, type, size: { width, height } };
}
