// The middle for a drawing: its picture, the region under the pointer, and the rule that the user is making.

import { useEffect, useRef } from "preact/hooks";
import { easel, pictureOf, plan, regionAt } from "../pictures";
import * as store from "../store";
import { addRule, clickRegion, KINDS, ruling } from "./rules";
import { Notices, Problem } from "./notices";

const MARGIN = 34;
/** The frame of the picture in the canvas, CSS pixels: left, top, width, height. */
export const frame: { at: [number, number, number, number] } = { at: [0, 0, 1, 1] };

export function Easel() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const holder = useRef<HTMLElement>(null);
  const outline = useRef<{ name: string; of: Uint16Array; edge: HTMLCanvasElement } | null>(null);
  const now = plan.value;
  const name = store.picked.value === null ? "" : store.nameOf(store.picked.value);
  const shown = easel.value?.name === name || easel.value?.detail === "moving" ? easel.value.bitmap : pictureOf(name);
  const over = store.hovered.value ?? store.level.value;
  const marked = [...new Set([...(ruling.value?.regions ?? []), ...(over ? [over] : [])])];

  const draw = () => {
    const page = canvas.current;
    if (page === null || now === null) return;
    const { clientWidth, clientHeight } = page;
    const scale = Math.min(2, devicePixelRatio);
    page.width = clientWidth * scale;
    page.height = clientHeight * scale;
    const pen = page.getContext("2d")!;
    const fit = Math.min((clientWidth - 2 * MARGIN) / now.width, (clientHeight - 2 * MARGIN) / now.height);
    const [wide, high] = [now.width * fit, now.height * fit];
    const [left, top] = [(clientWidth - wide) / 2, (clientHeight - high) / 2];
    frame.at = [left, top, wide, high];
    pen.scale(scale, scale);
    pen.shadowColor = "rgb(0 0 0 / 0.16)";
    pen.shadowBlur = 26;
    pen.shadowOffsetY = 6;
    pen.fillStyle = "#ffffff";
    pen.fillRect(left, top, wide, high);
    pen.shadowColor = "transparent";
    pen.imageSmoothingQuality = "high";
    pen.drawImage(shown ?? now.original, left, top, wide, high);
    for (const region of marked) {
      const edge = edgeOf(region);
      if (edge !== null) pen.drawImage(edge, left, top, wide, high);
    }
  };
  const edgeOf = (region: string): HTMLCanvasElement | null => {
    const number = store.view.value?.model?.regions.findIndex(({ name }) => name === region) ?? -1;
    if (now === null || number < 0) return null;
    const last = outline.current;
    if (last?.name === region && last.of === now.labels) return last.edge;
    const edge = edgeMap(now.labels, now.width, now.height, number);
    outline.current = { name: region, of: now.labels, edge };
    return edge;
  };
  useEffect(draw, [now, shown, marked.join(), store.theme.value]);
  useEffect(() => {
    const watch = new ResizeObserver(draw);
    watch.observe(holder.current!);
    return () => watch.disconnect();
  });

  const at = (event: PointerEvent | MouseEvent): string | null => {
    const [left, top, wide, high] = frame.at;
    return regionAt((event.offsetX - left) / wide, (event.offsetY - top) / high);
  };
  const rule = ruling.value;
  return (
    <main class="stage easel" ref={holder}>
      <canvas
        ref={canvas}
        tabIndex={0}
        role="img"
        aria-label="The drawing. Click a region to select it; the list beside it has all regions."
        data-picture={name}
        onPointerMove={(event) => (store.hovered.value = at(event))}
        onPointerLeave={() => (store.hovered.value = null)}
        onClick={(event) => clickRegion(at(event))}
      />
      {store.hovered.value !== null && rule === null && <div class="region-name">{store.hovered.value}</div>}
      {rule !== null && (
        <div class="pen-bar" role="group" aria-label="New rule">
          <span>
            <b>{KINDS[rule.kind].name}</b>{" "}
            {rule.regions.length === 0 ? KINDS[rule.kind].ask : rule.regions.join(KINDS[rule.kind].sign)}
          </span>
          <button class="text-button" onClick={() => (ruling.value = null)}>
            cancel
          </button>
          <button class="button small" disabled={rule.regions.length < KINDS[rule.kind].least} onClick={addRule}>
            Add
          </button>
        </div>
      )}
      <Problem />
      <Notices />
    </main>
  );
}

/** Draws the edge of a region in the accent colour, two pixels wide, with a light line beside it. */
function edgeMap(labels: Uint16Array, width: number, height: number, number: number): HTMLCanvasElement {
  const page = document.createElement("canvas");
  page.width = width;
  page.height = height;
  const pen = page.getContext("2d")!;
  const image = pen.createImageData(width, height);
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      const here = labels[y * width + x] === number;
      let near = 3;
      for (let d = 1; d < 3; d++) {
        const neighbours = [x >= d ? -d : 0, x < width - d ? d : 0, y >= d ? -d * width : 0, y < height - d ? d * width : 0];
        if (neighbours.some((step) => (labels[y * width + x + step] === number) !== here)) near = Math.min(near, d);
      }
      if (near > 2) continue;
      const color = here ? [194, 87, 31, near === 1 ? 255 : 160] : [255, 255, 255, near === 1 ? 200 : 90];
      image.data.set(color, 4 * (y * width + x));
    }
  }
  pen.putImageData(image, 0, 0);
  return page;
}
