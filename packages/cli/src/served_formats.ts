/** Which files the command serves: those that the viewer opens, but for two formats. */

import {
  type FileFormat,
  formatOfFile,
  formatOfName,
  formats,
  listFormats,
} from "../../turnleaf/src/sources/formats.ts";
import { type Rejection, rejectionOf } from "../../turnleaf/src/sources/unread_formats.ts";

/** Why a format that the viewer opens is not served, by its media type: the end of a sentence about a file. */
const unserved: Readonly<Record<string, string>> = {
  "image/svg+xml": "is an SVG, which may hold scripts",
  "application/json": "is JSON (a IIIF manifest is opened by its address)",
};

const served = formats.filter(({ type, reason }) => (reason ?? unserved[type]) === undefined);

/** What is served, for sentences. */
export const readable = `${listFormats(served)} and folders of images`;

/** The images among it, for sentences. */
export const readableImages: string = listFormats(
  served.filter(({ family }) => family === "image"),
);

/**
 * Returns the format of a file that is served; otherwise why it is none, and what to do.
 *
 * @param start its first bytes, as many as show a format
 * @param name which tells text and Markdown apart
 */
export function servedFormat(start: Uint8Array, name: string): FileFormat | Rejection {
  const named = formatOfName(name);
  const type = named?.family === "text" ? named.type : "";
  // By its name alone no file is a ZIP here: whether one lies behind other bytes only its end would say.
  const format = formatOfFile({ start, type });
  if (format === null || format.reason !== undefined)
    return rejectionOf({ start, type, name }, readable);
  const reason = unserved[format.type];
  return reason === undefined ? format : { reason, remedy: `${readable} can be read` };
}
