// The numbers of the machine, each with a box to accept it.
import type { Schemas } from "../../api/client";
import { useProject } from "../../shell/project";
import { NumberTable } from "./NumberTable";

export function Numbers({ made, busy }: { made: Schemas["CorrectionParts"]; busy: boolean }) {
  const { project, choose } = useProject();
  // Including those not yet saved on the server.
  const accepted = project.choices.accepted ?? [];
  const accept = (names: string[]) => choose({ accepted: names });
  const now = made.asked;
  // Those that a real machine can have.
  const all = now.filter(({ possible }) => possible).map(({ name }) => name);
  if (now.length === 0) return null;
  return (
    <fieldset class="numbers" aria-busy={busy}>
      <legend>Numbers of the machine</legend>
      <NumberTable numbers={now} accepted={accepted} accept={accept} />
      {all.some((name) => !accepted.includes(name)) && (
        <button type="button" onClick={() => accept([...new Set([...accepted, ...all])])}>
          Accept all {all.length}
        </button>
      )}
    </fieldset>
  );
}
