// Step 9: two marks that were not part of the fit: is the machine as accurate as its settings promise?

import { useEffect } from "preact/hooks";
import { type Project, send } from "../api/client";
import { shownLength, useUnits } from "../controls/lengths";
import { Table } from "../controls/Table";
import { Grid } from "../readings/Grid";
import { useReadings } from "../readings/useReadings";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";
import { Refused } from "./correct/Refused";
import { useWriting } from "./correct/useWriting";
import { CutMap } from "./cut/CutMap";
import type { Round } from "./cut/round";
import { useCutting, useRoundOf } from "./cut/useCutting";
import { Judged, JudgedMap, type ProofAnswer } from "./prove/Judged";
import "../readings/readings.css";

export function Prove() {
  const { project } = useProject();
  const answer = useRoundOf<ProofAnswer>("proof");
  const writing = useWriting();
  useNoted(answer);
  if (!answer && project.stale) return <Refused title="Is it true?" refused="" writing={writing} />;
  if (!answer) return <Screen title="Is it true?" say="One moment …" busy />;
  if (answer.round) return <OpenProof answer={answer} round={answer.round} />;
  return (
    <Screen {...answer.heading}>
      <a class="button primary" href={`#/${answer.instead?.screen}`}>
        {answer.instead?.text}
      </a>
    </Screen>
  );
}

function OpenProof({ answer, round }: { answer: ProofAnswer; round: Round }) {
  const units = useUnits();
  const { act, fields, running } = useCutting(round);
  const { checked } = answer;
  const places = answer.meant.map((place) =>
    place.map((mm) => shownLength(mm, units, 0)).join(", "),
  );
  return (
    <Screen
      {...answer.heading}
      {...running}
      why={<Why />}
      command={answer.command}
      stage={
        checked ? (
          <JudgedMap {...{ answer, checked }} />
        ) : (
          <CutMap round={round} earlier={answer.earlier} />
        )
      }
      fieldsFirst
      act={!checked && act}
    >
      {checked ? (
        <Judged {...{ answer, checked }} />
      ) : (
        <>
          <p>
            Where ({units} from your edges): {places.join(" and ")}.
          </p>
          {fields}
        </>
      )}
      {round.is_saved && !running && <ProofReadings file={round.form} />}
      {answer.tables.map(({ header, rows }) => (
        <Table key={header[0]} class="checked" names={header} rows={rows} />
      ))}
    </Screen>
  );
}

/** The readings of the proof marks, typed as all others are. */
function ProofReadings({ file }: { file: string }) {
  const readings = useReadings(file);
  if (!readings.form) return null;
  return (
    <section aria-label="Readings of the proof marks">
      <h2>What does the tape say?</h2>
      <Grid form={readings.form} readings={readings} doubts={[]} />
    </section>
  );
}

/** Writes a result into the diary, once there is one. */
function useNoted(answer: ProofAnswer | undefined): void {
  const { take } = useProject();
  const isNew = !!answer?.checked && !answer.is_noted;
  useEffect(() => {
    if (!isNew) return;
    // If it fails, the next look at the result writes it.
    send<Project>("POST", "proof/note").then(take, () => undefined);
  }, [isNew, answer?.checked?.sentence, take]);
}

function Why() {
  return (
    <p>
      A fit can look good and be wrong: it has seen the marks that it is judged by. What is promised
      counts how well your marks settle the numbers, and how well a tape is read. 99 of 100 such
      marks lie within it if nothing is missing.
    </p>
  );
}
