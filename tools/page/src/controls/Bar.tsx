// A share as a bar.
export function Bar({ share, colour }: { share: number; colour: string }) {
  return (
    <svg viewBox="0 0 100 6" preserveAspectRatio="none" aria-hidden="true">
      <rect width={Math.max(1, 100 * share)} height={6} fill={colour} />
    </svg>
  );
}
