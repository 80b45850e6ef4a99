// Where the check marks are on the sheet, and how far off they are once they are read.
import type { Schemas } from "../../api/client";
import { Sheet } from "../../sheet/Sheet";
import { useProject } from "../../shell/project";

export function CheckMap({ answer }: { answer: Schemas["CheckAnswer"] }) {
  const { project } = useProject();
  const marks = answer.places.map((target, index) => ({
    name: answer.marks[index]?.name ?? `${index + 1}`,
    target,
    look: "planned" as const,
  }));
  return (
    <Sheet
      size={project.machine?.sheet ?? [2440, 1220]}
      label="Where the two check marks are"
      name="check"
      units={project.choices.units ?? "mm"}
      marks={marks}
    />
  );
}
