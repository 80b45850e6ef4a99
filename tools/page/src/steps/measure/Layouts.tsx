// The ways to measure, with their minutes, to choose from.
import type { Layout } from "./plan";

interface LayoutsParts {
  layouts: Layout.Layout[];
  chosen: Layout.Id;
  /** Marks that you place yourself. */
  count: number;
  choose: (id: Layout.Id) => void;
}

export function Layouts({ layouts, chosen, count, choose }: LayoutsParts) {
  // It is always there, so that the sheet does not move under the finger that drags a mark.
  const mine = { id: "own" as const, title: "Your choice", minutes: 0 };
  return (
    <fieldset class="segments layouts">
      <legend>How to measure</legend>
      {[...layouts, mine].map((layout) => (
        <label key={layout.id}>
          <input
            type="radio"
            name="layout"
            checked={layout.id === chosen}
            onChange={() => choose(layout.id)}
          />
          <span>
            <b>{layout.title}</b>{" "}
            <small>
              {layout.minutes > 0 ? `about ${Math.round(layout.minutes)} min` : `${count} marks`}
            </small>
          </span>
        </label>
      ))}
    </fieldset>
  );
}
