// How far off marks were, round by round: the check marks last.
import type { Schemas } from "../../api/client";
import { Bar } from "../../controls/Bar";
import { namedLength, type Unit } from "../../controls/lengths";
import { Table } from "../../controls/Table";

interface OffTargetParts {
  rounds: Schemas["RoundError"][];
  units: Unit;
}

export function OffTarget({ rounds, units }: OffTargetParts) {
  const most = Math.max(...rounds.map(({ off_target }) => off_target), 0.1);
  return (
    <Table
      class="wide off-target"
      caption="Off from the target, RMS: how far the marks are from where they were sent"
      rows={rounds.map(({ form, off_target, is_check }) => [
        form,
        <div key={form} class="bars">
          <Bar share={off_target / most} colour={is_check ? "var(--after)" : "var(--before)"} />
          {namedLength(off_target, units, 2)}
        </div>,
      ])}
    />
  );
}
