// The growth of the active result: an animation, a slider, or single steps if the user prefers reduced motion.

import { effect, signal } from "@preact/signals";
import { stage } from "./canvas";
import * as store from "../store";
import type { Order } from "../view";
import { Icon } from "./icons";

/** Seconds of the whole animation. */
const DURATION = 4;

const isPlaying = signal(false);
const isCalm = matchMedia("(prefers-reduced-motion: reduce)");
const parts = (): number => stage?.piece?.header.parts.length ?? 0;

function show(count: number | null): void {
  store.growth.value = { ...store.growth.value, count };
}

export function play(): void {
  const all = parts();
  if (all === 0) return;
  const from = store.growth.value.count ?? all;
  if (isCalm.matches) {
    show(from >= all ? 1 : from + 1);
    return;
  }
  isPlaying.value = !isPlaying.value;
  if (!isPlaying.value) return;
  const start = performance.now() - (from >= all ? 0 : (1000 * DURATION * from) / all);
  const step = (now: number) => {
    if (!isPlaying.value) return;
    const count = Math.ceil((all * (now - start)) / (1000 * DURATION));
    show(Math.max(0, Math.min(count, all)));
    if (count < all) requestAnimationFrame(step);
    else isPlaying.value = false;
  };
  requestAnimationFrame(step);
}

// A new shape is shown as a whole.
effect(() => {
  void [store.picked.value, store.isSearching.value];
  isPlaying.value = false;
  store.growth.value = { ...store.growth.peek(), count: null };
});

export function Growth() {
  const { count, order } = store.growth.value;
  const all = store.described.value?.parts.length ?? 0;
  if (store.picked.value === null || store.isSearching.value || all < 2) return null;
  if (store.tool.value !== "look" || store.showDifference.value || store.compared.value.length > 0) return null;
  const now = count ?? all;
  return (
    <div class="growth" role="group" aria-label="Growth">
      <button
        class="icon-button small"
        title={isCalm.matches ? "Show one more part (Space)" : isPlaying.value ? "Pause (Space)" : "Play the growth (Space)"}
        onClick={play}
      >
        <Icon name={isPlaying.value ? "pause" : "play"} />
      </button>
      <input
        type="range"
        min={0}
        max={all}
        value={now}
        aria-label="Visible parts"
        aria-valuetext={`${now} of ${all} parts`}
        onInput={(event) => {
          isPlaying.value = false;
          const at = Number(event.currentTarget.value);
          show(at === all ? null : at);
        }}
      />
      <output>
        {now} of {all}
      </output>
      <select
        aria-label="Order of growth"
        value={order}
        onChange={(event) => (store.growth.value = { count, order: event.currentTarget.value as Order })}
      >
        <option value="emitted">order of the run</option>
        <option value="depth">outer calls first</option>
      </select>
    </div>
  );
}
