/** Small FictionBooks; for tests only. */

/** Returns a FictionBook of a body, and what follows it. */
export function tinyFb2(body: string, after = "", info = ""): string {
  return `<?xml version="1.0" encoding="utf-8"?>
<FictionBook xmlns="http://www.gribuser.ru/xml/fictionbook/2.0" xmlns:l="http://www.w3.org/1999/xlink"><description><title-info><author><first-name>Herman</first-name><last-name>Melville</last-name></author><book-title>A small book</book-title><lang>en</lang>${info}</title-info></description><body>${body}</body>${after}</FictionBook>`;
}
