// The errors of the chains against all that they may depend on.
import type { Unit } from "../controls/lengths";
import type { Bench, Drawn } from "./live";
import { Plot } from "./Plot";
import { largest, type View } from "./views";

const TITLES: Record<string, string> = {
  tension: "tension of the chain",
  length: "length of the chain",
  angle: "angle of the chain",
  phase: "turn of the sprocket",
  height: "height on the sheet",
  order: "order of cutting",
  approach: "direction of the last move",
};

interface PlotsParts {
  bench: Bench;
  view: View;
  scale: View; // the dots of this view fit
  drawn: Drawn | undefined;
  units: Unit;
  selected: number | undefined;
  select: (mark: number | undefined) => void;
}

export function Plots({ bench, view, scale, drawn, units, selected, select }: PlotsParts) {
  const most = 1.1 * Math.max(largest(scale.chains), largest(view.chains), 0.1);
  return (
    <section class="plots" aria-labelledby="plots-title">
      <h2 id="plots-title">What is left in the chains</h2>
      <p class="legend">
        <span class="key left">left chain</span> <span class="key right">right chain</span>
      </p>
      <div class="grid">
        {bench.covariates.map((covariate) => (
          <Plot
            key={covariate.name}
            title={TITLES[covariate.name] ?? covariate.name}
            unit={covariate.unit}
            values={covariate.values}
            chains={view.chains}
            most={most}
            units={units}
            curves={drawn?.curves[covariate.name]}
            selected={selected}
            select={select}
          />
        ))}
      </div>
    </section>
  );
}
