// The firmware on the board, and ours to write over it.
import { useState } from "preact/hooks";
import { send } from "../api/client";
import { Progress } from "../controls/Progress";
import { Do } from "../shell/doing";
import type { Machine } from "../shell/machine";

export function Firmware({ machine }: { machine: Machine }) {
  const { brought, firmware, phase, written } = machine;
  const [asked, setAsked] = useState(false);
  if (written !== null) {
    return (
      <>
        <p>{brought} is being written to the board. Leave its cable in.</p>
        <Progress share={written} label="Written" />
      </>
    );
  }
  if (machine.kind !== "board" || !brought || phase === "connecting") return null;
  const write = async () => {
    await send("POST", "machine/firmware");
    setAsked(false);
  };
  return (
    <details open={firmware !== "" && firmware !== brought}>
      <summary>On the board: {firmware || "a firmware that did not say its name"}</summary>
      {asked ? (
        <p>
          Its motors go off and the sled may sink. Settings and chain lengths stay.{" "}
          <Do work={write}>Write it now</Do>{" "}
          <button type="button" onClick={() => setAsked(false)}>
            Leave it as it is
          </button>
        </p>
      ) : (
        <button type="button" onClick={() => setAsked(true)}>
          Write {brought} to this board
        </button>
      )}
    </details>
  );
}
