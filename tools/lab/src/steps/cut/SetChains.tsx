// Where the sled is, is not known: the machine is given the lengths of its chains.
import type { ComponentChild } from "preact";
import { useState } from "preact/hooks";
import { send } from "../../api/client";
import { shownLength, typedLength } from "../../controls/lengths";
import { useDo } from "../../shell/doing";
import { useProject } from "../../shell/project";

const USUAL = 1651; // [mm] of both chains at their marks
const FORM = "set-chains";

/** The form for both lengths, and the button that sends it. */
export function useSetChains(): [form: ComponentChild, act: ComponentChild] {
  const { project } = useProject();
  const [busy, run, refusal] = useDo();
  const unit = project.choices.units ?? "mm";
  const [left, setLeft] = useState(shownLength(USUAL, unit));
  const [right, setRight] = useState(shownLength(USUAL, unit));
  const lengths = [typedLength(left, unit), typedLength(right, unit)];
  const known = lengths.every((length) => length !== undefined && length > 0);
  const tell = () =>
    run(() => send("POST", "machine/line", { text: `B06 L${lengths[0]} R${lengths[1]}` }));
  const form = (
    <form
      id={FORM}
      class="set-chains"
      onSubmit={(event) => {
        event.preventDefault();
        if (known) void tell();
      }}
    >
      <h2>Where is the sled?</h2>
      <p>
        The machine lost count of its chains. Hang them at the marks that you made, and type how
        long each is then.
      </p>
      <label>
        Left chain, {unit}{" "}
        <input
          inputMode="decimal"
          value={left}
          onInput={(event) => setLeft(event.currentTarget.value)}
        />
      </label>
      <label>
        Right chain, {unit}{" "}
        <input
          inputMode="decimal"
          value={right}
          onInput={(event) => setRight(event.currentTarget.value)}
        />
      </label>
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
