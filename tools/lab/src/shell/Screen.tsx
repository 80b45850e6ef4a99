// The frame of each screen: a title, at most forty words, a picture, a button, and the why folded away.
import type { ComponentChildren } from "preact";

interface ScreenParts {
  title: string;
  /** At most forty words. */
  say: ComponentChildren;
  /** Folded away: the reasons, for those who ask. */
  why?: ComponentChildren;
  /** The command that does the same in a terminal. */
  command?: string;
  /** What it shows is still on its way. */
  busy?: boolean;
  children?: ComponentChildren;
}

export function Screen({ title, say, why, command, busy, children }: ScreenParts) {
  return (
    <section class="screen" aria-busy={busy}>
      <h1>{title}</h1>
      <p class="say">{say}</p>
      {children}
      {why && (
        <details class="why">
          <summary>Why?</summary>
          {why}
        </details>
      )}
      {command && (
        <details class="command">
          <summary>In a terminal</summary>
          <code>{command}</code>
        </details>
      )}
    </section>
  );
}
