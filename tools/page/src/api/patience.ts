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

/** The result of the work if it comes in time; otherwise aborts the work and fails. */
export async function inTime<Answer>(
  patienceMs: number,
  work: (signal: AbortSignal) => Promise<Answer>,
): Promise<Answer> {
  const giveUp = new AbortController();
  let timer: ReturnType<typeof setTimeout> | undefined;
  const late = new Promise<never>((_, fail) => {
    timer = setTimeout(() => {
      fail(new Error(`no answer in ${patienceMs} ms`));
      giveUp.abort();
    }, patienceMs);
  });
  try {
    return await Promise.race([work(giveUp.signal), late]);
  } finally {
    clearTimeout(timer);
  }
}
