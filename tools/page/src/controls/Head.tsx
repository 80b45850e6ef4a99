// The head of a table: a name for each column, none for a column of pictures or buttons.
export function Head({ names }: { names: readonly string[] }) {
  return (
    <thead>
      <tr>
        {names.map((name, i) =>
          name ? (
            <th key={name} scope="col">
              {name}
            </th>
          ) : (
            <td key={i} />
          ),
        )}
      </tr>
    </thead>
  );
}
