// The machine's numbers from before a file was sent to it: which file of the folder keeps them.
const KEPT = /^(.+)-before-(\d{4}-\d{2}-\d{2}-\d{6})\.nc$/;

/** The file that was sent last, if its folder keeps what the machine held before it. */
export function lastSent(names: readonly string[]): string | undefined {
  const kept = names
    .map((name) => KEPT.exec(name))
    .filter((match) => match !== null)
    .sort((one, other) => (one[2] ?? "").localeCompare(other[2] ?? ""));
  const stem = kept.at(-1)?.[1];
  return stem && names.includes(`${stem}.toml`) ? `${stem}.toml` : undefined;
}
