// Pictures of drawings: results, and the regions of the present drawing.

import { signal } from "@preact/signals";
import * as store from "./store";

/** The region of each pixel, and the drawing in its original colours. */
export interface Plan {
  width: number;
  height: number;
  labels: Uint16Array;
  original: ImageBitmap;
}
export const plan = signal<Plan | null>(null);
/** The picture on the easel: the finest picture of a result so far, or a picture while a colour moves. */
export const easel = signal<{ name: string; detail: string; bitmap: ImageBitmap } | null>(null);

const small = new Map<string, ImageBitmap>();
const waiting = new Map<string, () => void>();
export const pictureOf = (name: string): ImageBitmap | undefined => small.get(name);
/** Calls when the picture of a result arrives; `null` cancels. */
export function onPictureOf(name: string, call: (() => void) | null): void {
  if (call === null) waiting.delete(name);
  else waiting.set(name, call);
}

const bitmap = (data: ArrayBuffer): Promise<ImageBitmap> => createImageBitmap(new Blob([data], { type: "image/png" }));

store.onPicture(async (header, payload) => {
  if (header.kind === "regions") {
    const size = header.width * header.height;
    const labels = new Uint16Array(payload, 0, size);
    plan.value = { width: header.width, height: header.height, labels, original: await bitmap(payload.slice(2 * size)) };
    return;
  }
  const name = header.key === null ? "" : store.nameOf(header.key);
  const image = await bitmap(payload);
  if (header.role === "moving") {
    easel.value = { name: "", detail: "moving", bitmap: image };
    return;
  }
  if (header.detail === "light" || !small.has(name)) {
    small.set(name, image);
    waiting.get(name)?.();
  }
  const isPicked = store.picked.value !== null && name === store.nameOf(store.picked.value);
  const isFiner = header.detail === "fine" || !(easel.value?.name === name && easel.value.detail === "fine");
  if (isPicked && isFiner) easel.value = { name, detail: header.detail, bitmap: image };
});

/** The region at a share of the picture's width and height. */
export function regionAt(x: number, y: number): string | null {
  const now = plan.value;
  if (now === null || x < 0 || y < 0 || x >= 1 || y >= 1) return null;
  const number = now.labels[Math.floor(y * now.height) * now.width + Math.floor(x * now.width)];
  return store.view.value?.model?.regions[number]?.name ?? null;
}

/** A place inside a region, as a share of the picture: roughly the pixel that is farthest from other regions. */
export function placeOf(name: string): [number, number] | null {
  const now = plan.value;
  const number = store.view.value?.model?.regions.findIndex((region) => region.name === name) ?? -1;
  if (now === null || number < 0) return null;
  for (const reach of [12, 6, 3, 1, 0]) {
    for (let y = reach; y < now.height - reach; y++) {
      for (let x = reach; x < now.width - reach; x++) {
        const is = (dx: number, dy: number) => now.labels[(y + dy) * now.width + x + dx] === number;
        if (is(0, 0) && is(-reach, 0) && is(reach, 0) && is(0, -reach) && is(0, reach)) {
          return [(x + 0.5) / now.width, (y + 0.5) / now.height];
        }
      }
    }
  }
  return null;
}
