// Tables and sentences in the words of the server.
import type { Schemas } from "../api/client";
import { Table } from "./Table";

type Part = Schemas["Rows"] | Schemas["Sentences"];

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
