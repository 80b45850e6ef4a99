// Lengths as people type and read them: mm or inch, comma or point, fractions of an inch.
import { createContext } from "preact";
import { useContext } from "preact/hooks";

export type Unit = "mm" | "inch";
/** A unit in mm. */
export const MM: Readonly<Record<Unit, number>> = { mm: 1, inch: 25.4 };

/** The chosen unit, for all components inside. */
export const Units = createContext<Unit>("mm");
export const useUnits = () => useContext(Units);

const SIGN = /\s*(mm|inch|in|"|″|”)$/i;

/**
 * A typed length in mm; undefined if it is not a length. "12,5", "48 3/16" and "3/8" are lengths; a sign behind them says
 * the unit, whatever was chosen.
 */
export function typedLength(text: string, chosen: Unit): number | undefined {
  const trimmed = text.trim();
  const sign = SIGN.exec(trimmed)?.[1]?.toLowerCase();
  const unit: Unit = sign === undefined ? chosen : sign === "mm" ? "mm" : "inch";
  const clean = trimmed.replace(SIGN, "").replace(",", ".");
  const parts = /^(-?)(?:(\d+(?:\.\d*)?|\.\d+)|(?:(\d+)[ -]+)?(\d+)\/(\d+))$/.exec(clean);
  if (!parts) return undefined;
  const [, minus, decimal, whole, above, below] = parts;
  const size =
    decimal !== undefined ? Number(decimal) : Number(whole ?? 0) + Number(above) / Number(below);
  if (!Number.isFinite(size)) return undefined;
  return (minus ? -size : size) * MM[unit];
}

/** Why a text is not a length, and how to type one; empty for a length or no text. */
export function noLength(text: string, unit: Unit): string {
  if (!text.trim() || typedLength(text, unit) !== undefined) return "";
  return `“${text.trim()}” is not a length: type it like ${unit === "mm" ? "11.9" : "4 13/32"}`;
}

/** A length [mm] in the chosen unit, without the unit's name. Inches get one more decimal. */
export function shownLength(mm: number, unit: Unit, digits = 1): string {
  return (mm / MM[unit]).toFixed(unit === "inch" ? digits + 1 : digits);
}

/** A difference [mm]: with its sign, and a minus as wide as the figures. */
export function signedLength(mm: number, unit: Unit): string {
  return `${mm > 0 ? "+" : ""}${withMinus(shownLength(mm, unit, 2))}`;
}

/** A text of numbers with each minus as wide as the figures. */
export function withMinus(text: string): string {
  return text.replaceAll("-", "\u2212");
}

/** A length [mm] with the unit. */
export function namedLength(mm: number, unit: Unit, digits = 1): string {
  return `${shownLength(mm, unit, digits)} ${unit}`;
}

/** A length [mm] as a person would type it: inches as a fraction where possible, no needless zeros. */
export function lengthText(mm: number, unit: Unit): string {
  if (unit === "mm") return String(Number(mm.toFixed(2)));
  const sixtyFourths = Math.round((Math.abs(mm) / MM.inch) * 64);
  if (Math.abs((Math.abs(mm) / MM.inch) * 64 - sixtyFourths) > 0.01) {
    return String(Number((mm / MM.inch).toFixed(3)));
  }
  let [above, below] = [sixtyFourths % 64, 64];
  const whole = (sixtyFourths - above) / 64;
  while (above && above % 2 === 0) [above, below] = [above / 2, below / 2];
  const sign = mm < 0 && sixtyFourths ? "-" : "";
  if (!above) return `${sign}${whole}`;
  return `${sign}${whole ? `${whole} ` : ""}${above}/${below}`;
}
