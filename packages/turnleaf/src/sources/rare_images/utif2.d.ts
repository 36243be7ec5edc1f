/** The part of UTIF that is used here: its own types ask for Node's. */

/** A directory of a TIFF: values by their tags, such as `t256` for the width. */
export interface Ifd {
  readonly [tag: `t${number}`]: readonly number[] | undefined;
  readonly width: number;
  readonly height: number;
  /** The unpacked samples, once decoded. */
  readonly data?: Uint8Array;
}
/** The decoder of JPEGs in TIFFs. */
interface JpegDecoder {
  readonly width: number;
  readonly height: number;
  parse(file: Uint8Array): void;
  getData(how: {
    readonly width: number;
    readonly height: number;
    readonly forceRGB: boolean;
    readonly isSourcePDF: boolean;
  }): Uint8Array | Uint8ClampedArray;
}

declare const UTIF: {
  readonly JpegDecoder: new () => JpegDecoder;
  decode(file: ArrayBuffer): Ifd[];
  decodeImage(file: ArrayBuffer, directory: Ifd): void;
  toRGBA8(directory: Ifd): Uint8Array<ArrayBuffer>;
};
export default UTIF;
