/** Returns what a part (0 to 1) of some times is below; sorts them. */
export function quantiles(times) {
  times.sort((a, b) => a - b);
  return (part) => times[Math.floor(part * (times.length - 1))];
}
