// The pen: strokes over the view become a silhouette to grow into, seen by the present camera.

import { useEffect, useRef } from "preact/hooks";
import type { Difference, Eye, Mask, Sketch, Stroke } from "../messages";
import * as store from "../store";
import { KINDS, pixels } from "../view";
import { stage } from "./canvas";

const near = (a: number[], b: number[]): boolean => a.every((number, k) => Math.abs(number - b[k]) < 1e-6 * (1 + Math.abs(number)));
const sameEye = (a: Eye, b: Eye): boolean => near(a.position, b.position) && near(a.look_at, b.look_at);

export function Pen() {
  const canvas = useRef<HTMLCanvasElement>(null);
  const current = useRef<Stroke | null>(null);
  const isDrawing = store.tool.value === "draw";
  const sketch = store.view.value?.ask.sketch ?? null;
  const isFlat = store.view.value?.model?.draws != null;
  const eye = store.eye.value;
  const isSeen = sketch !== null && (sketch.camera == null || (eye !== null && sameEye(sketch.camera, eye)));

  const scored = store.mask.value;
  const inside = sketch?.inside ?? store.isInside.value;
  const redraw = (strokes: Stroke[], scored: typeof store.mask.value) => {
    const page = canvas.current!;
    page.width = page.clientWidth * devicePixelRatio;
    page.height = page.clientHeight * devicePixelRatio;
    const pen = page.getContext("2d")!;
    if (scored !== null) drawMask(pen, scored.header, scored.marks, page.height, getComputedStyle(page).color);
    pen.lineCap = pen.lineJoin = "round";
    pen.strokeStyle = getComputedStyle(page).color;
    for (const stroke of strokes) {
      pen.lineWidth = (stroke.width ?? 0.05) * page.height;
      pen.beginPath();
      const [first, ...rest] = stroke.points.map(([x, y]) => [x * page.height, y * page.height] as const);
      pen.moveTo(...first);
      for (const point of rest.length ? rest : [first]) pen.lineTo(...point);
      pen.stroke();
    }
  };
  const difference = store.showDifference.value ? store.difference.value : null;
  const isCompared =
    isSeen && difference?.header.is_picture === true && difference.header.low[0] === difference.header.high[0];
  useEffect(() => {
    // The sketch is shown as it is scored; the strokes, until this picture arrives.
    const isDrawn = isSeen && !isCompared;
    redraw(isDrawn && scored === null ? sketch!.strokes : [], isDrawn ? scored : null);
    if (isCompared) overlay(canvas.current!, difference!.header, difference!.marks);
  }, [sketch, scored, isSeen, isCompared, difference, store.theme.value]);

  const point = (event: PointerEvent): [number, number] => {
    const high = canvas.current!.clientHeight;
    return [event.offsetX / high, event.offsetY / high];
  };
  const finish = () => {
    const stroke = current.current;
    current.current = null;
    if (stroke === null) return;
    const { clientWidth, clientHeight } = canvas.current!;
    const strokes = isSeen ? sketch!.strokes : [];
    const camera = isFlat ? null : stage.eye();
    const kind = isFlat ? "silhouette" : store.sketchKind.value;
    const drawn: Sketch = { strokes: [...strokes, stroke], aspect: clientWidth / clientHeight, camera, kind, inside };
    // The first stroke of a shadow moves the light so that the camera sees the shadow.
    const light = kind === "shadow" && sketch?.kind !== "shadow" ? { light: stage.lightFromBehind() } : {};
    store.ask({ sketch: drawn, ...light });
  };
  return (
    <>
      <canvas
        ref={canvas}
        class={`pen${isDrawing ? " active" : ""}${isCompared ? " compared" : ""}`}
        aria-hidden={!isDrawing}
        onPointerDown={(event) => {
          event.currentTarget.setPointerCapture(event.pointerId);
          current.current = { points: [point(event)], width: store.penWidth.value };
        }}
        onPointerMove={(event) => {
          if (current.current === null) return;
          current.current.points.push(point(event));
          redraw([...(isSeen ? sketch!.strokes : []), current.current], isSeen ? scored : null);
        }}
        onPointerUp={finish}
        onPointerCancel={finish}
      />
      {isDrawing && (
        <div class="pen-bar" role="group" aria-label="Pen">
          <label>
            pen
            <input
              type="range"
              min={0.01}
              max={0.2}
              step={0.01}
              value={store.penWidth.value}
              aria-label="Width of the pen"
              onInput={(event) => (store.penWidth.value = Number(event.currentTarget.value))}
            />
          </label>
          <label title="A closed outline means its inside; an open stroke means itself">
            <input
              type="checkbox"
              checked={inside}
              onChange={(event) => {
                store.isInside.value = event.currentTarget.checked;
                if (sketch !== null) store.ask({ sketch: { ...sketch, inside: store.isInside.value } });
              }}
            />
            fill outlines
          </label>
          {!isFlat && (
            <select
              aria-label="Meaning of the strokes"
              value={sketch?.kind ?? store.sketchKind.value}
              onChange={(event) => {
                store.sketchKind.value = event.currentTarget.value as "silhouette" | "shadow";
                if (sketch !== null) store.ask({ sketch: { ...sketch, kind: store.sketchKind.value } });
              }}
            >
              <option value="silhouette">a silhouette</option>
              <option value="shadow">a shadow on the floor</option>
            </select>
          )}
          {sketch?.camera != null && !isSeen && (
            <button class="text-button" onClick={() => stage.lookFrom(sketch.camera!)}>
              return to its view
            </button>
          )}
          <button class="text-button" disabled={sketch === null} onClick={() => store.ask({ sketch: null })}>
            clear
          </button>
          <button class="button small" onClick={() => ((store.tool.value = "look"), store.run())} disabled={sketch === null}>
            Grow into it
          </button>
        </div>
      )}
    </>
  );
}

/** Draws the pixels of a sketch as they are scored. */
function drawMask(pen: CanvasRenderingContext2D, { width, height }: Mask, marks: Uint8Array, high: number, color: string): void {
  const small = new OffscreenCanvas(width, height);
  const inner = small.getContext("2d")!;
  const image = inner.createImageData(width, height);
  marks.forEach((mark, k) => (image.data[4 * k + 3] = 255 * mark));
  inner.putImageData(image, 0, 0);
  inner.globalCompositeOperation = "source-in";
  inner.fillStyle = color;
  inner.fillRect(0, 0, width, height);
  pen.imageSmoothingQuality = "high";
  pen.drawImage(small, 0, 0, (high * width) / height, high);
}

/** Draws the pixels of a difference over the view of its camera. */
function overlay(page: HTMLCanvasElement, { size }: Difference, marks: Uint8Array): void {
  const small = new OffscreenCanvas(size[0], size[1]);
  small.getContext("2d")!.putImageData(new ImageData(pixels(marks, KINDS[store.theme.value], 190), size[0], size[1]), 0, 0);
  const pen = page.getContext("2d")!;
  pen.imageSmoothingEnabled = false;
  pen.drawImage(small, 0, 0, page.width, page.height);
}
