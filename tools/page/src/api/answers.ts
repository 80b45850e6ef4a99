// The answers stored in a saved report, so that it needs no server.
const place = document.getElementById("answers");

/** Answers by path; undefined in the lab itself. */
export const answers: Readonly<Record<string, unknown>> | undefined = place
  ? JSON.parse(place.textContent)
  : undefined;

/** Whether this is a saved report, which is read-only. */
export const isReport = answers !== undefined;
