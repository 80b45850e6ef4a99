// How far some work has come.

export function Progress({ share, label }: { share: number; label: string }) {
  return (
    <p class="progress" role="status" aria-busy={share < 1}>
      <progress value={share} max={1} aria-label={label} /> {Math.round(100 * share)} %
    </p>
  );
}
