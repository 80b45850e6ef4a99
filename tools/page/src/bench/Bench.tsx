// The bench for effects: add and remove them, and see at once how much error is left.
import { useMemo, useRef, useState } from "preact/hooks";
import { List } from "../controls/Parts";
import { Trouble } from "../controls/Trouble";
import { Residuals } from "../residuals/Residuals";
import { useDrawn } from "../residuals/useDrawn";
import { Do } from "../shell/doing";
import { useNewest } from "../shell/newest";
import { useProject, useTell } from "../shell/project";
import { Screen } from "../shell/Screen";
import { EffectCard } from "./EffectCard";
import { type Bench as Board, type Choice, useGains, useLive, useStairs } from "./live";
import { Fall } from "./Staircase";
import "./bench.css";

export function Bench() {
  const { project } = useProject();
  const bench = useNewest<Board>("bench", JSON.stringify(project.files));
  if (!bench) return <Screen title="Effects bench" say="The marks are being read." busy />;
  return <OpenBench bench={bench} />;
}

function OpenBench({ bench }: { bench: Board }) {
  const { project, choose } = useProject();
  const { effects: added = [], held = {} } = project.choices.bench ?? {};
  const kept = { effects: added, held };
  const [moving, setMoving] = useState<Choice>(); // while a slider is being moved
  const choice = moving ?? kept;
  const live = useLive(choice, kept, bench.board);
  const stairs = useStairs(kept, bench.board);
  const gains = useGains(kept, bench.board);
  // Sorted once, by what each would leave: a row must not move away while it is being ticked.
  const first = useRef(gains);
  first.current ??= gains;
  const rank = ({ name }: { name: string }) => first.current?.[name] ?? 0;
  const effects = [...bench.effects].sort((a, b) => rank(a) - rank(b));
  const change = (next: Choice, keep: boolean) => {
    setMoving(keep ? undefined : next);
    if (keep) choose({ bench: next });
  };
  const { now, frame, previous } = live;
  const hasMarks = bench.marks.length > 0;
  const [laid, lay] = useState("");
  const drawn = useDrawn(laid ? [laid] : [], bench.board);
  // A slider moves more often than fits arrive: what has not changed is not drawn again.
  const stage = useMemo(() => {
    const states = [bench.as_set, ...(frame ? [frame] : [])];
    const hasEffects = frame && !!now && now.choice.effects.length > 0;
    if (hasEffects) states.push(now.fit);
    return (
      <Residuals
        readings={bench}
        states={states}
        ghosts={hasEffects ? previous?.fit : undefined}
        covariates={frame && bench.covariates}
        drawn={drawn}
      />
    );
  }, [bench, frame, now, previous, drawn]);
  return (
    <Screen
      {...bench.heading}
      why={<Why />}
      {...(now ? { command: now.fit.command } : {})}
      stage={stage}
      act={<Write bench={bench} choice={kept} />}
    >
      <Trouble>{live.refusal}</Trouble>
      <Fall {...{ live, stairs, bench }} />
      <div>
        <h2>Effects</h2>
        {effects.map((effect) => (
          <EffectCard
            key={effect.name}
            effect={effect}
            choice={choice}
            fit={now?.fit}
            left={gains?.[effect.name]}
            change={change}
            isLaid={laid === effect.name}
            lay={hasMarks ? () => lay(laid === effect.name ? "" : effect.name) : undefined}
          />
        ))}
        {now?.fit.intervals && kept.effects.length > 0 && (
          <p class="intervals">In brackets: the interval. {now.fit.intervals}</p>
        )}
        <List class="wrong" said={stairs?.warnings ?? []} />
      </div>
    </Screen>
  );
}

/** The button that writes the file of the new machine. */
function Write({ bench, choice }: { bench: Board; choice: Choice }) {
  const { project } = useProject();
  const tell = useTell();
  const [written, setWritten] = useState("");
  const key = JSON.stringify(choice);
  const write = async () => {
    const read = project.files[bench.new_machine] ?? "";
    await tell("bench/machine", { ...choice, read });
    setWritten(key);
  };
  return (
    <>
      <Do isNext work={write}>
        Write these numbers to {bench.new_machine}
      </Do>{" "}
      <span role="status">{written === key && `${bench.new_machine} is written.`}</span>
    </>
  );
}

function Why() {
  return (
    <p>
      Fit is the error of the marks that were fitted. Counted prices in how many numbers the fit
      took from the marks. Checked predicts each mark by a fit that did not see it. An effect that
      lowers the fit alone follows the noise. Errors of the chains say how much more of a chain each
      mark would have needed: most effects are a simple curve there.
    </p>
  );
}
