// Step 5: cut the marks: save the program, or send it; hold and stop are in the bar.

import { Screen } from "../shell/Screen";
import { CutMap } from "./cut/CutMap";
import type { Round } from "./cut/round";
import { useCutting, useRoundOf } from "./cut/useCutting";

export function Cut() {
  const round = useRoundOf<Round>("rounds/marks");
  if (!round) return <Screen title="Cut the marks" say="One moment …" busy />;
  return <OpenCut round={round} />;
}

function OpenCut({ round }: { round: Round }) {
  const { act, fields, fieldsFirst, running } = useCutting(round);
  return (
    <Screen
      {...round.heading}
      {...running}
      why={<Why />}
      command={round.command}
      stage={<CutMap round={round} />}
      fieldsFirst={fieldsFirst}
      act={act}
    >
      {fields}
    </Screen>
  );
}

function Why() {
  return (
    <>
      <p>
        The bit comes to each mark from below and only touches the wood: a scratch that a tape can
        find. Chains give and rub, so a mark that is always reached from the same side can be
        trusted.
      </p>
      <p>
        Before anything is sent, each place on the way is checked: chains neither too tight nor too
        slack, and the bit never off the sheet.
      </p>
    </>
  );
}
