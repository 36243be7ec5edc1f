/** The event that the stage has when a finger taps on the middle of a page: for the controls around it. */
export const pageTap = "turnleaf-tap";
