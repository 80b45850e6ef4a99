// Where the check marks are on the sheet, and how far off they are once they are read.
import type { Schemas } from "../../api/client";
import { Sheet } from "../../sheet/Sheet";
import { useProject } from "../../shell/project";

export function CheckMap({ answer }: { answer: Schemas["CheckAnswer"] }) {
  const { project } = useProject();
  const read = answer.marks;
  const marks = answer.places.map((target, index) => ({
    name: read[index]?.name ?? `${index + 1}`,
    target,
    measured: read[index]?.measured,
    look: "planned" as const,
  }));
  const off = {
    title: "from where they were promised",
    errors: read.map(
      ({ measured: [x, y], predicted }) => [x - predicted[0], y - predicted[1]] as const,
    ),
    promised: read.map(({ promised }) => promised),
  };
  return (
    <Sheet
      size={project.machine?.sheet ?? [2440, 1220]}
      label={read.length > 0 ? "How far the check marks are off" : "Where the two check marks are"}
      name="check"
      units={project.choices.units ?? "mm"}
      marks={marks}
      {...(read.length > 0 ? { states: [off] } : {})}
    />
  );
}
