// Step 7: why the marks are off, in a sentence; the suspects; and the best next measurement.

import { useRef, useState } from "preact/hooks";
import { isReport } from "../api/answers";
import { type Schemas, saveReport } from "../api/client";
import { List, Parts } from "../controls/Parts";
import { Progress } from "../controls/Progress";
import { Table } from "../controls/Table";
import { capital } from "../controls/words";
import { Residuals } from "../residuals/Residuals";
import { useDrawn } from "../residuals/useDrawn";
import { useAnswer } from "../shell/answer";
import { Do } from "../shell/doing";
import { useNewest } from "../shell/newest";
import { useProject } from "../shell/project";
import { Screen } from "../shell/Screen";
import { Refused } from "./correct/Refused";
import { useWriting } from "./correct/useWriting";
import { NextAct, type NextAnswer, NextStep } from "./verdict/NextStep";
import { SuspectCard } from "./verdict/SuspectCard";
import "./verdict/verdict.css";

export function Verdict() {
  const { project, trouble } = useProject();
  const { answer, refused } = useAnswer<Schemas["VerdictAnswer"]>("verdict");
  const writing = useWriting();
  const [isNextWanted, wantNext] = useNextWanted(project.key);
  const next = useAnswer<NextAnswer>("next", isNextWanted);
  const place = useRef<HTMLDivElement>(null);
  const findNext = () => {
    wantNext();
    // On a phone the answer appears far below the button.
    requestAnimationFrame(() => place.current?.scrollIntoView({ block: "center" }));
  };
  const verdict = answer?.verdict;
  const bench = useNewest<Schemas["BenchAnswer"]>(
    verdict ? "bench" : "",
    JSON.stringify(project.files),
  );
  // The likeliest cause is drawn under the arrows until another, or none, is chosen.
  const [chosen, lay] = useState<string | null>();
  const likeliest = verdict?.marks.length ? verdict.cards[0] : undefined;
  const card =
    chosen === undefined ? likeliest : verdict?.cards.find(({ title }) => title === chosen);
  const drawn = useDrawn(card?.account.effects ?? [], bench?.board ?? "");
  if (refused) return <Refused title="No verdict yet" refused={refused} writing={writing} />;
  if (!verdict) {
    return (
      <Screen title="Why are the marks off?" say="Every known effect is tried on your readings.">
        <Progress share={answer?.share ?? 0} label="The verdict" />
      </Screen>
    );
  }
  // It goes on here: something has to be measured.
  const isOpen = verdict.step.screen === "verdict";
  return (
    <Screen
      title={verdict.title}
      say={verdict.sentence}
      busy={answer.share < 1 || (!bench && !trouble)}
      why={<Why why={verdict.why} />}
      command={answer.command}
      stage={
        (verdict.marks.length > 0 || verdict.spans.length > 0) && (
          <Residuals
            readings={verdict}
            states={verdict.states}
            covariates={bench?.covariates}
            drawn={drawn}
            opensOn="second"
          />
        )
      }
      act={
        isReport ? null : isNextWanted ? (
          <NextAct next={next} />
        ) : (
          <>
            {!isOpen && (
              <a class="button primary" href={`#/${verdict.step.screen}`}>
                {verdict.step.text}
              </a>
            )}
            <button type="button" class={isOpen ? "primary" : ""} onClick={findNext}>
              Find the best next measurement
            </button>
          </>
        )
      }
    >
      <List class="slips trouble" said={verdict.warned} />
      <div ref={place}>{isNextWanted && <NextStep marks={verdict.marks} next={next} />}</div>
      {verdict.cards.length > 0 && (
        <section aria-label="Suspects">
          <h2>
            Suspects{" "}
            {verdict.marks.length > 0 && (
              <small>tick one: what it draws lies under the arrows</small>
            )}
          </h2>
          {verdict.apart && <p>{verdict.apart}</p>}
          {verdict.cards.map((each) => (
            <SuspectCard
              key={each.title}
              card={each}
              isLaid={each.title === card?.title}
              {...(verdict.marks.length > 0
                ? { lay: () => lay(each.title === card?.title ? null : each.title) }
                : {})}
            />
          ))}
          {verdict.more && <p>{verdict.more}</p>}
          {verdict.ruled_out.map(([noun, why]) => (
            <article key={noun} class="card">
              <div class="head">
                <h3>{capital(noun)}</h3>
                <b class="wrong">no</b>
              </div>
              <small>{capital(why)}</small>
            </article>
          ))}
        </section>
      )}
      {verdict.sureness.length > 0 && (
        <section>
          <h2>How sure is that?</h2>
          <Table class="wide change" rows={verdict.sureness} />
        </section>
      )}
      {verdict.unseen.length > 0 && (
        <section class="hidden-effects">
          <h2>What may act too</h2>
          <Parts parts={verdict.unseen} />
        </section>
      )}
      {!isReport && (
        <p>
          <Do work={saveReport} meanwhile="Making report.html …">
            Save the report
          </Do>
        </p>
      )}
    </Screen>
  );
}

/** Whether the next measurement was asked for in this folder; kept in reloads and reports. */
function useNextWanted(folder: string): [boolean, () => void] {
  const key = `plumb-next/${folder}`;
  const [isWanted, setWanted] = useState(isReport || sessionStorage.getItem(key) !== null);
  const want = () => {
    sessionStorage.setItem(key, "asked");
    setWanted(true);
  };
  return [isWanted, want];
}

function Why({ why: [noise, ...notes] }: { why: string[] }) {
  return (
    <>
      <p>
        The frame of the machine is always fitted too, and it takes up much of what the physics
        does. Every set of effects is weighed by how well it explains your marks, and by what real
        machines have. The odds of a suspect are against all others together. {noise}
      </p>
      <List said={notes} />
    </>
  );
}
