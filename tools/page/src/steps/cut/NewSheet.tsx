// Whether the next marks go onto a new sheet, and how to place it.
import { namedLength } from "../../controls/lengths";
import { useUnits } from "../../controls/units";
import { useMachine } from "../../shell/machine";
import { useProject } from "../../shell/project";
import type { Round } from "./round";

const LEAST_MM = 0.5; // a smaller turn is not worth a shim

export function NewSheet({ round }: { round: Round }) {
  const { project, choose } = useProject();
  const { kind } = useMachine();
  const units = useUnits();
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
        {chosen && (
          <small>
            {kind === "virtual"
              ? "The virtual machine gets another sheet on the same stops"
              : "Lay it on the same stops"}
            {turned(round.sheet_rise, units)}.
          </small>
        )}
      </span>
    </label>
  );
}

/** What the correction says of the sheet's right end. */
function turned(rise: number, units: "mm" | "inch"): string {
  if (Math.abs(rise) < LEAST_MM) return "";
  return `, its right end ${namedLength(Math.abs(rise), units)} ${rise > 0 ? "higher" : "lower"}`;
}
