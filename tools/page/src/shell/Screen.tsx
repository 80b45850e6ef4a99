// The frame of each screen: a title, at most forty words, what one looks at, what one does, and the why folded away.
// On a wide page what one looks at stays in view, and what one does scrolls next to it.
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
  /** What one looks at: the sheet, the machine, plots. */
  stage?: ComponentChildren;
  /** Whether the fields come before the stage on a narrow page. */
  fieldsFirst?: boolean;
  /** The button of the screen: in view all the time. */
  act?: ComponentChildren;
  children?: ComponentChildren;
}

export function Screen(parts: ScreenParts) {
  const { title, say, why, command, busy, stage, fieldsFirst, act, children } = parts;
  const look = ["screen", stage && "two", fieldsFirst && "fields-first"].filter(Boolean).join(" ");
  return (
    <section class={look} aria-busy={busy}>
      <div class="asks">
        <h1>{title}</h1>
        <p class="say">{say}</p>
      </div>
      {stage && <div class="stage">{stage}</div>}
      <div class="work">
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
      </div>
      {act && <div class="act">{act}</div>}
    </section>
  );
}
