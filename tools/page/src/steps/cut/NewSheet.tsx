// Whether the next marks go onto a new sheet, and how to place it.
import { useProject } from "../../shell/project";
import type { RoundParts } from "./round";

export function NewSheet({ round }: RoundParts) {
  const { project, choose } = useProject();
  const chosen = project.choices.new_sheet ?? false;
  return (
    <label class="tick">
      <input
        type="checkbox"
        checked={chosen}
        onChange={(event) => choose({ new_sheet: event.currentTarget.checked })}
      />
      <span>
        On another sheet than {round.last_form}
        {chosen && <small>{round.next_sheet}</small>}
      </span>
    </label>
  );
}
