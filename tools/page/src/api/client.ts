// Requests to the server, typed by its schema. A refusal becomes an error with the server's message.
import { answers } from "./answers";
import { begin } from "./rest";

import type { components } from "./schema";
import { token } from "./token";

export type Schemas = components["schemas"];
export type Project = Schemas["ProjectAnswer"];
export type Choices = Schemas["Choices"];

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

/** The server refused. Status 409: another tab or program has saved in the meantime. */
export class Refusal extends Error {
  constructor(
    message: string,
    readonly status: number,
  ) {
    super(message);
  }
}

/** The server did not answer; trying again may help. */
export function isSilence(error: unknown): boolean {
  return error instanceof Refusal && error.status === 0;
}

/** What went wrong, in a line. */
export function lineOf(error: unknown): string {
  return error instanceof Error ? error.message : String(error);
}

interface Asking extends RequestInit {
  /** How long to wait for the whole answer [ms]. */
  patienceMs: number;
}

async function asked<Answer>(path: string, asking: Asking): Promise<Answer> {
  return JSON.parse(await (await answered(path, asking)).text()) as Answer;
}

/** The whole answer. A refusal becomes an error. */
async function answered(path: string, { patienceMs, ...request }: Asking): Promise<Blob> {
  const end = begin();
  let response: Response;
  let content: Blob;
  try {
    response = await fetch(`api/${path}`, {
      ...request,
      signal: AbortSignal.timeout(patienceMs),
      headers: { ...request.headers, "X-Plumb-Token": token() },
    });
    content = await response.blob();
  } catch {
    throw new Refusal("The lab does not answer. Is plumb lab still running in its terminal?", 0);
  } finally {
    end();
  }
  if (response.ok) return content;
  const reason = reasonIn(await content.text());
  throw new Refusal(reason ?? `The lab answered ${response.status}.`, response.status);
}

/** The message of a refusal, if there is one. */
function reasonIn(text: string): string | undefined {
  try {
    return (JSON.parse(text) as { error?: string }).error;
  } catch {
    return undefined;
  }
}

/** Reads something; in a saved report, from its stored answers. */
export async function get<Answer>(path: string, patienceMs = READ_MS): Promise<Answer> {
  if (!answers) return asked(path, { patienceMs });
  if (!Object.hasOwn(answers, path)) throw new Refusal("This report does not hold it.", 404);
  return answers[path] as Answer;
}

/** Sends a value to store or an action to run. */
export function send<Answer>(
  method: "POST" | "PUT" | "DELETE",
  path: string,
  body?: unknown,
  patienceMs = method === "PUT" ? SAVE_MS : WORK_MS,
): Promise<Answer> {
  return asked(path, {
    patienceMs,
    method,
    headers: { "Content-Type": "application/json" },
    ...(body === undefined ? {} : { body: JSON.stringify(body) }),
  });
}

/** Uploads a file. */
export function sendFile<Answer>(path: string, file: File): Promise<Answer> {
  const form = new FormData();
  form.set("file", file);
  return asked(path, { patienceMs: WORK_MS, method: "POST", body: form });
}

/** Downloads the report. */
export async function saveReport(): Promise<void> {
  saved(await answered("report.html", { patienceMs: WORK_MS }), "report.html");
}

/** Downloads a file. */
export function saved(content: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}
