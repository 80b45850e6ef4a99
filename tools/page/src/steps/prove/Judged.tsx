// Proof marks that are read, against what was promised: in a sentence, on the sheet, and in numbers.
import { type Schemas, send } from "../../api/client";
import { Bar } from "../../controls/Bar";
import { namedLength, useUnits } from "../../controls/lengths";
import { Table } from "../../controls/Table";
import { Sheet } from "../../sheet/Sheet";
import { Do } from "../../shell/doing";
import { useMachine } from "../../shell/machine";
import { useProject, useTell } from "../../shell/project";

export type ProofAnswer = Schemas["ProofAnswer"];

interface JudgedParts {
  answer: ProofAnswer;
  checked: NonNullable<ProofAnswer["checked"]>;
}

export function JudgedMap({ answer: { earlier }, checked: { marks } }: JudgedParts) {
  const off = {
    title: "from where they were promised",
    errors: marks.map(({ error }) => error),
    promised: marks.map(({ expected_mm }) => expected_mm),
  };
  const read = marks.map(({ name, target }) => ({ name, target }));
  const fitted = earlier.map((target) => ({ name: "", target, look: "faint" as const }));
  return (
    <Sheet label="How far the proof marks are off" marks={[...read, ...fitted]} states={[off]} />
  );
}

export function Judged({ answer: { rounds, is_used }, checked }: JudgedParts) {
  const { reload } = useProject();
  const tell = useTell();
  const units = useUnits();
  const { kind } = useMachine();
  const most = Math.max(...rounds.map(({ off_target }) => off_target), 0.1);
  return (
    <>
      <p class={checked.holds ? "judged box edge" : "judged trouble edge"} role="status">
        {checked.sentence}
      </p>
      <Table
        class="wide off-target"
        caption="Off from the target, RMS: how far the marks are from where they were sent"
        rows={rounds.map(({ form, off_target, is_proof }) => [
          form,
          <div key={form} class="bars">
            <Bar share={off_target / most} colour={is_proof ? "var(--after)" : "var(--before)"} />
            {namedLength(off_target, units, 2)}
          </div>,
        ])}
      />
      <p class="row">
        {kind === "none" ? (
          <Do work={() => tell("rounds/proof")}>Write two other marks</Do>
        ) : (
          <Do work={() => send("POST", "rounds/proof/cut").then(reload)}>
            Cut two other marks: the sled moves
          </Do>
        )}
        {!is_used && <Do work={() => tell("proof/use")}>Let the verdict go by these marks too</Do>}
      </p>
    </>
  );
}
