// Stop did not get through: what to do by hand, and what was last heard of the machine.

import { useUnits } from "../controls/lengths";
import { Table } from "../controls/Table";
import { type LiveMachine, placeWords } from "./machine";

export function StopFailed({ live: { machine, press } }: { live: LiveMachine }) {
  const units = useUnits();
  if (press?.way !== "stop" || press.state !== "unanswered") return null;
  const { place, program, unseen } = machine;
  const ago = Math.round((Date.now() - press.at) / 1000);
  const isRunning = program?.outcome === "running";
  const facts = [
    ["Last heard", `${unseen} s ago`],
    ["Sled was at", place && placeWords(place, units)],
    ["It was doing", isRunning && `${program.title}, line ${program.done} of ${program.total}`],
    ["Stop pressed", `${ago} s ago, tried ${press.tries} times`],
  ];
  return (
    <section class="stop-failed">
      <div role="alert">
        <h2>Stop did not get through. Switch off machine and router by hand.</h2>
        <p>The lab does not answer. The machine may still be cutting.</p>
      </div>
      <Table class="wide change" rows={facts.filter(([, said]) => said)} />
      <p>
        When it answers again, this page says what happened, and stops it if you still want that.
      </p>
    </section>
  );
}
