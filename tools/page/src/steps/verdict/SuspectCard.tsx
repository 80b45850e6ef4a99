// A suspect: its odds, its size, and whether its pattern is shown over the marks; folded away, how to settle it.
import { Fragment } from "preact";
import { Bar } from "../../controls/Bar";
import { capital } from "../../controls/words";
import { SizeBar } from "./SizeBar";
import type { Card } from "./words";

interface CardParts {
  card: Card;
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
        <b class={account.possible ? "" : "wrong"}>{account.possible ? card.odds : "no"}</b>
      </div>
      {card.odds && account.possible && <Bar share={account.share} colour="var(--after)" />}
      {account.parameters.map((size) => (
        <SizeBar key={size.said} size={size} />
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
