/**
 * What is drawn of a book's flight, by its index from the left: views of its positions and its normals,
 * valid until the engine's memory grows.
 */
export function drawnOf(engine, book, index) {
  const record = new Uint32Array(engine.memory.buffer, engine.tl_book_surface(book, index), 4);
  const [columns, rows, ...addresses] = record;
  const count = 3 * columns * rows;
  return addresses.map((at) => new Float32Array(engine.memory.buffer, at, count));
}
