// A number of the machine, written like its settings: `$170 = 0.00000517 1/N`.

/** The number without an exponent, as exact as the machine says it. */
export function settingText(value: number): string {
  const text = String(Number(value.toPrecision(7)));
  if (!text.includes("e-")) return text;
  const decimals = Number(text.split("e-")[1]) + 6;
  return value.toFixed(Math.min(decimals, 100)).replace(/0+$/, "");
}

export function setting(number: number, value: number, unit: string): string {
  return `$${number} = ${settingText(value)}${unit ? ` ${unit}` : ""}`;
}
