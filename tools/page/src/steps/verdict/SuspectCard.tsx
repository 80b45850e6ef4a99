// A suspect: its odds, its size, and whether its pattern is shown over the marks; folded away, how to settle it.
import { Fragment } from "preact";
import type { Schemas } from "../../api/client";
import { Bar } from "../../controls/Bar";
import { capital } from "../../controls/words";

interface CardParts {
  card: Schemas["Suspect"];
  /** Whether its pattern is shown over the marks. */
  isLaid: boolean;
  /** Shows its pattern over the marks, if there are any. */
  lay?: () => void;
}

export function SuspectCard({ card, card: { account }, isLaid, lay }: CardParts) {
  return (
    <article class="card" aria-label={card.title}>
      <div class="head">
        <h3>
          {lay ? (
            <label>
              <input type="checkbox" checked={isLaid} onChange={lay} />
              <span class="spoken">Over the marks: </span>
              {capital(card.title)}
            </label>
          ) : (
            capital(card.title)
          )}
        </h3>
        <b class={account.possible ? "" : "wrong"}>{card.odds}</b>
      </div>
      {card.odds && account.possible && <Bar share={account.share} colour="var(--after)" />}
      {account.parameters.map((size, i) => (
        <SizeBar key={size.said} size={size} met={card.met[i] ?? ""} />
      ))}
      {!account.possible && (
        <p class="wrong">No real machine has such sizes: look for another cause.</p>
      )}
      <details>
        <summary>What it is, and how to be sure</summary>
        <dl>
          {card.facts.map(([what, said], i) => (
            <Fragment key={i}>
              <dt>{what}</dt>
              <dd>{capital(said)}</dd>
            </Fragment>
          ))}
        </dl>
      </details>
    </article>
  );
}

const ROOM = 8; // percent left and right of what is drawn

/** A fitted size with its interval, drawn on the range that real machines have. */
function SizeBar({ size, met }: { size: Schemas["Size"]; met: string }) {
  const known = [...size.limits, size.low, size.high, size.value, 0];
  const ends = known.filter((end): end is number => end !== null);
  const [least, most] = [Math.min(...ends), Math.max(...ends)];
  const at = (value: number) => ROOM + ((100 - 2 * ROOM) * (value - least)) / (most - least || 1);
  const [from, to] = [at(size.limits[0] ?? least), at(size.limits[1] ?? most)];
  const sure = size.low !== null && size.high !== null ? `M${at(size.low)} 5H${at(size.high)}` : "";
  return (
    <figure class="size">
      <figcaption>{size.said}</figcaption>
      <svg viewBox="0 0 100 10" preserveAspectRatio="none" aria-hidden="true">
        <rect x={from} y={2} width={to - from} height={6} fill="var(--line)" />
        <line
          x1={at(0)}
          x2={at(0)}
          y1={0}
          y2={10}
          stroke="var(--soft)"
          vector-effect="non-scaling-stroke"
        />
        <path
          vector-effect="non-scaling-stroke"
          stroke-width={4}
          d={`${sure}M${at(size.value)} 1V9`}
          stroke="var(--act)"
        />
      </svg>
      {met && <small class={size.possible ? "" : "wrong"}>{capital(met)}</small>}
    </figure>
  );
}
