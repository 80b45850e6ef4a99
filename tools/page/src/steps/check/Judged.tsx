// Check marks that are read, against what was promised: in a sentence, on the sheet, and in numbers.
import { type Schemas, send } from "../../api/client";
import { Bar } from "../../controls/Bar";
import { namedLength } from "../../controls/lengths";
import { Table } from "../../controls/Table";
import { useUnits } from "../../controls/units";
import { Sheet } from "../../sheet/Sheet";
import { Do } from "../../shell/doing";
import { useMachine } from "../../shell/machine";
import { useProject, useTell } from "../../shell/project";
import type { Round } from "../cut/round";

export type CheckAnswer = Schemas["CheckAnswer"];

interface JudgedParts {
  answer: CheckAnswer;
  round: Round;
}

export function JudgedMap({ answer: { marks, earlier }, round }: JudgedParts) {
  const off = {
    title: "from where they were promised",
    errors: marks.map(({ error }) => error),
    promised: marks.map(({ expected_mm }) => expected_mm),
  };
  const read = marks.map(({ name, hole }, i) => ({ name, target: round.marks[i]?.place ?? hole }));
  const fitted = earlier.map((target) => ({ name: "", target, look: "faint" as const }));
  return (
    <Sheet label="How far the check marks are off" marks={[...read, ...fitted]} states={[off]} />
  );
}

export function Judged({ answer: { sentence, holds, rounds, is_used } }: JudgedParts) {
  const { reload } = useProject();
  const tell = useTell();
  const units = useUnits();
  const { kind } = useMachine();
  const most = Math.max(...rounds.map(({ off_target }) => off_target), 0.1);
  return (
    <>
      <p class={holds ? "judged box edge" : "judged trouble edge"} role="status">
        {sentence}
      </p>
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
      <p class="row">
        {kind === "none" ? (
          <Do work={() => tell("rounds/check")}>Write two other marks</Do>
        ) : (
          <Do work={() => send("POST", "rounds/check/cut").then(reload)}>
            Cut two other marks: the sled moves
          </Do>
        )}
        {!is_used && <Do work={() => tell("check/use")}>Let the verdict go by these marks too</Do>}
      </p>
    </>
  );
}

/** How far off each check mark may be, and is. */
export function Promised({ answer, round }: JudgedParts) {
  const units = useUnits();
  return (
    <Table
      class="checked"
      names={["mark", "promised within", "off from what was promised", "off from the target"]}
      rows={answer.marks.map(({ name, hole: [x, y], error, expected_mm }, i) => {
        const [aim_x, aim_y] = round.marks[i]?.place ?? [x, y];
        const off = [expected_mm, Math.hypot(...error), Math.hypot(x - aim_x, y - aim_y)];
        return [name, ...off.map((mm) => namedLength(mm, units, 2))];
      })}
    />
  );
}
