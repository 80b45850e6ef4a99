// Remaining errors against what they may depend on, with what an effect would draw below them.
import type { Schemas } from "../api/client";
import type { Unit } from "../controls/lengths";
import type { Ends, State } from "../sheet/marks";
import { Plot } from "./Plot";
import type { Drawn } from "./useDrawn";

export type Covariate = Schemas["BenchCovariate"];
export type Left = Schemas["State"];

const STRIP = 4; // plots in view
const BEYOND_NOISE = 1.96; // sigmas: noise alone makes a larger error in 5 % of the chains
const SIDES = ["left", "right"] as const;
const INCH = 25.4;

interface PlotsParts {
  covariates: readonly Covariate[];
  state: Left;
  scale: State; // the dots of this state fit
  drawn: Drawn | undefined;
  doubted: readonly number[];
  sigma: number; // [mm] of a reading
  units: Unit;
  selected: number | undefined;
  select: (mark: number | undefined) => void;
}

export function Plots(parts: PlotsParts) {
  const { covariates, state, scale, drawn, doubted, units } = parts;
  const unit = units === "inch" ? INCH : 1;
  const most =
    (1.1 * Math.max(...[scale, state].map(({ chains }) => largest(chains, doubted)), 0.1)) / unit;
  const same = covariates.map((each) => each.same).filter(Boolean);
  const plots = covariates
    .filter((each) => !each.same)
    .map((each) => <AgainstCovariate key={each.name} {...parts} covariate={each} most={most} />);
  return (
    <section class="plots" aria-labelledby="plots-title">
      <p class="keys row">
        <b id="plots-title">
          {state.title} [{units}]
        </b>
        <span class="key left">left chain</span> <span class="key right">right chain</span>
        <span class="key noise">noise</span>
        {drawn && <span class="key laid">{drawn.noun}, fitted</span>}
      </p>
      {/* biome-ignore lint/a11y/noNoninteractiveTabindex: on a narrow page it is a strip that keys move */}
      <section class="grid tiles" tabIndex={0} aria-label="Plots">
        {plots.slice(0, STRIP)}
      </section>
      <details>
        <summary>{plots.length - STRIP} more views</summary>
        <div class="grid tiles">{plots.slice(STRIP)}</div>
        {same.length > 0 && <p>Not drawn: {same.join("; ")}.</p>}
      </details>
    </section>
  );
}

interface CovariateParts extends PlotsParts {
  covariate: Covariate;
  most: number;
}

function AgainstCovariate(parts: CovariateParts) {
  const { covariate, state, drawn, sigma, units, most, selected, select } = parts;
  const unit = units === "inch" ? INCH : 1;
  const [by, name] = covariate.unit === "mm" ? [unit, units] : [1, covariate.unit];
  const { title, values } = covariate;
  const known = values.flat().filter((value) => value !== null);
  const ends = [Math.min(...known), Math.max(...known)] as const;
  const noise = (BEYOND_NOISE * sigma) / unit;
  return (
    <Plot
      title={name ? `${title}, ${name}` : title}
      label={`Errors of the chains against ${title}`}
      across={[ends[0] / by, ends[1] / by]}
      most={most}
      dots={SIDES.map((kind, side) => ({
        kind,
        places: state.chains.map((pair, i) => {
          const [at, error] = [covariate.values[i]?.[side], pair[side]];
          return at == null || error == null ? null : ([at / by, error / unit] as const);
        }),
        marks: state.chains.map((_, i) => i),
      }))}
      selected={selected}
      select={select}
      below={(x, y) => (
        <>
          <path
            class="noise"
            fill="currentColor"
            opacity={0.2}
            d={`M${x(ends[0] / by)} ${y(noise)}H${x(ends[1] / by)}V${y(-noise)}H${x(ends[0] / by)}z`}
          />
          {drawn &&
            SIDES.map((kind, side) => (
              <path
                key={kind}
                class={`strokes ${kind}`}
                stroke-width={3}
                d={drawn.chains
                  .map((pair, i) => {
                    const [at, value] = [covariate.values[i]?.[side], pair[side]];
                    if (at == null || value == null) return "";
                    return `M${(x(at / by) - 5).toFixed(1)} ${y(value / unit).toFixed(1)}h10`;
                  })
                  .join("")}
              />
            ))}
        </>
      )}
    />
  );
}

/** The largest error of a chain [mm]. */
function largest(chains: readonly Ends[] | undefined, doubted: readonly number[]): number {
  const sure = (chains ?? []).filter((_, i) => !doubted.includes(i));
  return Math.max(0, ...sure.flat().map((end) => Math.abs(end ?? 0)));
}
