// A suspect: what it draws, what it is, how large, how much it explains, what it looks like, what would settle it.
import { namedLength, type Unit } from "../../controls/lengths";
import { Arrow } from "../../sheet/Arrow";
import { SheetMap } from "../../sheet/SheetMap";
import { SizeBar } from "./SizeBar";
import type { Card, Size } from "./words";

interface CardParts {
  card: Card;
  sheet: Size;
  units: Unit;
}

export function SuspectCard({ card, sheet, units }: CardParts) {
  return (
    <article class="card" aria-label={card.title}>
      <h3>{card.title}</h3>
      <p class="odds">Odds {card.odds}</p>
      {card.effects.map((effect) => (
        <div key={effect.name} class="cause">
          <Fingerprint arrows={effect.fingerprint} sheet={sheet} noun={effect.noun} />
          <p>{capital(effect.summary)}.</p>
          {effect.sizes.map((size) => (
            <SizeBar key={size.said} size={size} />
          ))}
          <dl>
            {effect.hidden_share !== null && (
              <>
                <dt>hidden in the frame</dt>
                <dd>{Math.round(100 * effect.hidden_share)} %</dd>
              </>
            )}
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
        <p class="impossible">No real machine has such sizes: look for another cause.</p>
      )}
    </article>
  );
}

interface FingerprintParts {
  arrows: Card["effects"][number]["fingerprint"];
  sheet: Size;
  noun: string;
}

function Fingerprint({ arrows, sheet, noun }: FingerprintParts) {
  const longest = Math.max(...arrows.map(({ error }) => Math.hypot(...error)), 1e-6);
  const exaggeration = (0.09 * sheet[0]) / longest;
  return (
    <SheetMap sheet={sheet} label={`What ${noun} draws on the sheet`}>
      {arrows.map(({ place, error }) => (
        <Arrow
          key={place.join()}
          from={place}
          to={[place[0] + error[0], place[1] + error[1]]}
          exaggeration={exaggeration}
          colour="var(--act)"
        />
      ))}
    </SheetMap>
  );
}

function capital(said: string): string {
  return said.charAt(0).toUpperCase() + said.slice(1);
}
