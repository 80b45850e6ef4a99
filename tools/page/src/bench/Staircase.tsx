// How the error falls: what is left now in large figures, and each step down to it with its bar.
import { namedLength, shownLength, type Unit, useUnits } from "../controls/lengths";
import { Table } from "../controls/Table";
import type { Bench, Live, Stairs } from "./live";

interface FallParts {
  live: Live;
  stairs: Stairs | undefined;
  bench: Bench;
}

/** The error that is left follows a slider at once; the steps follow when it stops. */
export function Fall({ live, stairs, bench }: FallParts) {
  const units = useUnits();
  const fit = live.now?.fit;
  return (
    <section class="fall-now" aria-busy={!fit} aria-label="The error that is left">
      <p class="soft">
        <output class="large">{fit ? namedLength(fit.fit_rms, units, 2) : "…"}</output> left
      </p>
      {fit && <p class="soft">Noise alone leaves {shownLength(fit.noise_rms ?? 0, units, 2)}.</p>}
      {stairs && <Staircase {...{ stairs, bench, units }} />}
    </section>
  );
}

interface StaircaseParts {
  stairs: Stairs;
  bench: Bench;
  units: Unit;
}

function Staircase({ stairs, bench: { effects, as_set: asSet }, units }: StaircaseParts) {
  const steps = [
    { noun: "as set", fit: asSet.fit_rms, noise: null, checked: null, onlyFit: false },
    { noun: "frame fitted", ...sizesOf(stairs.before), onlyFit: false },
    ...stairs.by_effect.map((step) => ({
      noun: `+ ${effects.find(({ name }) => name === step.effect)?.noun ?? step.effect}`,
      ...sizesOf(step),
      onlyFit: step.only_fit,
    })),
  ];
  const highest = Math.max(...steps.map(({ fit }) => fit), 1e-9);
  const number = (mm: number | null) => (mm === null ? "–" : shownLength(mm, units, 2));
  return (
    <Table
      class="wide stairs"
      caption={`How the error falls [${units}]`}
      names={["with", "", "fit", "noise", "checked"]}
      rows={steps.map(({ noun, fit, noise, checked, onlyFit }, i) => [
        <>
          {noun} {onlyFit && <strong class="wrong">Only the fit got better.</strong>}
        </>,
        <svg key={i} viewBox="0 0 100 12" preserveAspectRatio="none" aria-hidden="true">
          <rect
            fill={`var(--${onlyFit ? "warn" : i === 0 ? "before" : "after"})`}
            width={(100 * fit) / highest}
            height="12"
          />
          {noise !== null && (
            <rect fill="var(--ghost)" opacity={0.6} width={(100 * noise) / highest} height="12" />
          )}
          {checked !== null && (
            <line
              stroke="var(--ink)"
              stroke-width={1.5}
              x1={Math.min(99, (100 * checked) / highest)}
              x2={Math.min(99, (100 * checked) / highest)}
              y2="12"
            />
          )}
        </svg>,
        ...[fit, noise, checked].map(number),
      ])}
    />
  );
}

/** What a fit leaves, what noise alone would leave of it, and the error of marks it did not see [mm]. */
function sizesOf(fitted: Stairs["before"]) {
  const { fit_rms_mm: fit, noise_rms_mm: noise, left_out_rms_mm: checked } = fitted;
  return { fit, noise, checked };
}
