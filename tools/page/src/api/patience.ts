// How long the page waits for an answer. A request that never ends would block what waits for it and hold a connection
// that others need.

/** Polling [ms]. */
export const LOOK_MS = 10_000;
/** Single reads [ms]. */
export const READ_MS = 60_000;
/** Saving what was typed or chosen [ms]. */
export const SAVE_MS = 30_000;
/** Computations, and answers from the machine [ms]. */
export const WORK_MS = 180_000;
