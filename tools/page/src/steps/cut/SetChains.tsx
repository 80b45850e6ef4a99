// If the sled's place is unknown: sets the lengths of the chains and the height of the bit.
import type { ComponentChild } from "preact";
import { useState } from "preact/hooks";
import { send } from "../../api/client";
import { Field } from "../../controls/Field";
import { shownLength, typedLength, useUnits } from "../../controls/lengths";
import { useDo } from "../../shell/doing";
import { useMachine } from "../../shell/machine";

const FORM = "set-chains";
const FIELDS = ["Left chain", "Right chain", "Bit above the wood"];

/** The form for both lengths and the height, and the button that sends them. */
export function useSetChains(): [form: ComponentChild, act: ComponentChild] {
  const { kept_lengths, place } = useMachine();
  const [busy, run, refusal] = useDo();
  const unit = useUnits();
  const [typed, setTyped] = useState(["", "", ""]);
  const [left, right, z] = typed.map((text) => typedLength(text, unit));
  const known = !!left && left > 0 && !!right && right > 0 && z !== undefined;
  const tell = () =>
    run(async () => {
      for (const text of [`B06 L${left} R${right}`, `G10 Z${z}`])
        await send("POST", "machine/line", { text });
    });
  const kept = kept_lengths?.every((length) => length > 0)
    ? [...kept_lengths, place?.[2] ?? 0].map((mm) => shownLength(mm, unit))
    : undefined;
  const form = (
    <form
      id={FORM}
      class="set-chains box row"
      onSubmit={(event) => {
        event.preventDefault();
        if (known) void tell();
      }}
    >
      <h2>Where is the sled?</h2>
      <p>
        The machine lost count of its chains. Hang them at the marks that you made, and type how
        long each is then, and how high the bit is.
      </p>
      {FIELDS.map((name, i) => (
        <Field
          key={name}
          label={`${name}, ${unit}`}
          inputMode="decimal"
          value={typed[i] ?? ""}
          hear={(text) => setTyped(typed.with(i, text))}
        />
      ))}
      {kept && (
        <p>
          When it last stood still, the machine had {kept.join(", ")} {unit}. That holds only if
          nothing has moved since.{" "}
          <button type="button" onClick={() => setTyped(kept)}>
            Type these in
          </button>
        </p>
      )}
    </form>
  );
  const act = (
    <>
      <button type="submit" form={FORM} class="primary" disabled={!known || busy}>
        Set both lengths; nothing moves
      </button>
      {refusal}
    </>
  );
  return [form, act];
}
