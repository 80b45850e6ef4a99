// The frame of each screen: a title, at most forty words, a picture, the fields, and the reasons folded away. On a wide
// page the picture stays in view, and the fields scroll next to it.
import type { ComponentChildren } from "preact";

interface ScreenParts {
  title: string;
  /** At most forty words. */
  say: ComponentChildren;
  /** The reasons, folded away. */
  why?: ComponentChildren;
  /** The command that does the same in a terminal. */
  command?: string;
  /** Its content is still loading. */
  busy?: boolean;
  /** The picture: the sheet, the machine, plots. */
  stage?: ComponentChildren;
  /** Whether the fields come before the stage on a narrow page. */
  fieldsFirst?: boolean;
  /** The screen's main button, always in view. */
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
