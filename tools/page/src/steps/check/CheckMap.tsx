// Where the check marks are on the sheet, and how far off they are once they are read.
import type { Schemas } from "../../api/client";
import { Sheet } from "../../sheet/Sheet";

export function CheckMap({ answer }: { answer: Schemas["CheckAnswer"] }) {
  const read = answer.marks;
  const marks = [
    ...answer.places.map((target, index) => ({
      name: read[index]?.name ?? `${index + 1}`,
      target,
      measured: read[index]?.measured,
      look: "planned" as const,
    })),
    ...answer.earlier.map((target) => ({ name: "", target, look: "faint" as const })),
  ];
  const off = {
    title: "from where they were promised",
    errors: read.map(
      ({ measured: [x, y], predicted }) => [x - predicted[0], y - predicted[1]] as const,
    ),
    promised: read.map(({ promised }) => promised),
  };
  return (
    <Sheet
      label={read.length > 0 ? "How far the check marks are off" : "Where the two check marks are"}
      marks={marks}
      {...(read.length > 0 ? { states: [off] } : {})}
    />
  );
}
