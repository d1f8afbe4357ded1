// A menu that opens below its button. Escape, a click elsewhere, an undo, and leaving it with Tab close it.

import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef, useState } from "preact/hooks";

interface Item {
  name: string;
  use: string;
  act: () => void;
}

export function Menu({ face, items, look, title, isNarrow, isDisabled }: {
  face: ComponentChildren;
  items: Item[];
  /** The class of the button. */
  look: string;
  title?: string;
  isNarrow?: boolean;
  isDisabled?: boolean;
}) {
  const [isOpen, setOpen] = useState(false);
  const holder = useRef<HTMLDivElement>(null);
  const button = useRef<HTMLButtonElement>(null);
  const entries = () => [...(holder.current?.querySelectorAll<HTMLElement>("[role=menuitem]") ?? [])];
  // At once, so that a key that follows the opening closes the menu.
  useLayoutEffect(() => {
    if (!isOpen) return;
    entries()[0]?.focus();
    const onDown = (event: PointerEvent) => {
      if (!holder.current?.contains(event.target as Node)) setOpen(false);
    };
    const onKey = (event: KeyboardEvent) => {
      if (event.key === "Escape") {
        // The search goes on, and the selection stays: Escape closes the menu alone.
        event.stopPropagation();
        event.preventDefault();
        setOpen(false);
        button.current?.focus();
      } else if (event.ctrlKey || event.metaKey) setOpen(false);
      const by = { ArrowDown: 1, ArrowUp: -1 }[event.key];
      if (by === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      const all = entries();
      all[(all.indexOf(document.activeElement as HTMLElement) + by + all.length) % all.length]?.focus();
    };
    addEventListener("pointerdown", onDown, true);
    addEventListener("keydown", onKey, true);
    return () => {
      removeEventListener("pointerdown", onDown, true);
      removeEventListener("keydown", onKey, true);
    };
  }, [isOpen]);
  return (
    <div
      class="menu-holder"
      ref={holder}
      onFocusOut={(event) => {
        const to = event.relatedTarget as Node | null;
        if (to !== null && !holder.current?.contains(to)) setOpen(false);
      }}
    >
      <button ref={button} class={look} title={title} aria-haspopup="menu" aria-expanded={isOpen} disabled={isDisabled} onClick={() => setOpen(!isOpen)}>
        {face}
      </button>
      {isOpen && (
        <div class={isNarrow ? "menu narrow" : "menu"} role="menu">
          {items.map(({ name, use, act }) => (
            <button
              key={name}
              role="menuitem"
              onClick={() => {
                setOpen(false);
                button.current?.focus();
                act();
              }}
            >
              <b>{name}</b> <span>{use}</span>
            </button>
          ))}
        </div>
      )}
    </div>
  );
}
