// Tables and sentences in the words of the server.
import type { Schemas } from "../api/client";
import { Table } from "./Table";

type Part = Schemas["Rows"] | Schemas["Sentences"];

/** Sentences below each other. */
export function List({ said, ...look }: { said: readonly string[]; class?: string }) {
  if (said.length === 0) return null;
  return (
    <ul {...look}>
      {said.map((each) => (
        <li key={each}>{each}</li>
      ))}
    </ul>
  );
}

export function Parts({ parts }: { parts: readonly Part[] }) {
  return parts.map((part, i) =>
    "rows" in part ? (
      <div key={i}>
        <Table names={part.header} rows={part.rows} />
        {part.note && <p>{part.note}</p>}
      </div>
    ) : (
      part.lines.map((line) => <p key={line}>{line}</p>)
    ),
  );
}
