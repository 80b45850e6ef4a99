// The ways to measure, with their minutes, to choose from.

import type { Schemas } from "../../api/client";
import { Segments } from "../../controls/Segments";

export type LayoutId = Schemas["LayoutAnswer"]["id"];

interface LayoutsParts {
  layouts: Schemas["LayoutAnswer"][];
  chosen: LayoutId;
  /** Marks that you place yourself. */
  count: number;
  choose: (id: LayoutId) => void;
}

export function Layouts({ layouts, chosen, count, choose }: LayoutsParts) {
  // It is always there, so that the sheet does not move under the finger that drags a mark.
  const mine = { id: "own" as const, title: "Your choice", minutes: 0 };
  return (
    <Segments
      class="layouts"
      legend="How to measure"
      chosen={chosen}
      choose={choose}
      options={[...layouts, mine].map(({ id, title, minutes }) => [
        id,
        <>
          <b>{title}</b>{" "}
          <small>{minutes > 0 ? `about ${Math.round(minutes)} min` : `${count} marks`}</small>
        </>,
      ])}
    />
  );
}
