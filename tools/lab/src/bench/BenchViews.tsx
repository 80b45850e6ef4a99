// What the bench shows of the marks: the sheet, the plots, and the choice between views.
import { useState } from "preact/hooks";
import { Exaggeration } from "../controls/Exaggeration";
import type { Unit } from "../controls/lengths";
import { BenchSheet } from "./BenchSheet";
import { usualExaggeration } from "./exaggeration";
import { type Bench, type Live, useDrawn } from "./live";
import { MarkPicker } from "./MarkPicker";
import { Plots } from "./Plots";
import { longest, VIEWS, type ViewName, viewOf } from "./views";

interface BenchViewsParts {
  bench: Bench;
  live: Live;
  units: Unit;
}

export function BenchViews({ bench, live, units }: BenchViewsParts) {
  const [name, setName] = useState<ViewName>("now");
  const [effect, setEffect] = useState(bench.effects[0]?.name ?? "");
  const [times, setTimes] = useState<number>();
  const [selected, select] = useState<number>();
  const drawn = useDrawn(name === "drawn" ? effect : "", bench.board);
  const view = viewOf(name, bench, live, drawn);
  const { frame } = live;
  if (!frame) return <p>The frame is being fitted.</p>;
  const title = VIEWS.find((each) => each.name === name)?.title ?? "";
  const exaggeration = times ?? usualExaggeration(longest(frame.errors), bench.sheet[0]);
  return (
    <>
      <div class="shown">
        <div class="view-choice">
          <span>
            <label for="bench-view">Show</label>{" "}
            <select
              id="bench-view"
              value={name}
              onChange={({ currentTarget: { value } }) => setName(value as ViewName)}
            >
              {VIEWS.map((each) => (
                <option key={each.name} value={each.name}>
                  {each.title}
                </option>
              ))}
            </select>
          </span>
          {name === "drawn" && (
            <span>
              <label for="bench-effect">Effect</label>{" "}
              <select
                id="bench-effect"
                value={effect}
                onChange={({ currentTarget: { value } }) => setEffect(value)}
              >
                {bench.effects.map((each) => (
                  <option key={each.name} value={each.name}>
                    {each.noun}
                  </option>
                ))}
              </select>
            </span>
          )}
          <Exaggeration value={exaggeration} change={setTimes} />
        </div>
        {view && (
          <BenchSheet
            bench={bench}
            title={title}
            errors={view.errors}
            ghosts={name === "now" ? live.previous?.fit.errors : undefined}
            exaggeration={exaggeration}
            selected={selected}
            select={select}
          />
        )}
        <p class="legend">
          <span class="key beyond">more than noise</span>{" "}
          <span class="key within">within the noise</span> <span class="key ghost">before</span>
        </p>
        <MarkPicker bench={bench} view={view} units={units} selected={selected} select={select} />
      </div>
      {view && (
        <Plots
          bench={bench}
          view={view}
          scale={frame}
          drawn={name === "drawn" ? drawn : undefined}
          units={units}
          selected={selected}
          select={select}
        />
      )}
    </>
  );
}
