/**
 * Returns the fraction of a processor's time that this thread gets, 0 to 1: for 50 ms it does nothing but
 * read the clock. Where readings are further apart than 2 ms, more than any clock's step, something else
 * ran meanwhile.
 *
 * Its own text is the script of a worker, so it uses nothing from outside of it.
 */
export function measureFraction(): number {
  const start = performance.now();
  let last = start;
  let paused = 0;
  while (last - start < 50) {
    const now = performance.now();
    if (now - last > 2) paused += now - last;
    last = now;
  }
  return 1 - paused / (last - start);
}
