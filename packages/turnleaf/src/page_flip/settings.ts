/** The options of page-flip: their defaults and which values are rejected. */

/** The options of page-flip 2.0.7, by its names. Sizes are in CSS pixels. */
export interface FlipSetting {
  /** Index (from 0) of the page at which the book opens. */
  startPage: number;
  /** Whether pages are `width` by `height`, or as large as the host allows. */
  size: "fixed" | "stretch";
  /** Width of a page, and in a stretched book its ratio to `height`. */
  width: number;
  /** Height of a page. */
  height: number;
  /** Below twice this width a stretched book shows one page. */
  minWidth: number;
  /** Maximum width of a page in a stretched book. */
  maxWidth: number;
  /** Minimum height of the host of a stretched book. */
  minHeight: number;
  /** Kept, and without an effect, as in page-flip. */
  maxHeight: number;
  /** Whether turning leaves throw shadows. */
  drawShadow: boolean;
  /** Length of a turn, milliseconds. */
  flippingTime: number;
  /** Whether a narrow host shows one page instead of two. */
  usePortrait: boolean;
  /** z-index of the book within its host. */
  startZIndex: number;
  /** Whether the host becomes as high as the book. */
  autoSize: boolean;
  /** Strength of the shadows, 0 to 1. */
  maxShadowOpacity: number;
  /** Whether the first page and the last stand alone, as boards. */
  showCover: boolean;
  /** If false, a finger on the book does not scroll the page around it. */
  mobileScrollSupport: boolean;
  /** Kept, and always true: links and fields in pages get their clicks. */
  clickEventForward: boolean;
  /** Whether pointers turn pages. */
  useMouseEvents: boolean;
  /** Minimum length of a swipe. */
  swipeDistance: number;
  /** Whether a corner lifts under a mouse. */
  showPageCorners: boolean;
  /** If true, a click turns a page only in a corner of the book. */
  disableFlipByClick: boolean;
}

const defaults: FlipSetting = {
  startPage: 0,
  size: "fixed",
  width: 0,
  height: 0,
  minWidth: 0,
  maxWidth: 0,
  minHeight: 0,
  maxHeight: 0,
  drawShadow: true,
  flippingTime: 1000,
  usePortrait: true,
  startZIndex: 0,
  autoSize: true,
  maxShadowOpacity: 1,
  showCover: false,
  mobileScrollSupport: true,
  swipeDistance: 30,
  clickEventForward: true,
  useMouseEvents: true,
  showPageCorners: true,
  disableFlipByClick: false,
};

/**
 * Completes options by page-flip's defaults, and by its limits of sizes.
 *
 * @throws Error with page-flip's message if one of them is not valid
 */
export function completeSettings(options: Partial<FlipSetting>): FlipSetting {
  const given = Object.entries(options).filter(([, value]) => value !== undefined);
  const settings: FlipSetting = { ...defaults, ...Object.fromEntries(given) };
  const { size, width, height } = settings;
  if (size !== "stretch" && size !== "fixed") {
    throw new Error('Invalid size type. Available only "fixed" and "stretch" value');
  }
  if (!(width > 0 && height > 0)) throw new Error("Invalid width or height");
  if (!(settings.flippingTime > 0)) throw new Error("Invalid flipping time");
  if (size === "fixed") {
    settings.minWidth = settings.maxWidth = width;
    settings.minHeight = settings.maxHeight = height;
    return settings;
  }
  if (settings.minWidth <= 0) settings.minWidth = 100;
  if (settings.maxWidth < settings.minWidth) settings.maxWidth = 2000;
  if (settings.minHeight <= 0) settings.minHeight = 100;
  if (settings.maxHeight < settings.minHeight) settings.maxHeight = 2000;
  return settings;
}
