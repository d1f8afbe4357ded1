// Inputs that keep the user's text or position while messages of the studio arrive.

import { useState } from "preact/hooks";

interface Properties {
  value: number | string | undefined;
  /** Called during a change. */
  onMove?: (text: string) => void;
  /** Called at the end of a change. */
  onEnd: (text: string) => void;
  [attribute: string]: any;
}

export function Field({ value, onMove, onEnd, ...rest }: Properties) {
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
        // The input keeps its text until the answer brings the new value.
        setTimeout(() => setDraft((now) => (now === text ? null : now)), 400);
      }}
    />
  );
}
