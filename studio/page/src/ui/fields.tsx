// Inputs that keep what is typed or dragged: what the studio tells meanwhile does not take it away.

import { useState } from "preact/hooks";

interface Given {
  value: number | string | undefined;
  /** Called while it changes. */
  onMove?: (text: string) => void;
  /** Called when it has changed. */
  onEnd: (text: string) => void;
  [attribute: string]: any;
}

export function Field({ value, onMove, onEnd, ...rest }: Given) {
  const [draft, setDraft] = useState<string | null>(null);
  return (
    <input
      {...rest}
      value={draft ?? value}
      onInput={(event) => {
        setDraft(event.currentTarget.value);
        onMove?.(event.currentTarget.value);
      }}
      onChange={(event) => {
        const text = event.currentTarget.value;
        onEnd(text);
        // The answer brings the value; until then it stays as it was left.
        setTimeout(() => setDraft((now) => (now === text ? null : now)), 400);
      }}
    />
  );
}
