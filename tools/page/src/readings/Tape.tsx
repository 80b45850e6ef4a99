// The edges that the tape measures from, and how fine its lines are.
import type { Choices } from "../api/client";
import { useProject } from "../shell/project";
import { type Form, useSave } from "./saves";

const EDGES = [
  ["top-left", "left and top edge"],
  ["top-right", "right and top edge"],
  ["bottom-left", "left and bottom edge"],
  ["bottom-right", "right and bottom edge"],
] as const;
// Finest lines [mm], by their usual names.
const LINES = [
  [1, "1 mm"],
  [0.5, "0.5 mm"],
  [25.4 / 8, "1/8 inch"],
  [25.4 / 16, "1/16 inch"],
  [25.4 / 32, "1/32 inch"],
  [25.4 / 64, "1/64 inch"],
  [0.1, "0.1 mm, a long caliper"],
] as const;

interface TapeParts {
  form: Form;
  take: (form: Form) => void;
}

export function Tape({ form, take }: TapeParts) {
  const { project, choose } = useProject();
  const save = useSave(form, take);
  const stated = form.tape_sigma !== null;
  // If only distances are asked for, edges do not matter.
  const fromEdges = form.spans.length === 0 || form.marks.some((mark) => mark.read);
  const finest = project.choices.fineness ?? 0.5;
  const state = (value: string) =>
    save("fineness", () => ({ finest: value ? Number(value) : null }));
  return (
    <div class="tape tiles">
      {fromEdges && (
        <label>
          Measured from
          <select
            value={project.choices.edges}
            onChange={(event) =>
              choose({ edges: event.currentTarget.value as NonNullable<Choices["edges"]> })
            }
          >
            {EDGES.map(([corner, said]) => (
              <option key={corner} value={corner}>
                {said}
              </option>
            ))}
          </select>
        </label>
      )}
      <label>
        Finest lines of the tape
        <select
          value={stated ? String(nearest(finest)) : ""}
          onChange={(event) => void state(event.currentTarget.value)}
        >
          <option value="">not said</option>
          {LINES.map(([mm, said]) => (
            <option key={said} value={String(mm)}>
              {said}
            </option>
          ))}
        </select>
      </label>
    </div>
  );
}

function nearest(finest: number): number {
  return LINES.map(([mm]) => mm).reduce((best, mm) =>
    Math.abs(mm - finest) < Math.abs(best - finest) ? mm : best,
  );
}
