// A table: a name for each column, none for a column of pictures or buttons; each row begins with what it is of.
import type { ComponentChildren } from "preact";

interface TableParts {
  names?: readonly string[];
  rows: readonly (readonly ComponentChildren[])[];
  class?: string;
  caption?: ComponentChildren;
  /** The class of a row. */
  tone?: (row: number) => string | undefined;
}

export function Table({ names = [], rows, caption, tone, ...look }: TableParts) {
  return (
    <table {...look}>
      {caption && <caption>{caption}</caption>}
      {names.length > 0 && (
        <thead>
          <tr>
            {names.map((name, i) =>
              name ? (
                <th key={i} scope="col">
                  {name}
                </th>
              ) : (
                <td key={i} />
              ),
            )}
          </tr>
        </thead>
      )}
      <tbody>
        {rows.map(([first, ...cells], i) => (
          <tr key={i} class={tone?.(i)}>
            <th scope="row">{first}</th>
            {cells.map((cell, j) => (
              <td key={j}>{cell}</td>
            ))}
          </tr>
        ))}
      </tbody>
    </table>
  );
}
