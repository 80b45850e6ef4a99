// Something that went wrong, said at once to those who hear the page too; nothing if there is nothing to say.
import type { ComponentChildren } from "preact";

export function Trouble({ children }: { children?: ComponentChildren }) {
  if (!children) return null;
  return (
    <p class="trouble" role="alert">
      {children}
    </p>
  );
}
