/** The type in which text is set that has no typeface of its own: CSS font families. */
export const serif = 'Georgia, "Liberation Serif", "Times New Roman", serif';
