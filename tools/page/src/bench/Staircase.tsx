// How the error falls: what is left now in large figures, and each step down to it with its bar.
import { namedLength, shownLength, useUnits } from "../controls/lengths";
import { Table } from "../controls/Table";
import type { Live, Stairs } from "./live";

interface FallParts {
  live: Live;
  stairs: Stairs | undefined;
}

/** The error that is left follows a slider at once; the steps follow when it stops. */
export function Fall({ live, stairs }: FallParts) {
  const units = useUnits();
  const fit = live.now?.fit;
  return (
    <section class="fall-now" aria-busy={!fit} aria-label="The error that is left">
      <p class="soft">
        <output class="large">{fit ? namedLength(fit.fit_rms, units, 2) : "…"}</output> left
      </p>
      {fit && <p class="soft">Noise alone leaves {shownLength(fit.noise_rms ?? 0, units, 2)}.</p>}
      {stairs && <Staircase stairs={stairs} />}
    </section>
  );
}

function Staircase({ stairs }: { stairs: Stairs }) {
  const units = useUnits();
  const highest = Math.max(...stairs.stairs.map((stair) => stair.fit_rms), 1e-9);
  const number = (mm: number | null) => (mm === null ? "–" : shownLength(mm, units, 2));
  return (
    <Table
      class="wide stairs"
      caption={`How the error falls [${units}]`}
      names={["with", "", "fit", "noise", "checked"]}
      rows={stairs.stairs.map((stair, i) => [
        <>
          {stair.noun} {stair.only_fit && <strong class="wrong">Only the fit got better.</strong>}
        </>,
        <svg key={i} viewBox="0 0 100 12" preserveAspectRatio="none" aria-hidden="true">
          <rect
            fill={`var(--${stair.only_fit ? "warn" : i === 0 ? "before" : "after"})`}
            width={(100 * stair.fit_rms) / highest}
            height="12"
          />
          {stair.noise_rms !== null && (
            <rect
              fill="var(--ghost)"
              opacity={0.6}
              width={(100 * stair.noise_rms) / highest}
              height="12"
            />
          )}
          {stair.left_out_rms !== null && (
            <line
              stroke="var(--ink)"
              stroke-width={1.5}
              x1={Math.min(99, (100 * stair.left_out_rms) / highest)}
              x2={Math.min(99, (100 * stair.left_out_rms) / highest)}
              y2="12"
            />
          )}
        </svg>,
        ...[stair.fit_rms, stair.noise_rms, stair.left_out_rms].map(number),
      ])}
    />
  );
}
