/** The part of UTIF that is used here: its own types ask for Node's. */

/** A directory of a TIFF: values by their tags, such as `t256` for the width. */
export interface Ifd {
  readonly [tag: `t${number}`]: readonly number[] | undefined;
  readonly width: number;
  readonly height: number;
  /** The unpacked samples, once decoded. */
  readonly data?: Uint8Array;
}
declare const UTIF: {
  decode(file: ArrayBuffer): Ifd[];
  decodeImage(file: ArrayBuffer, directory: Ifd): void;
  toRGBA8(directory: Ifd): Uint8Array<ArrayBuffer>;
};
export default UTIF;
