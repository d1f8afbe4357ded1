// The strip of results: pictures from one direction, scores, stars.

import { useEffect, useRef, useState } from "preact/hooks";
import type { Outcome, Shape } from "../messages";
import { onPictureOf, pictureOf } from "../pictures";
import * as store from "../store";
import { HEIGHT, later, thumbnail, WIDTH } from "../view";
import { Icon } from "./icons";
import { title } from "./objects";

/** Shapes by result, and functions that wait for them. */
const shapes = new Map<string, [Shape, ArrayBuffer]>();
const waiting = new Map<string, () => void>();

store.onShape((shape, payload) => {
  if (shape.role !== "result" || shape.key == null) return;
  const name = store.nameOf(shape.key);
  if (shape.detail !== "light" && shapes.has(name)) return;
  shapes.set(name, [shape, payload]);
  waiting.get(name)?.();
});

export const shapeOf = (name: string): [Shape, ArrayBuffer] | undefined => shapes.get(name);

export function Gallery() {
  const view = store.view.value;
  const strip = useRef<HTMLDivElement>(null);
  const [words, setWords] = useState("");
  const all = view?.results ?? [];
  const results = all.filter(({ kind }) => words === "" || has(kind ?? "", words));
  if (all.length === 0 && store.glimpses.value.size > 0 && !store.isSearching.value) return <Models />;
  const move = (event: KeyboardEvent) => {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    const at = results.findIndex(({ key }) => store.sameKey(key, view?.picked));
    const next = results[Math.min(Math.max(at + by, 0), results.length - 1)];
    if (next === undefined) return;
    void store.tell({ kind: "pick", key: next.key });
    strip.current?.querySelectorAll<HTMLElement>("[role=option]")[results.indexOf(next)]?.focus();
  };
  return (
    <div class="gallery">
      {all.length === 0 && <p class="quiet empty">Results appear here, the best first.</p>}
      {all.some(({ kind }) => kind) && (
        <input
          class="filter"
          type="search"
          placeholder="filter"
          aria-label="Filter results by words of their kind"
          title={[...new Set(all.map(({ kind }) => kind ?? ""))].filter((kind) => kind !== "").join("\n")}
          value={words}
          onInput={(event) => setWords(event.currentTarget.value)}
        />
      )}
      <div class="results" role="listbox" aria-label="Results" aria-orientation="horizontal" ref={strip} onKeyDown={move}>
        {results.map((outcome) => (
          <Card key={store.nameOf(outcome.key)} outcome={outcome} number={all.indexOf(outcome) + 1} />
        ))}
      </div>
    </div>
  );
}

/** Whether a kind has each of the words. */
const has = (kind: string, words: string): boolean =>
  words
    .toLowerCase()
    .split(/\s+/)
    .every((word) => kind.toLowerCase().includes(word));

/** Models to begin with, each with a picture of a run, in place of results that are not there yet. */
function Models() {
  const present = store.view.value?.model?.reference;
  return (
    <div class="gallery models" role="group" aria-label="Models to begin with">
      {[...store.glimpses.value].map(([reference, [shape, payload]]) => (
        <ModelCard key={reference} reference={reference} shape={shape} payload={payload} isPresent={reference === present} />
      ))}
    </div>
  );
}

function ModelCard({ reference, shape, payload, isPresent }: { reference: string; shape: Shape; payload: ArrayBuffer; isPresent: boolean }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const theme = store.theme.value;
  useEffect(() => {
    later(() => {
      if (canvas.current === null) return;
      thumbnail(canvas.current, shape, payload, theme, shape.low, shape.high);
      canvas.current.dataset.drawn = "yes";
    });
  }, [shape, theme]);
  return (
    <button class="card" aria-pressed={isPresent} onClick={() => void store.tell({ kind: "model", reference })}>
      <canvas ref={canvas} width={WIDTH} height={HEIGHT} aria-hidden="true" />
      <span class="caption">{title(reference).replace(/\.py$/, "").replace(/-/g, " ")}</span>
    </button>
  );
}

function Card({ outcome, number }: { outcome: Outcome; number: number }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const name = store.nameOf(outcome.key);
  const isPicked = store.sameKey(outcome.key, store.picked.value);
  const isStarred = store.isStarred(outcome.key);
  const theme = store.theme.value;
  useEffect(() => {
    const draw = () => {
      if (canvas.current === null) return;
      const picture = pictureOf(name);
      if (picture !== undefined) {
        drawFitted(canvas.current, picture);
        canvas.current.dataset.drawn = "yes";
        return;
      }
      const shape = shapes.get(name);
      if (shape === undefined) return;
      thumbnail(canvas.current, shape[0], shape[1], theme, shape[0].low, shape[0].high);
      canvas.current.dataset.drawn = "yes";
    };
    const wait = () => later(draw);
    waiting.set(name, wait);
    onPictureOf(name, wait);
    if (shapes.has(name) || pictureOf(name) !== undefined) wait();
    else void store.tell({ kind: "show", key: outcome.key, detail: "light" });
    return () => {
      waiting.delete(name);
      onPictureOf(name, null);
    };
  }, [name, theme]);
  // A number and its sign stay on a line.
  const share = (outcome.note || outcome.fit).replace(/ %/g, "\u00a0%");
  const score = outcome.log_score === null ? "impossible" : outcome.log_score.toFixed(1);
  const misses = outcome.unmet.length === 0 ? "" : `does not keep: ${outcome.unmet.join("; ")}`;
  return (
    <div
      class="card"
      role="option"
      tabIndex={isPicked ? 0 : -1}
      aria-selected={isPicked}
      aria-label={[`Result ${number}`, `score ${score}`, share, misses, isStarred ? "starred" : ""].filter(Boolean).join(", ")}
      onClick={() => void store.tell({ kind: "pick", key: outcome.key })}
    >
      <canvas ref={canvas} width={WIDTH} height={HEIGHT} />
      <div class="caption">
        <b>{number}</b>
        <span
          class={misses === "" ? undefined : "warning"}
          title={[share || "no target", `log score ${score}`, outcome.kind, misses].filter(Boolean).join(", ")}
        >
          {share || score}
        </span>
        <button
          class="icon-button tiny star"
          aria-pressed={isStarred}
          title={isStarred ? "Remove the star" : "Star this result: a new search keeps it"}
          onClick={(event) => {
            event.stopPropagation();
            void store.tell({ kind: "star", key: outcome.key, on: !isStarred });
          }}
        >
          <Icon name="star" filled={isStarred} />
        </button>
      </div>
    </div>
  );
}

/** Draws a picture whole, in the middle. */
function drawFitted(canvas: HTMLCanvasElement, picture: ImageBitmap): void {
  const pen = canvas.getContext("2d")!;
  const scale = Math.min(WIDTH / picture.width, HEIGHT / picture.height);
  const [wide, high] = [picture.width * scale, picture.height * scale];
  pen.clearRect(0, 0, WIDTH, HEIGHT);
  pen.imageSmoothingQuality = "high";
  pen.drawImage(picture, (WIDTH - wide) / 2, (HEIGHT - high) / 2, wide, high);
}
