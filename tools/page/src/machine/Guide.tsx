// A machine's first day, step by step; each step can be left and resumed.
import { useEffect } from "preact/hooks";
import type { Schemas } from "../api/client";
import { Trouble } from "../controls/Trouble";
import { isReady, useMachine } from "../shell/machine";
import { useProject } from "../shell/project";
import { useWatched, type Watched } from "../shell/watched";
import { GuideQuestion } from "./GuideQuestion";
import "./guide.css";

const LOOK_MS = 300; // while a step is under way

type Guide = Watched<Schemas["GuideAnswer"]>;

export function useGuide(): Guide {
  const { reload } = useProject();
  const guide: Guide = useWatched("guide", ({ here }) => here !== "", LOOK_MS);
  const here = guide.state?.here;
  useEffect(() => {
    if (here) return () => void reload(); // what the step wrote
  }, [here, reload]);
  return guide;
}

/** The button that begins the open step. */
export function BeginStep({ state: guide, press, busy }: Guide) {
  const ready = isReady(useMachine());
  const step = guide?.steps.find(({ name }) => name === guide.open);
  if (!guide || guide.here || !step) return null;
  return (
    <button
      type="button"
      class="primary"
      disabled={busy || !ready}
      onClick={() => press("begin", { step: step.name })}
    >
      Begin: {step.title}
    </button>
  );
}

/** `isNext`: the screen's button begins the open step. */
export function FirstDay({ isNext, ...all }: Guide & { isNext: boolean }) {
  const { state: guide, press, busy, silent, refused } = all;
  const ready = isReady(useMachine());
  if (!guide) return null;
  const place = guide.steps.findIndex((step) => step.name === guide.open);
  const reached = place < 0 ? guide.steps.length : place;
  const last = guide.said.at(-1) ?? "";
  return (
    <section class="guide" aria-labelledby="guide-title">
      <h2 id="guide-title">Its first day, step by step</h2>
      <p>Nothing moves before you press a button that says what moves and how far.</p>
      <Trouble>
        {silent && "The lab does not answer, so this may be old. It is asked again and again."}
      </Trouble>
      <Trouble>{refused}</Trouble>
      <ol class="plain">
        {guide.steps.map((step, index) => (
          <li
            key={step.name}
            class={step.done ? "row done" : "row"}
            data-here={step.name === guide.here}
          >
            <span>
              {step.done ? "✓" : index + 1} {step.title}
            </span>
            {step.name !== guide.here && index <= reached && !(isNext && index === reached) && (
              <button
                type="button"
                disabled={busy || !ready || guide.here !== ""}
                aria-label={`${step.done ? "Again" : "Begin"}: ${step.title}`}
                onClick={() => press("begin", { step: step.name })}
              >
                {step.done ? "Again" : "Begin"}
              </button>
            )}
            {step.name === guide.here && (
              <div class="box edge here">
                {last && <Said text={last} />}
                {guide.question ? (
                  <>
                    <GuideQuestion
                      key={guide.question.number}
                      question={guide.question}
                      busy={busy}
                      answer={(reply) => press("answer", { number: guide.question?.number, reply })}
                    />
                    <button type="button" disabled={busy} onClick={() => press("leave")}>
                      Leave this step
                    </button>
                  </>
                ) : (
                  <p role="status">The machine works …</p>
                )}
              </div>
            )}
          </li>
        ))}
      </ol>
      {!guide.here && guide.said.length > 0 && <Said text={guide.said.join("\n")} />}
      <Trouble>{!guide.here && guide.trouble}</Trouble>
      {place < 0 && (
        <p>
          <strong>All steps are done.</strong> <a href="#/measure">Choose marks</a>
        </p>
      )}
    </section>
  );
}

function Said({ text }: { text: string }) {
  return (
    <div role="status">
      {text.split("\n").map((line) => (
        <p key={line}>{line}</p>
      ))}
    </div>
  );
}
