// The answers that a saved report brings along, so that its page asks no server.
const place = document.getElementById("answers");

/** By the path that the lab answers; undefined on the page of the lab itself. */
export const answers: Readonly<Record<string, unknown>> | undefined = place
  ? JSON.parse(place.textContent)
  : undefined;

/** Whether this is a saved report: it shows, and does nothing. */
export const isReport = answers !== undefined;
