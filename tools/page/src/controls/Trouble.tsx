// An error message, announced to screen readers at once; nothing if there is none.
import type { ComponentChildren } from "preact";

export function Trouble({ children }: { children?: ComponentChildren }) {
  if (!children) return null;
  return (
    <span class="trouble" role="alert">
      {children}
    </span>
  );
}
