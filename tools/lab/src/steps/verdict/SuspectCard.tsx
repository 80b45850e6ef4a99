// A suspect: what it is, how large, how much it explains, what it looks like, what would settle it.
import { namedLength, type Unit } from "../../controls/lengths";
import { SizeBar } from "./SizeBar";
import type { Card } from "./words";

interface CardParts {
  card: Card;
  units: Unit;
  /** Whether what it draws lies over the marks. */
  isLaid: boolean;
  /** Lays it over the marks, if there are any. */
  lay?: () => void;
}

export function SuspectCard({ card, units, isLaid, lay }: CardParts) {
  return (
    <article class="card box" aria-label={card.title}>
      <h3>{card.title}</h3>
      {card.odds && <p class="soft">Odds {card.odds}</p>}
      {lay && (
        <button type="button" aria-pressed={isLaid} onClick={lay}>
          {isLaid ? "Laid over the marks" : "Lay it over the marks"}
        </button>
      )}
      {card.effects.map((effect) => (
        <div key={effect.name} class="cause">
          <p>{capital(effect.summary)}.</p>
          {effect.sizes.map((size) => (
            <SizeBar key={size.said} size={size} />
          ))}
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
          {namedLength(card.rms_after, units, 2)}, noise alone leaves{" "}
          {namedLength(card.noise_after, units, 2)}
        </dd>
        {card.looks_like.length > 0 && (
          <>
            <dt>looks like</dt>
            <dd>{card.looks_like.join("; ")}</dd>
          </>
        )}
      </dl>
      {!card.possible && (
        <p class="wrong">No real machine has such sizes: look for another cause.</p>
      )}
    </article>
  );
}

function capital(said: string): string {
  return said.charAt(0).toUpperCase() + said.slice(1);
}
