// Says that what a screen shows may be old, because nobody answers.

export function Silence({ silent }: { silent: boolean }) {
  if (!silent) return null;
  return (
    <p class="trouble" role="alert">
      The lab does not answer, so this may be old. It is asked again and again.
    </p>
  );
}
