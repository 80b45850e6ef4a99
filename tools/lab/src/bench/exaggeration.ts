// How much longer than life arrows are drawn before anybody chooses it.
const MOST = 200;

/** The times at which an error [mm] takes a tenth of the sheet's width. */
export function usualExaggeration(longest: number, width: number): number {
  return Math.max(1, Math.min(MOST, Math.round(width / 10 / Math.max(longest, 1e-6))));
}
