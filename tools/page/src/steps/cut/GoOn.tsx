// Continues a cut that broke off; asks which marks are on the sheet if that is unknown.
import type { ComponentChild } from "preact";
import { useEffect, useState } from "preact/hooks";
import { send } from "../../api/client";
import { Do } from "../../shell/doing";
import { useChoosing } from "../../shell/kept";
import { isReady, useMachine } from "../../shell/machine";
import { useProject } from "../../shell/project";
import type { Round } from "./round";

/** The question, and the button that continues. */
export function useGoOn(
  round: Round,
  path: string,
): [question: ComponentChild, act: ComponentChild] {
  const { perhaps, trouble } = round;
  const surely = round.broke_off ?? 0;
  const names = round.marks.map(({ name }) => name);
  const { reload } = useProject();
  const machine = useMachine();
  const [seen, setSeen] = useState<number>();
  // A new break asks again.
  useEffect(() => setSeen(undefined), [surely, perhaps]);
  const choosing = useChoosing();
  const cut = perhaps > 0 ? seen : surely;
  const next = cut === undefined ? undefined : names[cut];
  const goOn = async () => {
    await send("POST", path, { cut });
    setSeen(undefined);
    await reload();
  };
  const question = perhaps > 0 && (
    <fieldset class="last-seen row">
      <legend>Look at the sheet: which of these marks is the last on it?</legend>
      {Array.from({ length: perhaps + 1 }, (_, more) => surely + more).map((count) => (
        <label key={count} class="tick">
          <input
            type="radio"
            name="last-seen"
            checked={seen === count}
            onChange={() => setSeen(count)}
          />
          {count === 0 ? "none" : `mark ${names[count - 1]}`}
        </label>
      ))}
    </fieldset>
  );
  const act =
    cut === names.length ? (
      "Then all are cut: read them."
    ) : (
      <Do isNext disabled={choosing || !isReady(machine) || trouble !== "" || !next} work={goOn}>
        {next
          ? `Go on: move the sled and cut from mark ${next}`
          : "Go on: say first which mark is the last"}
      </Do>
    );
  return [question, act];
}
