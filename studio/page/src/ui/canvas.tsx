// The middle: the scene, the pen, messages, and the error of a model that does not compile.

import { effect } from "@preact/signals";
import { useLayoutEffect, useRef } from "preact/hooks";
import type { Key, Shape } from "../messages";
import * as store from "../store";
import { isBelow, Stage } from "../view";
import { Drag } from "./drag";
import { shapeOf } from "./gallery";
import { Sides, sideShapes } from "./compare";
import { Legend } from "./difference";
import { Offers } from "./offers";
import { Growth } from "./growth";
import { Notices, Problem } from "./notices";
import { Pen } from "./pen";

export let stage: Stage;
export let drag: Drag;
/** The shape on the stage, for tests and for the page. */
export const shown = { key: null as Key | null, role: "", detail: "", bests: 0, moves: 0 };

export function Canvas() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const holder = useRef<HTMLDivElement>(null);
  // Before any message of the studio arrives: an effect after the first frame would miss the target.
  useLayoutEffect(() => {
    stage = new Stage(
      canvas.current!,
      store.ask,
      () => (store.eye.value = stage.eye()),
    );
    // The bar of the growth lies over the foot of the scene.
    stage.covered = { top: 8, bottom: 60 };
    drag = new Drag(stage);
    const watch = new ResizeObserver(([entry]) => stage.resize(entry.contentRect.width, entry.contentRect.height));
    watch.observe(holder.current!);
    follow();
  }, []);

  const down = useRef<[number, number] | null>(null);
  const at = (event: PointerEvent): [number, number] => [event.offsetX, event.offsetY];
  return (
    <main class="stage" ref={holder}>
      <canvas
        ref={canvas}
        tabIndex={0}
        aria-label="The scene. Drag to turn the view, click a part to select it, drag the selected part to move it."
        onPointerDown={(event) => {
          down.current = at(event);
          if (event.button === 0 && drag.press(...at(event))) event.currentTarget.setPointerCapture(event.pointerId);
        }}
        onPointerMove={(event) => {
          if (drag.move(...at(event))) return;
          if (event.buttons === 0 && store.tool.value === "look" && store.compared.value.length === 0) store.hovered.value = stage.partAt(...at(event));
        }}
        onPointerLeave={() => (store.hovered.value = null)}
        onPointerUp={(event) => {
          const from = down.current;
          const to = at(event);
          if (drag.release(event.shiftKey)) return;
          if (from && Math.hypot(from[0] - to[0], from[1] - to[1]) < 4) onClick(...to);
        }}
      />
      <Pen />
      <Legend />
      <Sides />
      <Growth />
      {store.isPrior.value && <p class="hint">A run of the model, before any search.</p>}
      <Problem />
      <Notices />
      <Offers />
      {store.dragNote.value !== "" && (
        <p class="reason" role="status">
          {store.dragNote.value}
        </p>
      )}
    </main>
  );
}

function onClick(x: number, y: number): void {
  if (store.compared.value.length > 0) return;
  const part = stage.partAt(x, y);
  const name = part === null ? stage.objectAt(x, y) : null;
  store.select(part);
  if (name !== null) store.activeObject.value = { name, mode: "translate" };
  else if (part === null) store.activeObject.value = null;
}

/** Keeps the stage up to date with the messages of the studio. */
function follow(): void {
  // A run of the model, which is shown while there is no result.
  let prior: [Shape, ArrayBuffer] | null = null;
  const showPrior = () => put(prior?.[0] ?? null, prior?.[1] ?? new ArrayBuffer(0));
  store.onShape((shape, payload) => {
    if (shape.role === "ghost") {
      stage.setSolid("target", shape, payload, store.target.value);
      store.shownTarget.value = shape.source ?? null;
      if (shape.note) store.note(shape.note);
    } else if (shape.role === "prior") {
      prior = shape.triangles > 0 ? [shape, payload] : null;
      store.hasPrior.value = prior !== null;
      if (store.picked.value === null && !store.isSearching.value) showPrior();
    } else if (shape.role === "obstacle") {
      stage.setSolid(`obstacle ${shape.number}`, shape, payload, store.view.value?.ask.obstacles?.[shape.number] ?? null);
    } else if (shape.role === "best" || shape.role === "moving") {
      put(shape, payload);
      drag.shown(shape);
    } else if (store.sameKey(shape.key, store.picked.value) && !store.isSearching.value) {
      if (shape.detail === "fine" || !(shown.detail === "fine" && store.sameKey(shown.key, shape.key))) {
        put(shape, payload);
      }
    }
  });
  const put = (shape: Parameters<Stage["show"]>[0], payload: ArrayBuffer) => {
    stage.show(shape, payload);
    shown.key = shape?.key ?? null;
    shown.role = shape?.role ?? "";
    shown.bests = shown.role !== "best" ? 0 : shown.bests + 1;
    if (shown.role === "moving") shown.moves++;
    shown.detail = shape?.detail ?? "";
    remark();
  };
  const remark = () => {
    const level = store.level.value;
    const over = store.hovered.value;
    const held = [...store.heldParts.value];
    const falls = new Set([...(store.judged.value?.loose ?? []), ...(store.judged.value?.fallen ?? [])]);
    stage.mark(
      (address) => (level !== null && level !== "" && isBelow(address, level)) || (over !== null && isBelow(address, over)) || address === store.part.value,
      (address) => held.some((part) => isBelow(address, part)),
      (address) => falls.has(address),
    );
  };
  // The active result is shown at once with the mesh of the gallery, then with the fine mesh and its choices.
  let last = "";
  effect(() => {
    const key = store.picked.value;
    const name = key === null ? "" : store.nameOf(key);
    if (store.isSearching.value || name === last) return;
    last = name;
    if (key === null) {
      showPrior();
      store.described.value = store.judged.value = store.palette.value = null;
      return;
    }
    const light = shapeOf(name);
    if (light !== undefined) put(light[0], light[1]);
    void store.tell({ kind: "show", key, detail: "fine" });
    void store.tell({ kind: "describe", key });
    store.judged.value = store.palette.value = null;
    if (store.kind.value === "structure") void store.tell({ kind: "judge", key });
  });
  effect(() => {
    // After a search without a result the active result is shown again.
    if (store.isSearching.value) last = "";
  });
  let model = "";
  effect(() => {
    const reference = store.view.value?.model?.reference ?? "";
    if (reference !== model && model !== "") {
      stage.forget();
      prior = null;
      store.hasPrior.value = false;
      if (store.picked.value === null) showPrior();
      store.level.value = store.part.value = null;
    }
    model = reference;
  });
  effect(() => {
    void [store.level.value, store.hovered.value, store.heldParts.value, store.part.value];
    remark();
  });
  effect(() => {
    void store.showForces.value;
    stage.setArrows(store.showForces.value ? (store.judged.value?.arrows ?? []) : []);
    remark();
  });
  let rules = "";
  effect(() => {
    // New rules of a drawing need a new report on the active result.
    const now = JSON.stringify([store.view.value?.ask.rules, store.view.value?.held.map(({ part }) => part)]);
    const key = store.picked.peek();
    if (now !== rules && rules !== "" && key !== null && store.kind.peek() === "coloring") void store.tell({ kind: "describe", key });
    rules = now;
  });
  effect(() => {
    if (store.view.value !== null) stage.setAsk(store.view.value.ask);
  });
  effect(() => {
    const { count, order } = store.growth.value;
    stage.setGrowth(count, order, (store.described.value?.parts ?? []).map(({ address }) => address));
  });
  effect(() => stage.setSides(sideShapes.value));
  // The difference of the active result is requested when it is shown.
  let requested = "";
  effect(() => {
    const key = store.isSearching.value || !store.showDifference.value ? null : store.picked.value;
    const name = key === null ? "" : store.nameOf(key);
    if (name === requested) return;
    requested = name;
    store.difference.value = null;
    if (key !== null) void store.tell({ kind: "difference", key });
  });
  effect(() => {
    void store.theme.value;
    const difference = store.showDifference.value ? store.difference.value : null;
    stage.setDifference(difference?.header ?? null, difference?.marks ?? new Uint8Array());
  });
  effect(() => stage.setHandles(store.activeObject.value?.name ?? null, store.activeObject.value?.mode ?? "translate"));
  effect(() => stage.setGhostVisible(store.showGhost.value));
  effect(() => {
    document.documentElement.dataset.theme = store.theme.value;
    stage.paint(store.theme.value);
  });
}
