// How far a piece of work is.

export function Progress({ share, label }: { share: number; label: string }) {
  return (
    <p class="progress" role="status" aria-busy={share < 1}>
      <progress value={share} max={1} aria-label={label} /> {Math.round(100 * share)} %
    </p>
  );
}
