// Remaining errors against what they may depend on, with what an effect would draw below them.
import type { Schemas } from "../api/client";
import { MM, useUnits } from "../controls/lengths";
import { nearest, type Pair, pointIn, ticks, tickText } from "../sheet/view";
import { BEYOND_NOISE } from "./Spans";
import type { Drawn } from "./useDrawn";

type Covariate = Schemas["BenchCovariate"];
type State = Schemas["State"];

const STRIP = 4; // plots in view
const WIDTH = 148; // [px] as on a small screen: text is never smaller
const HEIGHT = 108;
const EDGE = { left: 26, right: 6, top: 6, bottom: 32 };
const [LEFT, RIGHT, BOTTOM] = [EDGE.left, WIDTH - EDGE.right, HEIGHT - EDGE.bottom];
const REACH = 44; // [px of the drawing] for a fingertip
// The dots of each chain: lines of almost no length, with round or square ends.
const DOTS = [
  { class: "dots left", "stroke-width": 7, "stroke-linecap": "round" },
  { class: "dots right", "stroke-width": 4, "stroke-linecap": "square" },
] as const;

interface PlotsParts {
  covariates: readonly Covariate[];
  state: State;
  scale: State; // the dots of this state fit
  drawn: Drawn | undefined;
  doubted: readonly number[];
  sigma: number; // [mm] of a reading
  selected: number | undefined;
  select: (mark: number | undefined) => void;
}

export function Plots(parts: PlotsParts) {
  const { covariates, state, scale, drawn, doubted } = parts;
  const units = useUnits();
  const most = (1.1 * Math.max(largest(scale, doubted), largest(state, doubted), 0.1)) / MM[units];
  const same = covariates.map((each) => each.same).filter(Boolean);
  const plots = covariates
    .filter((each) => !each.same)
    .map((each) => <Plot key={each.name} {...parts} covariate={each} most={most} />);
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

interface PlotParts extends PlotsParts {
  covariate: Covariate;
  most: number; // half the height, in the chosen unit
}

/** The errors of the chains against a number that each mark has. */
function Plot({ covariate, state, drawn, sigma, most, selected, select }: PlotParts) {
  const units = useUnits();
  const unit = MM[units];
  const { title, values } = covariate;
  const [by, name] = covariate.unit === "mm" ? [unit, units] : [1, covariate.unit];
  const known = values.flat().filter((value) => value !== null);
  const ends = [Math.min(...known) / by, Math.max(...known) / by] as const;
  const room = 0.04 * (ends[1] - ends[0]);
  const x = along([ends[0] - room, ends[1] + room], [LEFT, RIGHT]);
  const y = along([-most, most], [BOTTOM, EDGE.top]);
  const noise = (BEYOND_NOISE * sigma) / unit;
  /** Each mark's number of a chain [mm] in the drawing, never beyond its edge. */
  const placesOf = (chains: State["chains"], side: number) =>
    chains.map((pair, i) => {
      const [at, value] = [values[i]?.[side], pair[side]];
      if (at == null || value == null) return null;
      return [x(at / by), y(Math.max(-most, Math.min(most, value / unit)))] as const;
    });
  const dots = DOTS.map((_, side) => placesOf(state.chains, side));
  const pick = (event: MouseEvent) => {
    const scale = WIDTH / (event.currentTarget as SVGSVGElement).clientWidth;
    const [px, py] = pointIn(event);
    const which = nearest([px * scale, py * scale], dots.flat(), REACH);
    select(which === undefined ? undefined : which % state.chains.length);
  };
  return (
    // biome-ignore lint/a11y/useKeyWithClickEvents: the sheet does it by keyboard
    <svg
      class="plot"
      viewBox={`0 0 ${WIDTH} ${HEIGHT}`}
      role="img"
      aria-label={`Errors of the chains against ${title}`}
      onClick={pick}
    >
      <g class="axes">
        {ticks(-most, most, 4).map((tick) => (
          <g key={tick}>
            <line x1={LEFT} x2={RIGHT} y1={y(tick)} y2={y(tick)} />
            <text x={LEFT - 5} y={y(tick) + 5} text-anchor="end">
              {tickText(tick)}
            </text>
          </g>
        ))}
        <line class="zero" x1={LEFT} x2={RIGHT} y1={y(0)} y2={y(0)} />
        {ticks(ends[0], ends[1], 3).map((tick) => (
          <text key={tick} x={x(tick)} y={BOTTOM + 14} text-anchor="middle">
            {tickText(tick)}
          </text>
        ))}
        <text class="name" x={(LEFT + RIGHT) / 2} y={HEIGHT - 5} text-anchor="middle">
          {name ? `${title}, ${name}` : title}
        </text>
      </g>
      <path
        class="noise"
        fill="currentColor"
        opacity={0.2}
        d={`M${x(ends[0])} ${y(noise)}H${x(ends[1])}V${y(-noise)}H${x(ends[0])}z`}
      />
      {drawn &&
        ["left", "right"].map((kind, side) => (
          <path
            key={kind}
            class={`strokes ${kind}`}
            stroke-width={3}
            d={pathOf(placesOf(drawn.chains, side), 10)}
          />
        ))}
      {dots.map((places, side) => (
        <path key={side} {...DOTS[side]} d={pathOf(places, 0.01)} />
      ))}
      {dots.map((places, side) => {
        const place = selected === undefined ? undefined : places[selected];
        return (
          place && (
            <circle key={side} class="lit" cx={place[0]} cy={place[1]} r={7} stroke-width={3} />
          )
        );
      })}
    </svg>
  );
}

function along([least, most]: Pair, [from, to]: Pair) {
  return (value: number) => from + ((value - least) * (to - from)) / (most - least);
}

/** A level stroke of this length [px] through each place. */
function pathOf(places: readonly (Pair | null)[], wide: number): string {
  return places
    .map((place) => place && `M${(place[0] - wide / 2).toFixed(1)} ${place[1].toFixed(1)}h${wide}`)
    .join("");
}

/** The largest error of a chain [mm]. */
function largest({ chains }: State, doubted: readonly number[]): number {
  const sure = chains.filter((_, i) => !doubted.includes(i));
  return Math.max(0, ...sure.flat().map((end) => Math.abs(end ?? 0)));
}
