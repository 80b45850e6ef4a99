// The edges that the tape measures from, and how fine its lines are.
import { Select } from "../controls/Field";
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
  const finest = project.choices.fineness ?? 0.5;
  return (
    <div class="tape tiles">
      <Select
        label="Measured from"
        options={EDGES}
        chosen={project.choices.edges ?? "top-left"}
        choose={(edges) => choose({ edges })}
      />
      <Select
        label="Finest lines of the tape"
        options={[["", "not said"], ...LINES]}
        chosen={stated ? nearest(finest) : ""}
        choose={(finest) =>
          void save("fineness", () => ({ finest: finest === "" ? null : finest }))
        }
      />
    </div>
  );
}

function nearest(finest: number): number {
  return LINES.map(([mm]) => mm).reduce((best, mm) =>
    Math.abs(mm - finest) < Math.abs(best - finest) ? mm : best,
  );
}
