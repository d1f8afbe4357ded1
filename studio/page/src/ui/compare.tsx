// Starred results side by side: their fine shapes, and their numbers over them.

import { computed, effect, signal } from "@preact/signals";
import type { Shape } from "../messages";
import * as store from "../store";
import { fits, shapeOf } from "./gallery";

/** Fine shapes of the compared results, as they come. */
const fine = signal(new Map<string, [Shape, ArrayBuffer]>());

store.onShape((shape, payload) => {
  if (shape.what !== "result" || shape.detail !== "fine" || shape.key == null) return;
  const name = store.nameOf(shape.key);
  if (store.compared.value.some((key) => store.nameOf(key) === name)) fine.value = new Map(fine.value).set(name, [shape, payload]);
});

effect(() => {
  for (const key of store.compared.value) void store.tell({ kind: "show", key, detail: "fine" });
  if (store.compared.value.length === 0) fine.value = new Map();
});

export const sideShapes = computed(() =>
  store.compared.value.flatMap((key) => {
    const found = fine.value.get(store.nameOf(key)) ?? shapeOf(store.nameOf(key));
    return found === undefined ? [] : [found];
  }),
);

export function Sides() {
  const keys = store.compared.value;
  const results = store.view.value?.results ?? [];
  if (keys.length === 0) return null;
  return (
    <div class="sides" role="group" aria-label="Results side by side">
      {keys.map((key) => {
        const place = results.findIndex((one) => store.sameKey(one.key, key));
        const one = results[place];
        return (
          <div key={store.nameOf(key)}>
            <button class="side-name" title="Go on with this result" onClick={() => go(key)}>
              <b>{place + 1}</b> {one && fits(one)}
            </button>
          </div>
        );
      })}
    </div>
  );
}

function go(key: (typeof store.compared.value)[number]): void {
  store.compared.value = [];
  void store.tell({ kind: "pick", key });
}
