// How long the page waits for an answer: a question that never ends would stop what waits for it, and keep its
// connection from others.

/** Answers that the page asks for again and again [ms]. */
export const LOOK_MS = 10_000;
/** Answers that are read once [ms]. */
export const READ_MS = 60_000;
/** Answers to what was typed or chosen [ms]. */
export const SAVE_MS = 30_000;
/** Answers that are worked out, or that the machine gives [ms]. */
export const WORK_MS = 180_000;

/** What the work brings, if it comes in time; else the work has to give up, and this fails. */
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
