// Asks the server, with the types of its schema. A refusal becomes an error whose message is its line.
import type { components } from "./schema";
import { token } from "./token";

export type Schemas = components["schemas"];
export type Project = Schemas["ProjectAnswer"];
export type Choices = Schemas["Choices"];
export type Comparison = Schemas["ComparisonAnswer"];

/** What the server refused: `status` 409 says that somebody else saved in the meantime. */
export class Refusal extends Error {
  constructor(
    message: string,
    readonly status: number,
  ) {
    super(message);
  }
}

async function asked<Answer>(path: string, request: RequestInit): Promise<Answer> {
  let response: Response;
  try {
    response = await fetch(`api/${path}`, {
      ...request,
      headers: { ...request.headers, "X-Plumb-Token": token() },
    });
  } catch {
    throw new Refusal("The lab does not answer. Is plumb lab still running in its terminal?", 0);
  }
  if (response.ok) return (await response.json()) as Answer;
  const body = (await response.json().catch(() => ({}))) as { error?: string };
  throw new Refusal(body.error ?? `The lab answered ${response.status}.`, response.status);
}

/** Reads something. */
export function get<Answer>(path: string): Promise<Answer> {
  return asked(path, {});
}

/** Sends something to be kept or done. */
export function send<Answer>(
  method: "POST" | "PUT" | "DELETE",
  path: string,
  body?: unknown,
): Promise<Answer> {
  return asked(path, {
    method,
    headers: { "Content-Type": "application/json" },
    ...(body === undefined ? {} : { body: JSON.stringify(body) }),
  });
}

/** Sends a file that somebody picked. */
export function sendFile<Answer>(path: string, file: File): Promise<Answer> {
  const form = new FormData();
  form.set("file", file);
  return asked(path, { method: "POST", body: form });
}
