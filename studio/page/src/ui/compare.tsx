// Starred results side by side: fine shapes with numbers above them.

import { computed, effect, signal } from "@preact/signals";
import type { Shape } from "../messages";
import * as store from "../store";
import { shapeOf } from "./gallery";

/** Fine shapes of the compared results that have arrived. */
const fine = signal(new Map<string, [Shape, ArrayBuffer]>());

store.onShape((shape, payload) => {
  if (shape.role !== "result" || shape.detail !== "fine" || shape.key == null) return;
  const name = store.nameOf(shape.key);
  if (store.compared.value.some((key) => store.nameOf(key) === name)) fine.value = new Map(fine.value).set(name, [shape, payload]);
});

effect(() => {
  for (const key of store.compared.value) void store.tell({ kind: "show", key, detail: "fine" });
  if (store.compared.value.length === 0) fine.value = new Map();
});

export const sideShapes = computed(() =>
  store.compared.value.flatMap((key) => {
    const shape = fine.value.get(store.nameOf(key)) ?? shapeOf(store.nameOf(key));
    return shape === undefined ? [] : [shape];
  }),
);

export function Sides() {
  const keys = store.compared.value;
  const results = store.view.value?.results ?? [];
  if (keys.length === 0) return null;
  return (
    <div class="sides" role="group" aria-label="Results side by side">
      {keys.map((key) => {
        const place = results.findIndex((result) => store.sameKey(result.key, key));
        const outcome = results[place];
        return (
          <div key={store.nameOf(key)}>
            <button class="side-name" title="Make this the active result" onClick={() => pick(key)}>
              <b>{place + 1}</b> {outcome?.fit}
            </button>
          </div>
        );
      })}
    </div>
  );
}

function pick(key: (typeof store.compared.value)[number]): void {
  store.compared.value = [];
  void store.tell({ kind: "pick", key });
}
