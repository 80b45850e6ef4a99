// A suspect: its odds, its size, and whether its pattern is shown over the marks; folded away, how to settle it.
import { Bar } from "../../controls/Bar";
import { namedLength, useUnits } from "../../controls/lengths";
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
  const units = useUnits();
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
      {card.effects.flatMap(({ sizes }) =>
        sizes.map((size) => <SizeBar key={size.said} size={size} />),
      )}
      {!account.possible && (
        <p class="wrong">No real machine has such sizes: look for another cause.</p>
      )}
      <details>
        <summary>What it is, and how to be sure</summary>
        {card.effects.map((effect) => (
          <div key={effect.name} class="cause">
            <p>{capital(effect.summary)}.</p>
            <dl>
              <dt>taken up by other numbers of the motors</dt>
              <dd>{effect.taken_up}</dd>
              <dt>to be sure</dt>
              <dd>{effect.check || capital(effect.remedy)}</dd>
            </dl>
          </div>
        ))}
        <dl>
          <dt>explains</dt>
          <dd>
            {Math.round(100 * card.share)} % of what the frame leaves; the error falls to{" "}
            {namedLength(account.rms_after_mm, units, 2)}, noise alone leaves{" "}
            {namedLength(account.noise_rms_mm, units, 2)}
          </dd>
          {card.looks_like.length > 0 && (
            <>
              <dt>looks like</dt>
              <dd>{card.looks_like.join("; ")}</dd>
            </>
          )}
        </dl>
      </details>
    </article>
  );
}
